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
# numba keeps kernels by processor, and takes the features of this one unless it is told to take none beyond the name:
# by those it would find none of the image's kernels, whoever names the processor
NUMBA_CPU_NAME=${NUMBA_CPU_NAME:-$(processor)} NUMBA_CPU_FEATURES=${NUMBA_CPU_FEATURES-}
export NUMBA_CPU_NAME NUMBA_CPU_FEATURES
exec "$@"
