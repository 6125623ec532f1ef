"""The files of deploy/ as data."""

import importlib.util
from pathlib import Path
from types import ModuleType
from typing import Any

import yaml

from service.settings import Settings

ROOT = Path(__file__).parents[2]
DEPLOY = ROOT / "deploy"


def module(path: Path) -> ModuleType:
    """A script as a module."""
    found = importlib.util.spec_from_file_location(path.stem, path)
    assert found is not None
    assert found.loader is not None
    made = importlib.util.module_from_spec(found)
    found.loader.exec_module(made)
    return made


def settings_variables() -> set[str]:
    """The environment variables of all settings."""
    return {f"COUNTERWEIGHT_{name.upper()}" for name in Settings.model_fields}


def instructions() -> list[tuple[str, str]]:
    """The Dockerfile as instructions and their arguments, with the lines that go on joined."""
    text = (DEPLOY / "Dockerfile").read_text("utf-8")
    lines = [line for line in text.splitlines() if not line.lstrip().startswith("#")]
    joined = "\n".join(lines).replace("\\\n", " ").splitlines()
    return [
        (kind, " ".join(rest.split())) for kind, _, rest in (line.partition(" ") for line in joined if line.strip())
    ]


def dockerfile_environment() -> dict[str, str]:
    """ENV of the last stage."""
    last = instructions()[max(i for i, (kind, _) in enumerate(instructions()) if kind == "FROM") :]
    return dict(one.split("=", 1) for kind, rest in last if kind == "ENV" for one in rest.split())


def compose() -> dict[str, Any]:
    found: dict[str, Any] = yaml.safe_load((DEPLOY / "compose.yaml").read_text("utf-8"))
    return found


def manifests() -> dict[str, dict[str, Any]]:
    """The objects of Kubernetes by kind."""
    files = sorted(file for file in (DEPLOY / "kubernetes").iterdir() if file.stem != "kustomization")
    found = [yaml.safe_load(file.read_text("utf-8")) for file in files]
    assert len({one["kind"] for one in found}) == len(found)
    return {one["kind"]: one for one in found}
