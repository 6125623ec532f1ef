#!/usr/bin/env bash
# Build the image and run it where there is no container engine: buildah makes it in chroots, on a base of Debian's own
# packages in place of the official one. The image is measured, asked for what the commands do, and served from a
# read-only view as the user that it names, where smoke.sh asks it. Needs root, and Debian for the base; several minutes
# and 10 GB of disk meanwhile, of which nothing is left.
#   deploy/image-check.sh
set -euo pipefail
cd "$(dirname "$0")/.."

limit_mb=${IMAGE_LIMIT_MB:-1200}
suite=$(sed -n 's/^ARG BASE=python:[0-9.]*-slim-\([a-z]*\).*/\1/p' deploy/Dockerfile)

if [ "$(id --user)" != 0 ]; then
    echo "image-check.sh needs root: it makes file systems and changes its root" >&2
    exit 2
fi
missing=()
for tool in buildah mmdebstrap curl jq; do
    command -v "$tool" > /dev/null || missing+=("$tool")
done
if [ ${#missing[@]} -gt 0 ]; then
    echo "installing ${missing[*]}"
    { apt-get --quiet=2 update && apt-get --quiet=2 install --yes --no-install-recommends "${missing[@]}" > /dev/null; } ||
        { echo "image-check.sh needs ${missing[*]}, and could not install that" >&2; exit 2; }
fi

folder=$(mktemp --directory --tmpdir="${TMPDIR:-/var/tmp}" image-check.XXXXXX)
printf '[storage]\ndriver = "vfs"\ngraphroot = "%s/graph"\nrunroot = "%s/run"\n' "$folder" "$folder" > "$folder/storage.conf"
export CONTAINERS_STORAGE_CONF=$folder/storage.conf BUILDAH_ISOLATION=chroot
service=
cleaned() {
    [ -z "$service" ] || kill -KILL "$service" 2> /dev/null || true
    buildah umount --all > /dev/null 2>&1 || true
    rm -rf --one-file-system "$folder"
}
trap cleaned EXIT
trap "exit 1" HUP INT TERM

# step WHAT: what is done next, and when
step() {
    printf '%4d s  %s\n' "$SECONDS" "$1"
}

# ---- a base with the Python of the official one

step "base: $suite"
mmdebstrap --quiet --variant=minbase --include=python3,python3-pip,python3-venv,python-is-python3,ca-certificates \
    --dpkgopt='path-exclude=/usr/share/doc/*' --dpkgopt='path-exclude=/usr/share/man/*' \
    --dpkgopt='path-exclude=/usr/share/locale/*' "$suite" "$folder/base.tar"
container=$(buildah from scratch)
buildah add --quiet "$container" "$folder/base.tar" / > /dev/null
rm "$folder/base.tar"
buildah config --env PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin "$container"
base=localhost/base:$suite
buildah commit --quiet --rm "$container" "$base" > /dev/null

# ---- the image

# What this machine's own pip is told (certificates, a folder with wheels or with an index) holds for the build as well:
# its files, and what they name, can be read by the build. Of them the image has empty places, and nobody keeps it.
seen=()
if command -v pip > /dev/null; then
    mapfile -t named < <(pip config debug | sed -n 's/^ *\(\/.*\), exists: True$/\1/p'
        pip config list | grep --only-matching --extended-regexp "/[^'\" ,]+" | sed 's|^//*|/|; s|/simple/*$||')
    for path in "${named[@]}"; do
        [ ! -e "$path" ] || [[ " ${seen[*]} " == *" $path:"* ]] || seen+=(--volume "$path:$path:ro")
    done
fi

step "image"
buildah build --quiet --build-arg "BASE=$base" "${seen[@]}" --ignorefile deploy/Dockerfile.dockerignore \
    --file deploy/Dockerfile --tag localhost/counterweight . > "$folder/build.log" 2>&1 ||
    { cat "$folder/build.log" >&2; exit 1; }
container=$(buildah from localhost/counterweight)
root=$(buildah mount "$container")

size=$(du --summarize --block-size=1000000 "$root" | cut --fields=1)
echo "image: $size MB, of which $(du --summarize --block-size=1000000 "$root/opt/counterweight" | cut --fields=1) MB are not of the base"
echo "what weighs most of it, MB:"
du --block-size=1000000 --max-depth=1 "$root"/opt/counterweight/lib/python3.*/site-packages \
    | sort --numeric-sort --reverse | sed -n '2,13s|\t.*/|  |p'
if [ "$size" -gt "$limit_mb" ]; then
    echo "FAILED  more than $limit_mb MB: deploy/unused.txt" >&2
    exit 1
fi

# ---- what it does

buildah inspect "$container" | jq .OCIv1.config > "$folder/config.json"
user=$(jq --raw-output .User "$folder/config.json")
mapfile -t environment < <(jq --raw-output '.Env[]' "$folder/config.json")
mapfile -t entrypoint < <(jq --raw-output '.Entrypoint[]' "$folder/config.json")
mapfile -t command < <(jq --raw-output '.Cmd[]' "$folder/config.json")
install --directory --mode 0755 "$folder/data" "$folder/tmp"
chown "$user" "$folder/data" "$folder/tmp"

# become COMMAND...: this process becomes one of the image, as its user and with its environment alone, and sees a file
# system that it can write to in /data and /tmp only
become() {
    # shellcheck disable=SC2016  # the inner shell expands
    exec unshare --mount -- sh -euc '
        root=$1 folder=$2 user=$3
        shift 3
        mount --bind "$root" "$root"
        mount --types proc proc "$root/proc"
        mount --rbind /dev "$root/dev"
        mount --bind "$folder/data" "$root/data"
        mount --bind "$folder/tmp" "$root/tmp"
        mount --options remount,bind,ro "$root"
        exec chroot --userspec "$user" "$root" /usr/bin/env --ignore-environment --chdir /data "$@"
    ' sh "$root" "$folder" "$user" HOME=/data "${environment[@]}" \
        COUNTERWEIGHT_HOST=127.0.0.1 COUNTERWEIGHT_PORT=0 "${entrypoint[@]}" "$@"
}

# does WHAT COMMAND...
does() {
    local what=$1
    shift
    (become "$@") > "$folder/output" 2>&1 < /dev/null || { echo "FAILED  $what" >&2; cat "$folder/output" >&2; exit 1; }
    echo "ok      $what"
}

step "commands, as $user"
install --mode 0644 examples/*.json examples/{sweeps/2d12-grid,pin-loads/three-pins,rating/air-single-stage}.json \
    "$folder/data"
if (become touch /opt/counterweight/written) 2> /dev/null || [ "$(become id --user)" = 0 ]; then
    echo "FAILED  the image can be written to, or is used as root" >&2
    exit 1
fi
does "optimize" counterweight optimize 2d12.json
does "optimize, for verify" sh -c 'counterweight optimize v8-cross-plane.json --json > answer.json'
does "verify" counterweight verify v8-cross-plane.json answer.json
does "pareto" counterweight pareto 2d12.json
does "pin-loads" counterweight pin-loads three-pins.json
does "rating" counterweight rating air-single-stage.json
does "accuracy, with its picture" counterweight accuracy single-vertical.json --repeats 1 --picture accuracy.svg
for format in pdf html; do
    does "report, $format" counterweight report 2d12.json --to "report.$format"
done
for format in parquet arrow csv ndjson; do
    does "sweep, $format" counterweight sweep 2d12-grid.json --workers 2 --output "rows.$format"
done
does "schema" counterweight schema optimize
does "dask" python -c 'from distributed import Client
with Client(processes=False, dashboard_address=None) as cluster:
    assert cluster.submit(sum, [1, 2]).result() == 3'
does "PostgreSQL and traces" python -c 'import psycopg
from opentelemetry.exporter.otlp.proto.http.trace_exporter import OTLPSpanExporter
from opentelemetry.sdk.trace import TracerProvider
OTLPSpanExporter(endpoint="http://127.0.0.1:9/v1/traces").shutdown()'
# compiled at the first request otherwise
diff --recursive --brief "$root/opt/counterweight/numba" "$folder/tmp/numba" ||
    { echo "FAILED  kernels were compiled that the image does not hold" >&2; exit 1; }
echo "ok      no kernel had to be compiled"

# ---- what it serves

step "service"
COUNTERWEIGHT_KEY=$(become counterweight key create image-check --scope compute --scope sweeps)
export COUNTERWEIGHT_KEY
# there before it is read: the process beside this one may open it later
: > "$folder/served"
become "${command[@]}" > "$folder/served" 2>&1 < /dev/null &
service=$!
for ((waited = 0; waited < 60; waited++)); do
    url=$(sed -n 's/^counterweight listens on \(http:[^ ]*\).*/\1/p' "$folder/served")
    if [ -n "$url" ] || ! kill -0 "$service" 2> /dev/null; then break; fi
    sleep 1
done
if [ -z "$url" ] || ! deploy/smoke.sh "$url"; then
    cat "$folder/served" >&2
    exit 1
fi
page=$(curl --silent --show-error --fail "$url/")
plots=$(grep --only-matching --max-count=1 'portal/[^"]*/' <<< "$page" | head --lines=1)plotly.min.js
curl --silent --show-error --fail --output /dev/null "$url/$plots"
echo "ok      the page and what it draws with"

kill -TERM "$service"
code=0
wait "$service" || code=$?
service=
# by the signal, which uvicorn sends itself once everything has ended
if [ "$code" != 0 ] && [ "$code" != 143 ]; then
    echo "FAILED  the service ended with $code" >&2
    cat "$folder/served" >&2
    exit 1
fi
echo "ok      ended when told to"
step "image: $size MB, and it serves"
