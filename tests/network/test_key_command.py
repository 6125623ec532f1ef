"""``counterweight key``: keys are made, listed and revoked, and a right one is right."""

from pathlib import Path

import pytest
from click.testing import Result
from typer.testing import CliRunner

from service.cli import app
from service.guard.keys import Keys


def run(*arguments: str) -> Result:
    return CliRunner().invoke(app, ["key", *arguments])


@pytest.fixture
def file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    path = tmp_path / "keys"
    monkeypatch.setenv("COUNTERWEIGHT_KEYS_FILE", str(path))
    return path


def test_a_key_from_its_making_to_its_end(file: Path) -> None:
    made = run("create", "alice", "--scope", "read", "--scope", "metrics", "--days", "2", "--rate", "5/second")
    assert made.exit_code == 0
    key = made.stdout.strip()
    assert run("create", "bob").exit_code == 0
    caller = Keys(file).caller(key)
    assert caller is not None
    assert (caller.owner, caller.scopes, caller.rate_limit) == ("alice", frozenset({"read", "metrics"}), "5/second")
    listed = run("list").stdout
    assert "alice" in listed
    assert "compute, sweeps, read" in listed
    assert key not in listed
    assert caller.key is not None
    assert run("revoke", caller.key).exit_code == 0
    assert Keys(file).caller(key) is None
    assert "alice" not in run("list").stdout


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("create", "a b"), "owner: "),
        (("create", "a", "--scope", "everything"), "scopes: "),
        (("create", "a", "--rate", "often"), "is no rate"),
        (("revoke", "0123456789ab"), "cannot read the keys"),
        (("list",), "cannot read the keys"),
        (("create", "a", "--file", "/proc/none/keys"), "cannot write"),
    ],
)
def test_what_is_wrong_is_said(file: Path, arguments: tuple[str, ...], said: str) -> None:
    result = run(*arguments)
    assert result.exit_code == 2
    assert said in result.stderr
    assert "Traceback" not in result.stderr
    assert not file.exists()


def test_without_a_file_nothing_is_made(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("COUNTERWEIGHT_KEYS_FILE", raising=False)
    result = run("create", "alice")
    assert (result.exit_code, result.stdout) == (2, "")
    assert "COUNTERWEIGHT_KEYS_FILE" in result.stderr


def test_an_unknown_key_cannot_be_revoked(file: Path) -> None:
    assert run("create", "alice").exit_code == 0
    result = run("revoke", "0123456789ab")
    assert result.exit_code == 2
    assert "there is no key" in result.stderr
    assert len(file.read_text().splitlines()) == 1
