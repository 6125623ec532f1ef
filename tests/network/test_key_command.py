"""``counterweight key``: keys are made, listed and revoked, and a right one is right."""

import threading
from pathlib import Path

import pytest
from click.testing import Result
from typer.testing import CliRunner

from service.cli import app
from service.guard import keys
from service.guard.keys import Keys


def run(*arguments: str) -> Result:
    return CliRunner().invoke(app, ["key", *arguments])


@pytest.fixture
def file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    path = tmp_path / "keys"
    monkeypatch.setenv("COUNTERWEIGHT_KEYS_FILE", str(path))
    return path


def test_a_key_from_its_making_to_its_end(file: Path) -> None:
    process = run("create", "alice", "--scope", "read", "--scope", "metrics", "--days", "2", "--rate", "5/second")
    assert process.exit_code == 0
    key = process.stdout.strip()
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
    ("arguments", "text"),
    [
        (("create", "a b"), "owner: "),
        (("create", "a", "--scope", "everything"), "scopes: "),
        (("create", "a", "--rate", "often"), "is no rate"),
        (("revoke", "0123456789ab"), "cannot read the keys"),
        (("list",), "cannot read the keys"),
        (("create", "a", "--file", "/proc/none/keys"), "cannot write"),
    ],
)
def test_what_is_wrong_is_said(file: Path, arguments: tuple[str, ...], text: str) -> None:
    result = run(*arguments)
    assert result.exit_code == 2
    assert text in result.stderr
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


def test_of_two_changes_at_a_time_none_is_lost(file: Path) -> None:
    def add(owner: str) -> None:
        with keys.changed(file, new=True) as site:
            site.append(keys.make(owner, ("read",))[1])

    threads = [threading.Thread(target=add, args=(f"other{number}",)) for number in range(3)]
    with keys.changed(file, new=True) as records:
        for thread in threads:
            thread.start()
        # long enough for one that does not wait; one that does may take as long as it likes
        for single_thread in threads:
            single_thread.join(0.2)
        assert not file.exists()
        records.append(keys.make("first", ("read",))[1])
    for second_thread in threads:
        second_thread.join()
    assert sorted(record.owner for record in keys.read(file)) == ["first", "other0", "other1", "other2"]
    assert file.stat().st_mode & 0o777 == 0o600


def test_a_change_that_raises_changes_nothing(file: Path) -> None:
    assert run("create", "alice").exit_code == 0
    before = file.read_bytes()

    def half() -> None:
        with keys.changed(file) as site:
            site.clear()
            raise ArithmeticError

    with pytest.raises(ArithmeticError):
        half()
    assert file.read_bytes() == before
