#!/bin/sh
# Give the compiled kernels of the image a place that can be written, as numba uses no other; then become the command.
set -eu

compiled=${COMPILED:-/opt/counterweight/numba}
if [ ! -d "$NUMBA_CACHE_DIR" ]; then
    # copied beside and renamed: a start that is interrupted leaves no half of it
    fresh=$(mktemp -d "$NUMBA_CACHE_DIR.XXXXXX")
    cp -R --preserve=timestamps "$compiled/." "$fresh"
    mv "$fresh" "$NUMBA_CACHE_DIR"
fi
exec "$@"
