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
pip="${PYTHON:-python3} -m pip --python $bin/python --disable-pip-version-check"
[ ! -x "$bin/pip" ] || pip="$bin/pip --disable-pip-version-check"

# sets what calls pip, and tells uv of the mirror that pip is told of, which uv does not read
locate_pip() {
    if ! settings=$($pip config list 2> /dev/null); then
        "$bin/python" -m ensurepip > /dev/null
        pip="$bin/pip3 --disable-pip-version-check"
        settings=$($pip config list)
    fi
    mirror=${PIP_INDEX_URL:-$(echo "$settings" | sed -n "s/^global.index-url='\(.*\)'$/\1/p")}
    [ -z "$mirror" ] || export UV_DEFAULT_INDEX="${UV_DEFAULT_INDEX:-$mirror}"
}

install_uv() { [ -x "$bin/uv" ] || $pip --quiet install --no-deps --require-hashes --requirement "$here/uv.txt"; }
by_uv() { "$bin/uv" pip install --python "$bin/python" --no-progress "$@"; }

if [ "$list" = --editable ]; then
    # built from what is there: no mirror is asked for it, and pip would take half a second to start
    set -- --quiet --no-deps --no-build-isolation --editable "$3"
    if [ -x "$bin/uv" ] && by_uv "$@"; then exit; fi
    locate_pip
else
    # the lists are whole, and leave out what cvxpy would bring along and nothing asks for
    set -- --no-deps --require-hashes --requirement "$list"
    # pip starts twice, for half a second each: side by side
    beside=$pip
    install_uv &
    locate_pip
    if { wait $! || { [ "$pip" != "$beside" ] && install_uv; }; } && by_uv "$@"; then exit; fi
fi
echo "without uv: pip installs, which takes half a minute longer"
$pip install "$@"
