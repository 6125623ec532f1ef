# Two commands do everything on a fresh machine: `make run` and `make test`.

PYTHON ?= python3
PORT ?= 8000
export PORT

bin := .venv/bin
kernels := optimizer/program/kernel/__pycache__/kernels
loaded := service.app, service.cli, service.wire.server, service.workers.worker, sqlalchemy.dialects.sqlite, \
    anyio._backends._asyncio, uvicorn.lifespan.on, uvicorn.loops.asyncio
pip := $(bin)/pip --quiet --disable-pip-version-check

.PHONY: install run test tests quick bytecode chromium freecad mono lint bench hard validate nightly lock settings map pictures docs package image image-check smoke sbom licences audit clean

install: $(kernels)

# bytecode is kept here and for tests: a process that reads all packages from their source starts 0.7 s later
run: export PYTHONDONTWRITEBYTECODE :=
run: $(kernels)
	$(bin)/counterweight serve

# Kernels are compiled while what tests need is installed, and the code is checked while kernels are compiled, browsers
# downloaded and tests run: many tests wait for other processes (tests/distribution.py), so two cores have room for seven.
# Types take half a minute of a core: one that kernels, which tests wait for, and then their collection leave.
test: export PYTHONDONTWRITEBYTECODE :=
test: export behind := nice
test:
	$(MAKE) --no-print-directory --jobs 3 lint tests

# not by the command of pytest, which every process that a test starts workers from would run anew
tests: mono bytecode $(kernels)
	$(bin)/python -m pytest --numprocesses 7 -m "not nightly"

# what goes wrong first, within a minute: for between the changes, not in place of all tests
quick: .venv/development $(kernels)
	$(bin)/ruff check .
	$(bin)/ruff format --check .
	$(bin)/mypy
	$(bin)/lint-imports
	$(bin)/python -m pytest --quiet --numprocesses 2 tests/schemas tests/effects tests/outputs \
	    tests/service/test_computations.py tests/optimize/test_optimize.py

# where PYTHONDONTWRITEBYTECODE is set, every process would read all modules from their source, a third of its start
bytecode: .venv/runtime
	$(bin)/python -m compileall -q schemas optimizer service

# compiled once, in half a minute, not by every process that needs them; while one core compiles what all of them need,
# the other one makes bytecode of the packages that a service loads;
# numba looks for changes in the file of a kernel only, not in the files of those that it calls; where tests have brought
# colorama, it colours what it says to itself of each operator that a pair of types has not
$(kernels): optimizer/numerics/compiling.py $(wildcard optimizer/*/kernel/*.py optimizer/*/*/kernel/*.py) .venv/runtime
	rm -f optimizer/*/kernel/__pycache__/*.nb[ic] optimizer/*/*/kernel/__pycache__/*.nb[ic]
	$(MAKE) --no-print-directory bytecode && PYTHONDONTWRITEBYTECODE= $(bin)/python -c "import $(loaded)" & loads=$$!; \
	NUMBA_DISABLE_ERROR_MESSAGE_HIGHLIGHTING=1 $(bin)/python -m optimizer.compile_kernels && wait $$loads
	mkdir -p $(@D) && touch $@

# the tests of the page need a browser: Debian's package, where it may be installed; else it says what is not tested
chromium: .venv/development
	$(bin)/python -m tests.browser.chromium

# as the tests of the workbench need FreeCAD: some minutes of installing, once; packages are installed by one at a time
freecad: chromium
	$(bin)/python -m tests.freecad.freecad

# as the example of a client in C# needs Mono
mono: freecad
	$(bin)/python -m tests.clients.mono

lint: .venv/development
	$(bin)/ruff check .
	$(bin)/ruff format --check .
	$(behind) $(bin)/mypy
	$(bin)/lint-imports
	$(bin)/deno lint --quiet
	DENO_NO_UPDATE_CHECK=1 $(bin)/deno check --quiet --no-remote service/portal/static
	deploy/lint.sh

bench: .venv/development $(kernels)
	$(bin)/python -m tests.benchmarks

# hard cases of the program and of the effects against high-precision references, and of programs over the whole turn
# against samples: a summary of each
hard: .venv/development $(kernels)
	failed=0; $(bin)/python -m tests.hard || failed=1; $(bin)/python -m tests.hard_effects || failed=1; \
	$(bin)/python -m tests.hard_turn || failed=1; exit $$failed

# docs/validation.md, computed now: published figures, crank arrangements, and rigid bodies in a multibody program
validate: .venv/development $(kernels)
	$(bin)/python -m tests.validation

# hours: every test, with ten times the examples and every answer through the checker; the references against references of
# their own, and what the tests do a few times, thousands of times; the image needs root
long := tests.choices.against_rounding tests.hard.bodies tests.hard.boundary tests.hard.checked tests.hard.far_limits tests.hard.tampered tests.hard.worst_case tests.jobs.clocks tests.jobs.crashes tests.jobs.failover \
    tests.jobs.flips tests.jobs.history tests.jobs.kills tests.jobs.statements tests.network.attacks tests.network.bystander tests.network.load \
    tests.network.schema tests.verification.fabricated tests.verification.genuine
nightly: .venv/development $(kernels)
	failed=0; $(MAKE) hard || failed=1; \
	HYPOTHESIS_PROFILE=night CHECKED_ANSWERS=every $(bin)/python -m pytest --numprocesses 4 || failed=1; \
	$(MAKE) image-check || failed=1; \
	$(bin)/python -m tests.mutation --count 300 || failed=1; \
	for module in $(long); do echo "$$module"; $(bin)/python -m $$module || failed=1; done; exit $$failed

# new versions into the hashed lists: names, versions and hashes only
pinned := $(bin)/uv --quiet pip compile --upgrade --generate-hashes --no-header --no-annotate --no-emit-index-url
compile := $(pinned) pyproject.toml --group runtime-build
lock: .venv/development
	$(compile) --output-file requirements.txt
	$(compile) --constraint requirements.txt --group dev --output-file requirements-dev.txt
	$(compile) --constraint requirements-dev.txt --all-extras --output-file deploy/requirements.txt
	$(pinned) --constraint requirements-dev.txt --group pyproject.toml:install --output-file deploy/uv.txt

# the table of docs/operation.md and deploy/.env.example, from service/settings.py
settings: .venv/runtime
	PYTHONPATH=. $(bin)/python docs/settings.py

# the pictures and the table of docs/architecture.md, from the code
map: .venv/runtime
	$(bin)/python docs/room_map.py
	$(bin)/python docs/sequences.py

# the three pictures of the README, from a service that it starts
pictures: .venv/development $(kernels) | chromium
	$(bin)/python docs/readme_pictures.py

# the documents as a site in artefacts/site, without a network
docs: .venv/development
	NO_MKDOCS_2_WARNING=1 $(bin)/mkdocs build --strict --quiet

# sdist and wheel in artefacts/package, installed in an empty environment and asked for the 2D12 there
package: .venv/development
	deploy/package.sh

image:
	docker build --file deploy/Dockerfile --tag counterweight:latest .

# built, measured and run without a container engine; minutes, as root
image-check:
	deploy/image-check.sh

smoke:
	deploy/smoke.sh $(or $(URL),http://127.0.0.1:$(PORT))

# ---- what the image holds: parts, licences, known faults

sbom: build/runtime/made
	mkdir -p artefacts
	$(bin)/cyclonedx-py environment build/runtime/bin/python --pyproject pyproject.toml --mc-type application \
	    --output-reproducible --output-format JSON --output-file artefacts/sbom.cdx.json

# fails on a licence that is not in the list
licences: build/runtime/made
	$(bin)/pip-licenses --python build/runtime/bin/python --with-system --with-urls --ignore-packages counterweight-optimizer \
	    --allow-only "$$(grep -v '^#' deploy/licences.txt | paste -sd ';')"

# the hash of every package was compared when build/runtime was made; needs no network but for the known faults
audit: licences
	deploy/audit.sh requirements.txt requirements-dev.txt deploy/requirements.txt

clean:
	rm -rf .venv build artefacts

# its own pip would take three seconds: that of $(PYTHON) brings uv, which brings the rest;
# an older checkout was installed by a name that is not ours
.venv/runtime: requirements.txt deploy/uv.txt deploy/install.sh pyproject.toml
	@echo "first of two steps: $$(grep -c == requirements.txt) packages into .venv; then the kernels"
	test -x $(bin)/python || $(PYTHON) -m venv --without-pip .venv
	PYTHON="$(PYTHON)" deploy/install.sh .venv requirements.txt
	! ls -d .venv/lib/python*/site-packages/counterweight-[0-9]* > /dev/null 2>&1 || $(pip) uninstall --yes counterweight
	deploy/install.sh .venv --editable .
	touch $@

.venv/development: requirements-dev.txt .venv/runtime
	deploy/install.sh .venv requirements-dev.txt
	touch $@

# as in the image: locked versions with their hashes, wheels only, without pip and what nothing imports
build/runtime/made: deploy/requirements.txt deploy/prune.py deploy/unused.txt pyproject.toml .venv/development
	rm -rf build/runtime
	$(PYTHON) -m venv --without-pip build/runtime
	$(pip) --python build/runtime/bin/python install --no-deps --require-hashes --only-binary :all: \
	    --requirement deploy/requirements.txt
	$(pip) --python build/runtime/bin/python install --no-deps --no-build-isolation .
	deploy/check.sh $(pip) --python build/runtime/bin/python
	build/runtime/bin/python deploy/prune.py deploy/unused.txt
	touch $@
