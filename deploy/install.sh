#!/bin/sh
# Install a hashed list into an environment: by uv, which comes by its hash first and takes a tenth of the processor
# time, or by pip where uv is not to be had.
#   deploy/install.sh ENVIRONMENT LIST
set -eu
bin=$1/bin
list=$2
here=$(dirname "$0")

pip="$bin/pip --disable-pip-version-check"
# uv does not read what pip is told of mirrors
mirror=${PIP_INDEX_URL:-$($pip config get global.index-url 2> /dev/null || true)}
[ -z "$mirror" ] || export UV_DEFAULT_INDEX="${UV_DEFAULT_INDEX:-$mirror}"

# the lists are whole, and leave out what cvxpy would bring along and nothing asks for
if { [ -x "$bin/uv" ] || $pip --quiet install --no-deps --require-hashes --requirement "$here/uv.txt"; } \
    && "$bin/uv" pip install --python "$bin/python" --no-progress --no-deps --require-hashes --requirement "$list"; then
    exit
fi
echo "without uv: pip installs, which takes half a minute longer"
$pip install --no-deps --require-hashes --requirement "$list"
