"""What the check of the image needs, and that it says so; `make image-check` itself is for the night."""

import os
import re
import shutil
import subprocess
from pathlib import Path

from typer.main import get_command

from service.cli import app
from tests.deploy.files import DEPLOY, ROOT, instructions

SCRIPT = (DEPLOY / "image-check.sh").read_text("utf-8")


def check(tmp_path: Path, **programs: str) -> subprocess.CompletedProcess[str]:
    """Run the script where there are these programs and the most ordinary ones."""
    for name in ("bash", "dirname", "sed"):
        (tmp_path / name).symlink_to(str(shutil.which(name)))
    for name, text in programs.items():
        (tmp_path / name.replace("_", "-")).write_text(f"#!/bin/sh\n{text}\n")
        (tmp_path / name.replace("_", "-")).chmod(0o755)
    environment = {**os.environ, "PATH": str(tmp_path)}
    return subprocess.run(
        [tmp_path / "bash", DEPLOY / "image-check.sh"], env=environment, capture_output=True, text=True, check=False
    )


def test_it_says_that_it_needs_root(tmp_path: Path) -> None:
    process = check(tmp_path, id="echo 1000")
    assert process.returncode == 2
    assert "needs root" in process.stderr


def test_it_says_what_is_missing_and_cannot_be_installed(tmp_path: Path) -> None:
    process = check(tmp_path, id="echo 0", apt_get="exit 100", curl="exit 0")
    assert process.returncode == 2
    assert "needs buildah mmdebstrap jq, and could not install that" in process.stderr


def test_it_takes_the_release_of_the_official_base() -> None:
    (base,) = (rest for kind, rest in instructions() if kind == "ARG")
    pattern = re.search(r"sed -n '(.*)' deploy/Dockerfile", SCRIPT)
    assert pattern is not None
    process = subprocess.run(
        ["sed", "-n", pattern[1]], input=f"ARG {base}\n", capture_output=True, text=True, check=True
    )
    assert process.stdout.strip()
    assert f"-slim-{process.stdout.strip()}@" in base


def test_it_runs_commands_and_examples_that_there_are() -> None:
    commands = re.findall(r"counterweight ([a-z-]+) (\S+)", "\n".join(SCRIPT.split("\nstep ")[3:]))
    actual_commands = {command for command, _ in commands} - {"listens"}
    assert actual_commands <= set(get_command(app).commands)  # type: ignore[attr-defined]
    assert actual_commands >= {"optimize", "report", "sweep", "accuracy", "schema", "verify"}
    for _, argument in commands:
        if argument.endswith(".json"):
            assert any((ROOT / "examples").rglob(argument)), argument


def test_the_limit_is_the_one_that_is_written_down() -> None:
    limit = re.search(r"IMAGE_LIMIT_MB:-(\d+)", SCRIPT)
    assert limit is not None
    assert f"above {int(limit[1]):,} MB" in (ROOT / "docs" / "operation.md").read_text("utf-8")
