#!/usr/bin/env bash
# Whether a running service serves: it is ready, a certified optimum, a sweep there and back, a refusal that names the
# field, and that keys are asked for. Leaves nothing behind. Needs curl and jq.
#   deploy/smoke.sh http://127.0.0.1:8000            the key, if one is needed, in COUNTERWEIGHT_KEY (compute, sweeps)
set -euo pipefail

url=${1:?usage: smoke.sh URL}
url=${url%/}
ready_s=${SMOKE_READY_S:-120}
sweep_s=${SMOKE_SWEEP_S:-120}
for tool in curl jq; do
    command -v "$tool" > /dev/null || { echo "smoke.sh needs $tool" >&2; exit 2; }
done

folder=$(mktemp -d)
sweep=
cleaned() {
    # a sweep that still runs is cancelled by the first and removed by the second
    [ -z "$sweep" ] || { ask DELETE "$sweep" && ask DELETE "$sweep"; } || true
    rm -r "$folder"
}
trap cleaned EXIT

# ask METHOD PATH [BODY]: the status in $status, headers and body in files
ask() {
    local options=(--silent --show-error --max-time 90 --request "$1" --output "$folder/body" --dump-header "$folder/headers")
    [ -z "${COUNTERWEIGHT_KEY:-}" ] || options+=(--config "$folder/key")
    [ $# -lt 3 ] || options+=(--header "Content-Type: application/json" --data-binary "$3")
    : > "$folder/body"
    : > "$folder/headers"
    status=$(curl "${options[@]}" --write-out '%{http_code}' "$url$2" 2> "$folder/error") || status=000
}

# expect STATUS WHAT [JQ ARGUMENTS]: the last answer had this status, and its JSON is as said
expect() {
    local wanted=$1 what=$2
    shift 2
    if [ "$status" != "$wanted" ] || { [ $# -gt 0 ] && ! jq --exit-status "$@" "$folder/body" > /dev/null; }; then
        echo "FAILED  $what (status $status, expected $wanted): $(cat "$folder/error")$(head --bytes 400 "$folder/body")" >&2
        exit 1
    fi
    echo "ok      $what"
}

# header NAME PATTERN: the last answer had a header that begins so
header() {
    grep --quiet --ignore-case "^$1: *$2" "$folder/headers" ||
        { echo "FAILED  header $1: $2 is missing" >&2; exit 1; }
}

# not on a command line, which other users of the machine can read
[ -z "${COUNTERWEIGHT_KEY:-}" ] ||
    (umask 077 && printf 'header = "Authorization: Bearer %s"\n' "$COUNTERWEIGHT_KEY" > "$folder/key")

# one crank, and two webs that can carry more than enough
machine='{"kind": "reciprocating", "speed_rpm": 600,
  "throws": [{"position_m": 0, "crank_radius_m": 0.1, "crank_angle_deg": 0, "rotating_mass_kg": 20, "rows": [
    {"axis_deg": 0, "reciprocating_mass_kg": 10, "connecting_rod": {"length_m": 0.5, "mass_kg": 6}}]}],
  "webs": [{"name": "a", "position_m": -0.1, "counterweight_radius_m": 0.1, "max_mass_kg": 40},
           {"name": "b", "position_m": 0.1, "counterweight_radius_m": 0.1, "max_mass_kg": 40}]}'
request="{\"machine\": $machine}"

for ((waited = 0; ; waited++)); do
    ask GET /readyz
    if [ "$status" = 200 ] || [ "$waited" -ge "$ready_s" ]; then break; fi
    sleep 1
done
expect 200 "ready" '.status == "ready"'

ask POST /v1/optimize "$request"
# the best that any counterweights can do: forward phasor (20 + 4) kg of rotating mass and (10 + 2) / 2 kg of the
# reciprocating mass at 0.1 m, so 30 kg opposite; what remains is the backward phasor, 6 kg at 0.1 m and 600 rpm
expect 200 "certified optimum" '
    .status == "optimal" and .certificate.gap >= 0 and .certificate.relative_gap <= 1e-6
    and .certificate.lower_bound <= .certificate.objective * (1 + 1e-12)
    and (.total_mass_kg - 30 | fabs) < 1e-3
    and (.residual.after.force.peak_N - 2368.705 | fabs) < 0.05
    and (.floor.force_N - 2368.705 | fabs) < 0.05'

ask POST /v1/optimize "${request/\"crank_radius_m\": 0.1/\"crank_radius_m\": -1}"
expect 422 "a wrong field is named" \
    '.status == 422 and any(.errors[]; .pointer == "/machine/throws/0/crank_radius_m")'
header content-type application/problem+json
ask POST /v1/optimize '{"machine": '
expect 400 "unreadable JSON is refused" '.status == 400'
header content-type application/problem+json

path=/machine/throws/0/rows/0/reciprocating_mass_kg
ask POST /v1/sweeps "{\"base\": $request, \"axes\": [{\"path\": \"$path\", \"values\": [4, 10, 16]}]}"
expect 202 "sweep taken in" '.total == 3'
sweep=/v1/sweeps/$(jq --raw-output .id "$folder/body")
for ((waited = 0; ; waited++)); do
    ask GET "$sweep"
    jq --exit-status '.state == "queued" or .state == "running"' "$folder/body" > /dev/null || break
    [ "$waited" -lt "$sweep_s" ] || break
    sleep 1
done
expect 200 "sweep done" '.state == "done" and .done == 3 and .failed == 0'
ask GET "$sweep/results?format=ndjson"
# rotating 24 kg and half of the reciprocating 2 kg + 4, 10, 16 kg
expect 200 "sweep results" --slurp '
    length == 3 and all(.[]; .status == "optimal")
    and ([.[].total_mass_kg] | (.[0] - 27 | fabs) < 1e-3 and (.[1] - 30 | fabs) < 1e-3 and (.[2] - 33 | fabs) < 1e-3)'
ask DELETE "$sweep"
expect 204 "sweep removed"
sweep=

if [ -n "${COUNTERWEIGHT_KEY:-}" ]; then
    rm "$folder/key" && COUNTERWEIGHT_KEY=
    ask POST /v1/optimize "$request"
    expect 401 "no answer without a key"
    header content-type application/problem+json
fi
