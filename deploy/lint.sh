#!/usr/bin/env bash
# Check the files of this folder with the tools of .venv (part of `make lint`); a check that cannot run says so.
set -euo pipefail
cd "$(dirname "$0")"
bin=${BIN:-../.venv/bin}

# a tool of Python; jsonschema compiles forty grammars of addresses at each start, two thirds of it, unless it lacks what
# they are of: no schema here asks for that format
tool() {
    "$bin/python" -c 'import runpy, sys
sys.modules["rfc3987_syntax"] = None
del sys.argv[0]
runpy.run_path(sys.argv[0], run_name="__main__")' "$bin/$1" "${@:2}"
}

echo "Dockerfile: hadolint"
"$bin/hadolint" Dockerfile

echo "shell scripts: shellcheck"
"$bin/shellcheck" ./*.sh

echo "compose.yaml: schema of the compose specification"
tool check-jsonschema --builtin-schema vendor.compose-spec compose.yaml

echo "kubernetes/: schemas of Kubernetes, unknown fields refused"
# together: half of the time is to load the schemas
resources=$(find kubernetes overlays/cluster/{ingress,horizontalpodautoscaler}.yaml -type f ! -name kustomization.yaml)
mapfile -t files <<< "$resources"
tool kubernetes-validate --strict --quiet "${files[@]}"

echo "counterweight.service: systemd-analyze"
if command -v systemd-analyze > /dev/null; then
    unit=$(mktemp -d)
    trap 'rm -r "$unit"' EXIT
    # what the unit starts is not installed here
    sed 's|^ExecStart=[^ ]*|ExecStart=/bin/true|' counterweight.service > "$unit/counterweight.service"
    complaints=$(systemd-analyze verify --man=no "$unit/counterweight.service" 2>&1) || true
    if [ -n "$complaints" ]; then
        echo "$complaints" >&2
        exit 1
    fi
    # exposure from 0 to 100, as systemd judges it
    systemd-analyze security --offline=true --threshold=20 "$unit/counterweight.service" > "$unit/exposure" ||
        { cat "$unit/exposure" >&2; exit 1; }
else
    echo "NOT CHECKED: counterweight.service, as there is no systemd-analyze here (Debian: apt-get install systemd)" >&2
fi
