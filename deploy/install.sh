#!/bin/sh
# Install a hashed list into an environment, or this checkout so that changes of it count: by uv, which comes by its hash
# first and takes a tenth of the processor time, or by pip where uv is not to be had.
#   deploy/install.sh ENVIRONMENT LIST
#   deploy/install.sh ENVIRONMENT --editable .
set -eu
bin=$1/bin
list=$2
here=$(dirname "$0")

# an environment need not have a pip of its own where there is one beside it
pip="${PYTHON:-python3} -m pip --python $bin/python"
[ ! -x "$bin/pip" ] || pip="$bin/pip"
if ! $pip --version > /dev/null 2>&1; then
    "$bin/python" -m ensurepip > /dev/null
    pip="$bin/pip3"
fi
pip="$pip --disable-pip-version-check"

if [ "$list" = --editable ]; then
    set -- --quiet --no-deps --no-build-isolation --editable "$3"
else
    # the lists are whole, and leave out what cvxpy would bring along and nothing asks for
    set -- --no-deps --require-hashes --requirement "$list"
fi

# uv does not read what pip is told of mirrors
mirror=${PIP_INDEX_URL:-$($pip config get global.index-url 2> /dev/null || true)}
[ -z "$mirror" ] || export UV_DEFAULT_INDEX="${UV_DEFAULT_INDEX:-$mirror}"

if { [ -x "$bin/uv" ] || $pip --quiet install --no-deps --require-hashes --requirement "$here/uv.txt"; } \
    && "$bin/uv" pip install --python "$bin/python" --no-progress "$@"; then
    exit
fi
echo "without uv: pip installs, which takes half a minute longer"
$pip install "$@"
