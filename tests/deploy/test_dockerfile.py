"""The image: what it is made of, who runs in it, and what it writes to; `make image-check` builds it."""

import json
import os
import re
import shlex
import subprocess
from fnmatch import fnmatch
from pathlib import Path

import pytest
from typer.main import get_command

from service.cli import app
from service.settings import Settings
from tests.deploy.files import DEPLOY, ROOT, dockerfile_environment, instructions, settings_variables


def copied() -> list[str]:
    """Sources of COPY from the context."""
    parts = (shlex.split(rest) for kind, rest in instructions() if kind == "COPY")
    return [source for words in parts if not words[0].startswith("--from") for source in words[:-1]]


def last(kind: str) -> str:
    return [rest for text, rest in instructions() if text == kind][-1]


def test_everything_copied_is_there_and_reaches_the_builder() -> None:
    ignored = (DEPLOY / "Dockerfile.dockerignore").read_text("utf-8").split()
    assert "*" in ignored
    for source in copied():
        assert (ROOT / source).exists(), source
        assert any(fnmatch(source, line[1:]) for line in ignored if line.startswith("!")), source


def test_nothing_reaches_the_builder_that_is_not_copied() -> None:
    ignored = (DEPLOY / "Dockerfile.dockerignore").read_text("utf-8").split()
    assert {line[1:] for line in ignored if line.startswith("!")} == set(copied())


def test_every_package_is_copied() -> None:
    assert {"schemas", "optimizer", "service", "examples"} <= set(copied())


def test_packages_come_by_hash_and_as_wheels() -> None:
    installs = [rest for kind, rest in instructions() if kind == "RUN" and " install " in rest and "pip" in rest]
    assert len(installs) == 2
    assert "--require-hashes" in installs[0]
    assert "--only-binary :all:" in installs[0]
    assert "--no-deps" in installs[1]


def test_the_base_is_named_by_digest() -> None:
    assert re.fullmatch(r"BASE=python:3\.11-slim-bookworm@sha256:[0-9a-f]{64}", last("ARG"))
    assert [rest.split()[0] for kind, rest in instructions() if kind == "FROM"] == ["${BASE}", "${BASE}"]


def test_kernels_are_compiled_of_what_is_installed() -> None:
    """They are kept by the path of their source, and Python prefers sources in the working directory."""
    steps = instructions()
    (compiling,) = (n for n, (kind, rest) in enumerate(steps) if kind == "RUN" and "compile_kernels" in rest)
    (installed,) = (
        n for n, (kind, rest) in enumerate(steps) if kind == "RUN" and "pip" in rest and "--no-build-isolation" in rest
    )
    *_, folder = (rest for kind, rest in steps[:compiling] if kind == "WORKDIR")
    *_, sources = (rest for kind, rest in steps[:installed] if kind == "WORKDIR")
    assert folder != sources


def test_nobody_is_root_in_it() -> None:
    user, group = map(int, last("USER").split(":"))
    assert user > 0
    assert group > 0


def test_its_environment_is_one_of_the_service(monkeypatch: pytest.MonkeyPatch) -> None:
    environment = dockerfile_environment()
    for name, value in environment.items():
        if name.startswith("COUNTERWEIGHT_"):
            assert name in settings_variables()
            monkeypatch.setenv(name, value)
    settings = Settings()
    assert (settings.host, settings.port) == ("0.0.0.0", 8000)
    assert settings.data_dir == Path(last("VOLUME")) == Path(last("WORKDIR"))
    # not open to everybody by default: without a file of keys the service does not start
    assert settings.keys_file is not None
    assert not settings.allow_without_keys
    assert last("EXPOSE") == str(settings.port)


def test_it_writes_to_the_volume_and_to_tmp_alone() -> None:
    environment = dockerfile_environment()
    for name in ("COUNTERWEIGHT_DATA_DIR", "COUNTERWEIGHT_KEYS_FILE", "NUMBA_CACHE_DIR"):
        assert Path(environment[name]).is_relative_to(last("VOLUME")) or Path(environment[name]).is_relative_to(
            "/tmp"
        ), name


def _compiling() -> str:
    (run,) = (rest for kind, rest in instructions() if kind == "RUN" and "NUMBA_CPU_NAME" in rest)
    return run


def test_the_kernels_of_the_build_are_those_of_the_run() -> None:
    """numba keeps kernels by processor: made for one model, they would be compiled anew on another."""
    build = next(rest for kind, rest in instructions() if kind == "ENV")
    assert 'NUMBA_CPU_FEATURES=""' in build
    # the entrypoint chooses among the two that are there
    assert "NUMBA_CPU_NAME" not in dockerfile_environment()
    assert _compiling().startswith('for name in generic "$(processor)"; do export NUMBA_CPU_NAME="$name";')
    folder = next(word.split("=")[1] for word in build.split() if word.startswith("NUMBA_CACHE_DIR"))
    assert f"${{COMPILED:-{folder}}}" in (DEPLOY / "entrypoint.sh").read_text("utf-8")


def test_the_kernels_are_compiled_by_commands_that_there_are() -> None:
    """What they compute is copied to the builder."""
    commands = re.findall(r"(counterweight) (\w+) (\S+)", _compiling())
    assert len(commands) == 2
    for _, name, source in commands:
        assert name in get_command(app).commands  # type: ignore[attr-defined]
        assert (ROOT / Path(source).relative_to("/src")).exists()


_V3 = "fpu sse4_2 avx avx2 bmi1 bmi2 f16c fma abm movbe xsave"


@pytest.mark.parametrize(
    ("flags", "name"),
    [
        (_V3, "x86-64-v3"),
        (_V3.replace(" avx2", ""), "generic"),
        (_V3.replace(" fma", " fma4"), "generic"),
        ("", "generic"),
    ],
)
def test_the_processor_is_told_by_all_its_flags(tmp_path: Path, flags: str, name: str) -> None:
    """Published: what x86-64-v3 adds, psABI of AMD64, table 3.1."""
    file = tmp_path / "cpuinfo"
    file.write_text(f"processor : 0\nflags\t\t: {flags}\nprocessor : 1\nflags : {_V3}\n")
    environment = {**os.environ, "CPUINFO": str(file)}
    process = subprocess.run([DEPLOY / "processor.sh"], env=environment, capture_output=True, text=True, check=True)
    assert process.stdout.strip() == name


@pytest.mark.parametrize(
    ("before", "after"), [("", "x86-64-v3/"), ("generic", "generic/"), ("x86-64-v3", "x86-64-v3/")]
)
def test_kernels_are_loaded_for_the_processor_unless_the_operator_names_one(
    compiled: Path, tmp_path: Path, before: str, after: str
) -> None:
    tools = tmp_path / "bin"
    tools.mkdir()
    (tools / "processor").symlink_to(DEPLOY / "processor.sh")
    cpu = tmp_path / "cpuinfo"
    cpu.write_text(f"flags : {_V3}\n")
    more = {"PATH": f"{tools}:{os.environ['PATH']}", "CPUINFO": str(cpu), "NUMBA_CPU_NAME": before}
    text = 'echo "$NUMBA_CPU_NAME/${NUMBA_CPU_FEATURES-unset}"'
    process = enter(compiled, tmp_path / "numba", "sh", "-c", text, **more)
    assert (process.returncode, process.stdout.strip()) == (0, after)


def test_the_health_check_asks_for_readiness() -> None:
    command = json.loads(last("HEALTHCHECK").split("CMD ")[1])
    assert command[0] == "python"
    compile(command[2], "healthcheck", "exec")
    assert "/readyz" in command[2]


@pytest.fixture
def compiled(tmp_path: Path) -> Path:
    folder = tmp_path / "compiled"
    (folder / "program").mkdir(parents=True)
    (folder / "program" / "kernel.nbi").write_bytes(b"kernel")
    return folder


def enter(compiled: Path, cache: Path, *command: str, **more: str) -> subprocess.CompletedProcess[str]:
    fields = {"COMPILED": str(compiled), "NUMBA_CACHE_DIR": str(cache), "NUMBA_CPU_NAME": "generic", **more}
    environment = {name: value for name, value in {**os.environ, **fields}.items() if name != "NUMBA_CPU_FEATURES"}
    return subprocess.run(
        [DEPLOY / "entrypoint.sh", *command], env=environment, capture_output=True, text=True, check=False
    )


def test_the_kernels_are_put_where_they_can_be_written(compiled: Path, tmp_path: Path) -> None:
    cache = tmp_path / "numba"
    process = enter(compiled, cache, "cat", str(cache / "program" / "kernel.nbi"))
    assert (process.returncode, process.stdout) == (0, "kernel")
    assert os.access(cache, os.W_OK)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["compiled", "numba"]


def test_kernels_that_were_compiled_since_are_left_alone(compiled: Path, tmp_path: Path) -> None:
    cache = tmp_path / "numba"
    enter(compiled, cache, "true")
    (cache / "program" / "kernel.nbi").write_bytes(b"newer")
    process = enter(compiled, cache, "cat", str(cache / "program" / "kernel.nbi"))
    assert process.stdout == "newer"


def test_the_command_takes_the_place_of_the_shell_and_its_code_is_that_of_the_container(
    compiled: Path, tmp_path: Path
) -> None:
    process = enter(compiled, tmp_path / "numba", "sh", "-c", "exit 7")
    assert process.returncode == 7
    assert (DEPLOY / "entrypoint.sh").read_text().rstrip().endswith('exec "$@"')
