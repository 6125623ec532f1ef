"""Settings from the environment."""

import os

import pytest
from pydantic import ValidationError

from service.settings import Settings


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
