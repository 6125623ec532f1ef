"""The file of keys: read while the service runs, refused by line, and what is noted of it."""

import json
import time
from pathlib import Path
from types import SimpleNamespace

import pytest

from service.app import create_app
from service.guard import keys
from service.guard.keys import BadKeyFile, KeyRecord
from service.settings import Settings


def test_keys_come_and_go_while_the_service_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(keys, "_LOOK_S", 0.0)
    file = tmp_path / "keys"
    (old, first), (new, second) = keys.make("a", ("read",)), keys.make("a", ("read",))
    keys.write(file, [first])
    key_file = keys.Keys(file)
    keys.write(file, [first, second])
    assert key_file.caller(old) == key_file.caller(old)
    assert key_file.caller(new) is not None
    keys.write(file, [second])
    assert key_file.caller(old) is None
    file.write_text("nonsense")
    # a file that is wrong for a moment takes nobody's key away
    assert key_file.caller(new) is not None


def test_the_file_is_looked_at_no_more_often_than_it_may(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    now = 1000.0
    monkeypatch.setattr(keys, "time", SimpleNamespace(monotonic=lambda: now, time=time.time))
    (_, first), (new, second) = keys.make("a", ("read",)), keys.make("a", ("read",))
    keys.write(tmp_path / "keys", [first])
    key_file = keys.Keys(tmp_path / "keys")
    keys.write(tmp_path / "keys", [first, second])
    now += 0.9 * keys._LOOK_S
    assert key_file.caller(new) is None
    now += 0.2 * keys._LOOK_S
    assert key_file.caller(new) is not None


def test_a_file_that_is_gone_takes_no_key_away_and_is_told_of_once(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(keys, "_LOOK_S", 0.0)
    file = tmp_path / "keys"
    (old, first), (new, second) = keys.make("a", ("read",)), keys.make("b", ("read",))
    keys.write(file, [first])
    key_file = keys.Keys(file)
    file.unlink()
    assert [key_file.caller(key) is None for key in (old, old, new, old)] == [False, False, True, False]
    assert caplog.text.count("cannot read the keys") == 1
    keys.write(file, [second])
    assert [key_file.caller(key) is None for key in (old, new)] == [True, False]


@pytest.mark.parametrize(
    ("line", "place"),
    [
        ("{}", "id"),
        ("[]", "line"),
        ("\x00", "line"),
        ('{"id":1}', "id"),
        ("x" * 10_000, "line"),
        ('{"id":1,"x":2}', "id"),
    ],
)
def test_a_file_that_holds_no_keys_is_refused_by_line(tmp_path: Path, line: str, place: str) -> None:
    """By the first field that is wrong; by the line where it is no object."""
    file = tmp_path / "keys"
    file.write_text(f"\n{line}\n")
    with pytest.raises(BadKeyFile, match=f"line 2: {place}: "):
        keys.keys(Settings(keys_file=file))
    with pytest.raises(BadKeyFile, match="No such file"):
        keys.keys(Settings(keys_file=tmp_path / "none"))


@pytest.mark.parametrize("host", ["0.0.0.0", "::", "10.0.0.1", "service.example"])
def test_no_other_machine_is_served_without_keys_by_accident(host: str) -> None:
    with pytest.raises(ValueError, match="COUNTERWEIGHT_KEYS_FILE"):
        create_app(Settings(host=host))
    assert keys.keys(Settings(host=host, allow_without_keys=True)) is None


@pytest.mark.parametrize("host", ["127.0.0.1", "::1", "localhost", "127.9.9.9"])
def test_on_loopback_nobody_needs_a_key(host: str) -> None:
    assert keys.keys(Settings(host=host)) is None


def test_records_hold_what_they_say() -> None:
    key, record = keys.make("portal", ("compute",), expires=5.0, rate_limit="1/second")
    assert key.startswith(f"cw_{record.id}_")
    assert KeyRecord.model_validate_json(record.model_dump_json()) == record
    assert json.loads(record.model_dump_json())["owner"] == "portal"


def test_use_and_change_of_keys_are_noted(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(keys, "_LOOK_S", 0.0)
    (text, first), (words, second) = keys.make("portal", ("read",)), keys.make("cad", ("compute",))
    old, expired = keys.make("old", ("read",), expires=1.0)
    _, unused = keys.make("idle", ("read",))
    file = tmp_path / "keys.jsonl"
    keys.write(file, [first, expired, unused])
    caplog.set_level("INFO", "service.audit")
    key_file = keys.Keys(file)
    for passage in (text, text, old, old, "cw_wrong"):
        key_file.caller(passage)
    keys.write(file, [second, expired.model_copy(update={"expires": 2.0}), unused])
    key_file.caller(text)
    key_file.caller(words)
    values = [(record.getMessage().split(" ", 2)[2], vars(record)["owner"]) for record in caplog.records]
    assert values[:2] == [("used for the first time since the start", "portal"), ("refused, as it has expired", "old")]
    assert sorted(values[2:-1]) == [("added", "cad"), ("changed", "old"), ("revoked", "portal")]
    assert values[-1] == ("used for the first time since the start", "cad")
    assert not any(secret in caplog.text for secret in (text, words, old, first.sha256))
