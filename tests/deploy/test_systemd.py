"""The unit of systemd; `make lint` has systemd itself read it."""

import configparser
import shlex
from pathlib import Path

from typer.main import get_command

from service.cli import app
from service.settings import Settings
from tests.deploy.files import DEPLOY, settings_variables


def unit() -> dict[str, list[str]]:
    """The settings of [Service], each as often as it is given."""
    text = (DEPLOY / "counterweight.service").read_text("utf-8")
    section = text.split("[Service]\n")[1].split("\n[")[0]
    fields: dict[str, list[str]] = {}
    for line in section.splitlines():
        if line and not line.startswith("#"):
            name, _, value = line.partition("=")
            fields.setdefault(name, []).append(value)
    return fields


def test_it_starts_a_command_that_there_is() -> None:
    program, command = shlex.split(unit()["ExecStart"][0])
    assert Path(program).name == "counterweight"
    assert command in get_command(app).commands  # type: ignore[attr-defined]


def test_it_names_settings_of_the_service() -> None:
    named = {variable.split("=")[0] for variable in unit()["Environment"]}
    assert "COUNTERWEIGHT_DATA_DIR" in named
    assert {name for name in named if name.startswith("COUNTERWEIGHT_")} <= settings_variables()


def test_it_writes_only_where_it_may() -> None:
    """With ProtectSystem=strict that is what the state and cache directories are for."""
    actual_unit = unit()
    assert actual_unit["ProtectSystem"] == ["strict"]
    folders = dict(variable.split("=", 1) for variable in actual_unit["Environment"])
    assert folders["COUNTERWEIGHT_DATA_DIR"] == f"%S/{actual_unit['StateDirectory'][0]}"
    assert folders["NUMBA_CACHE_DIR"] == f"%C/{actual_unit['CacheDirectory'][0]}"


def test_it_is_not_root() -> None:
    assert unit()["User"] == ["counterweight"]
    assert unit()["NoNewPrivileges"] == ["yes"]
    assert unit()["CapabilityBoundingSet"] == [""]


def test_memory_and_processors_are_limited() -> None:
    """And a worker that the kernel ends for its memory is the service's to replace, not a reason to end the service."""
    actual_unit = unit()
    assert {"MemoryMax", "CPUQuota", "TasksMax"} <= actual_unit.keys()
    assert actual_unit["OOMPolicy"] == ["continue"]


def test_kernels_may_be_compiled() -> None:
    """Machine code is made in memory, which MemoryDenyWriteExecute forbids."""
    assert "MemoryDenyWriteExecute" not in unit()


def test_it_waits_longer_for_the_end_than_the_service_needs() -> None:
    assert int(unit()["TimeoutStopSec"][0]) > 2 * Settings().graceful_shutdown_s


def test_it_can_be_installed() -> None:
    parser = configparser.RawConfigParser(strict=False)
    parser.read(DEPLOY / "counterweight.service")
    assert parser.get("Install", "WantedBy") == "multi-user.target"
