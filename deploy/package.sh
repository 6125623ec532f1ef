#!/usr/bin/env bash
# Build sdist and wheel into a folder, install the wheel in an empty environment, and have it answer outside of the tree.
#   deploy/package.sh [FOLDER]        artefacts/package if none is given; BIN is where hatchling is installed
set -euo pipefail
cd "$(dirname "$0")/.."
bin=$(realpath "${BIN:-.venv/bin}")
into=$(realpath -m "${1:-artefacts/package}")
elsewhere=$(mktemp -d)
trap 'rm -r "$elsewhere"' EXIT

echo "build sdist and wheel; the wheel is built from the sdist, which holds all that it needs"
rm -rf "$into"
mkdir -p "$into" "$elsewhere/source"
"$bin/python" -m hatchling build --target sdist --directory "$into" > /dev/null
tar --extract --gzip --strip-components 1 --directory "$elsewhere/source" --file "$into"/*.tar.gz
(cd "$elsewhere/source" && "$bin/python" -m hatchling build --target wheel --directory "$into" > /dev/null)

echo "install the locked packages, then the wheel alone, in an empty environment"
"$bin/python" -m venv "$elsewhere/env"
pip=("$elsewhere/env/bin/pip" --quiet --disable-pip-version-check)
deploy/install.sh "$elsewhere/env" requirements.txt
"${pip[@]}" install --no-deps "$into"/*.whl
deploy/check.sh "${pip[@]}"

echo "compile the kernels, and answer for the 2D12 outside of the tree"
cp examples/2d12.json "$elsewhere"
cd "$elsewhere"
rm -r source
env/bin/python -m optimizer.compile_kernels
env/bin/counterweight optimize 2d12.json --json > answer.json
env/bin/counterweight verify 2d12.json answer.json > /dev/null
env/bin/counterweight examples > /dev/null
env/bin/python - answer.json << 'PYTHON'
import json
import sys
from importlib.metadata import version
from pathlib import Path

import optimizer

answer = json.loads(Path(sys.argv[1]).read_text())
certificate = answer["certificate"]
assert Path(optimizer.__file__).is_relative_to(Path.cwd()), optimizer.__file__
assert answer["version"] == version("counterweight-optimizer"), answer["version"]
assert answer["status"] == "optimal", answer["status"]
# published in README.md; among optima the mass is certified to 1e-4
assert abs(answer["total_mass_kg"] - 232.699) < 232.699e-4, answer["total_mass_kg"]
assert certificate["relative_gap"] <= 1e-6, certificate
print(f"{answer['version']}: {answer['status']}, {answer['total_mass_kg']:.1f} kg, gap {certificate['relative_gap']:.1e}")
PYTHON
ls "$into"
