"""Settings from the environment."""

import os
import re

import pytest
from pydantic import ValidationError

from service.settings import Settings, unknown_variables, variable, wrong_values
from tests.docs.reading import ROOT


@pytest.fixture(autouse=True)
def clean(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in [name for name in os.environ if name == "PORT" or name.startswith("COUNTERWEIGHT_")]:
        monkeypatch.delenv(name)


def test_defaults() -> None:
    settings = Settings()
    assert (settings.host, settings.port) == ("127.0.0.1", 8000)
    assert settings.max_body_bytes == 1_000_000
    assert settings.concurrent_solves == os.cpu_count()


def test_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COUNTERWEIGHT_HOST", "::1")
    monkeypatch.setenv("COUNTERWEIGHT_CONCURRENT_SOLVES", "3")
    monkeypatch.setenv("COUNTERWEIGHT_MAX_BODY_BYTES", "")
    monkeypatch.setenv("PORT", "9000")
    settings = Settings()
    assert (settings.host, settings.port, settings.concurrent_solves) == ("::1", 9000, 3)
    assert settings.max_body_bytes == 1_000_000
    monkeypatch.setenv("COUNTERWEIGHT_PORT", "9001")
    assert Settings().port == 9001
    assert Settings(port=9002).port == 9002


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("PORT", "http"),
        ("PORT", "70000"),
        ("COUNTERWEIGHT_CONCURRENT_SOLVES", "0"),
        ("COUNTERWEIGHT_MAX_BODY_BYTES", "0"),
        ("COUNTERWEIGHT_FRAME_ORIGINS", "*"),
        ("COUNTERWEIGHT_FRAME_ORIGINS", "https://portal.example.com/"),
        ("COUNTERWEIGHT_FRAME_ORIGINS", 'https://portal.example.com"; script-src *'),
    ],
)
def test_wrong_settings_are_refused(monkeypatch: pytest.MonkeyPatch, name: str, value: str) -> None:
    monkeypatch.setenv(name, value)
    with pytest.raises(ValidationError):
        Settings()


@pytest.mark.parametrize(
    ("name", "near"),
    [
        ("COUNTERWEIGHT_KEY_FILE", "COUNTERWEIGHT_KEYS_FILE"),
        ("COUNTERWEIGHT_KEYSFILE", "COUNTERWEIGHT_KEYS_FILE"),
        ("counterweight_allow_without_key", "COUNTERWEIGHT_ALLOW_WITHOUT_KEYS"),
        ("COUNTERWEIGHT_MAX_BODY", "COUNTERWEIGHT_MAX_BODY_BYTES"),
        ("COUNTERWEIGHT_", "COUNTERWEIGHT_"),
    ],
)
def test_an_unknown_variable_is_named_with_the_nearest(name: str, near: str) -> None:
    (message,) = unknown_variables({name: "1", "PATH": "/bin", "COUNTERWEIGHT_HOST": "::1"})
    assert message.startswith(f"{name}: ")
    assert near in message.partition(": ")[2]


def test_all_settings_and_the_variables_of_clients_are_known() -> None:
    """Independent: those that documents, examples and deployment files name."""
    folders = ("docs", "deploy", "examples")
    texts = [path for folder in folders for path in (ROOT / folder).rglob("*") if path.suffix != ".png"]
    pattern = re.compile(r"\bCOUNTERWEIGHT_[A-Z_]*[A-Z]\b")
    named = {name for path in texts if path.is_file() for name in pattern.findall(path.read_text("utf-8", "ignore"))}
    assert len(named) > 50
    assert list(unknown_variables(dict.fromkeys(named, "1"))) == []
    assert {variable(field) for field in Settings.model_fields} <= named


def test_a_wrong_value_names_its_variable_or_option(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COUNTERWEIGHT_LOG_LEVEL", "loud")
    monkeypatch.setenv("PORT", "http")
    with pytest.raises(ValidationError) as refused:
        Settings(lease_s=0)
    names = {message.partition(":")[0] for message in wrong_values(refused.value, {"lease_s": 0})}
    assert names == {"COUNTERWEIGHT_LOG_LEVEL", "PORT", "--lease_s"}
    monkeypatch.setenv("COUNTERWEIGHT_PORT", "0.5")
    with pytest.raises(ValidationError) as refused:
        Settings(lease_s=1)
    assert "COUNTERWEIGHT_PORT" in {message.partition(":")[0] for message in wrong_values(refused.value, {})}
    # names are read in small letters too, and told as they are written
    monkeypatch.delenv("COUNTERWEIGHT_PORT")
    monkeypatch.setenv("counterweight_port", "0.5")
    with pytest.raises(ValidationError) as refused:
        Settings(lease_s=1)
    assert "counterweight_port" in {message.partition(":")[0] for message in wrong_values(refused.value, {})}
