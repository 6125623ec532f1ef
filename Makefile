# Two commands do everything on a fresh machine: `make run` and `make test`.

PYTHON ?= python3
PORT ?= 8000
export PORT

bin := .venv/bin
pip := $(bin)/pip --quiet --disable-pip-version-check

.PHONY: install run test lint bench lock clean

install: .venv/runtime

run: .venv/runtime
	$(bin)/counterweight serve

test: lint
	$(bin)/pytest

lint: .venv/development
	$(bin)/ruff check .
	$(bin)/ruff format --check .
	$(bin)/mypy
	$(bin)/lint-imports

bench: .venv/development
	$(bin)/python -m tests.benchmarks

# new versions into the hashed lists; needs uv, commits names, versions and hashes only
lock:
	uv pip compile pyproject.toml --upgrade --generate-hashes --no-header --no-annotate --no-emit-index-url \
	    --group runtime-build --output-file requirements.txt
	uv pip compile pyproject.toml --generate-hashes --no-header --no-annotate --no-emit-index-url \
	    --constraint requirements.txt --group runtime-build --group dev --output-file requirements-dev.txt

clean:
	rm -rf .venv

.venv/runtime: requirements.txt pyproject.toml
	test -x $(bin)/python || $(PYTHON) -m venv .venv
	$(pip) install --require-hashes --requirement requirements.txt
	$(pip) install --no-deps --no-build-isolation --editable .
	touch $@

.venv/development: requirements-dev.txt .venv/runtime
	$(pip) install --require-hashes --requirement requirements-dev.txt
	touch $@
