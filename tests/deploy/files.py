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
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    actual_module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(actual_module)
    return actual_module


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
    return dict(part.split("=", 1) for kind, rest in last if kind == "ENV" for part in rest.split())


def compose() -> dict[str, Any]:
    fields: dict[str, Any] = yaml.safe_load((DEPLOY / "compose.yaml").read_text("utf-8"))
    return fields


def manifests() -> dict[str, dict[str, Any]]:
    """The objects of Kubernetes by kind."""
    files = sorted(file for file in (DEPLOY / "kubernetes").iterdir() if file.stem != "kustomization")
    values = [yaml.safe_load(file.read_text("utf-8")) for file in files]
    assert len({manifest["kind"] for manifest in values}) == len(values)
    return {manifest["kind"]: manifest for manifest in values}
