"""The check for known faults says aloud what was not checked; pip-audit itself stands beside, as it needs a network."""

import json
import os
import subprocess
from pathlib import Path
from typing import Any

import pytest

from tests.deploy.files import DEPLOY

SOUND = {"name": "good", "version": "1", "vulns": []}
SKIPPED = {"name": "strange", "skip_reason": "not found"}
FAULTY = {"name": "bad", "version": "1.0", "vulns": [{"id": "CVE-2026-1", "fix_versions": ["1.1"]}]}


def audit(tmp_path: Path, values: list[dict[str, Any]] | None, code: int, log: str = "", strict: str = "0") -> Any:
    """Run the script with a pip-audit that finds and says what is given."""
    report = tmp_path / "report.json"
    if values is not None:
        report.write_text(json.dumps({"dependencies": values}))
    program = tmp_path / "pip-audit"
    program.write_text(
        '#!/bin/sh\nfor word; do [ "$last" = --output ] && out=$word; last=$word; done\n'
        f'[ ! -e {report} ] || cp {report} "$out"\necho "{log}"\nexit {code}\n'
    )
    program.chmod(0o755)
    return subprocess.run(
        [DEPLOY / "audit.sh", "list.txt"],
        env={**os.environ, "BIN": str(tmp_path), "AUDIT_STRICT": strict},
        capture_output=True,
        text=True,
        check=False,
    )


def test_nothing_known_is_said_with_how_many_were_asked_about(tmp_path: Path) -> None:
    ran = audit(tmp_path, [SOUND, SOUND], 0)
    assert ran.returncode == 0
    assert ran.stdout == "list.txt: 2 asked about, 0 faults known\n"
    assert ran.stderr == ""


def test_a_known_fault_fails_and_says_what_puts_it_right(tmp_path: Path) -> None:
    ran = audit(tmp_path, [SOUND, FAULTY], 1)
    assert ran.returncode == 1
    assert "FAULT CVE-2026-1 of bad 1.0, put right in 1.1" in ran.stderr


@pytest.mark.parametrize(("strict", "code"), [("0", 0), ("1", 1)])
def test_what_was_not_found_is_said_aloud(tmp_path: Path, strict: str, code: int) -> None:
    """pip-audit itself ends with 0 and says that no vulnerability is known."""
    ran = audit(tmp_path, [SOUND, SKIPPED], 0, strict=strict)
    assert ran.returncode == code
    assert "NOT CHECKED for known faults: in list.txt: strange" in ran.stderr


@pytest.mark.parametrize(("strict", "code"), [("0", 0), ("1", 1)])
def test_a_service_out_of_reach_is_said_aloud(tmp_path: Path, strict: str, code: int) -> None:
    ran = audit(tmp_path, None, 1, "requests.exceptions.ConnectionError: Max retries exceeded", strict)
    assert ran.returncode == code
    assert "NOT CHECKED for known faults: list.txt" in ran.stderr


def test_any_other_failure_fails(tmp_path: Path) -> None:
    ran = audit(tmp_path, None, 2, "no such option")
    assert ran.returncode == 1
    assert "no such option" in ran.stderr
