#!/usr/bin/env bash
# Faults that are known of what requirements lists name (part of `make audit`). The service that knows them has to be
# reached; what it was not asked or does not know is said aloud, and fails with AUDIT_STRICT=1.
#   deploy/audit.sh REQUIREMENTS...
set -euo pipefail
bin=${BIN:-.venv/bin}
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT

unchecked() {
    echo "NOT CHECKED for known faults: $1" >&2
    [ "${AUDIT_STRICT:-0}" != 1 ] || exit 1
}

for list in "$@"; do
    code=0
    "$bin/pip-audit" --requirement "$list" --require-hashes --disable-pip --progress-spinner off --timeout 15 \
        --format json --output "$folder/found" > "$folder/log" 2>&1 || code=$?
    if [ ! -s "$folder/found" ]; then
        if ! grep --quiet --extended-regexp 'ConnectionError|ConnectTimeout|ReadTimeout|ProxyError|Max retries' "$folder/log"; then
            cat "$folder/log" >&2
            exit 1
        fi
        unchecked "$list, as the service that knows them cannot be reached"
        continue
    fi
    # pip-audit says "no known vulnerabilities" also of what it could not find, and ends with 0
    skipped=$(jq --raw-output '[.dependencies[] | select(.skip_reason) | .name] | join(" ")' "$folder/found")
    asked=$(jq '[.dependencies[] | select(.vulns)] | length' "$folder/found")
    [ -z "$skipped" ] || unchecked "in $list: $skipped"
    jq --raw-output '.dependencies[] | . as $one | (.vulns // [])[]
        | "FAULT \(.id) of \($one.name) \($one.version), put right in \(.fix_versions | join(", "))"' "$folder/found" >&2
    echo "$list: $asked asked about, $(jq '[.dependencies[].vulns // [] | length] | add // 0' "$folder/found") faults known"
    [ "$code" = 0 ] || exit "$code"
    rm "$folder/found"
done
