"""The examples of a property are the same in every run, whatever was run before in its process."""

import importlib.util
import sys
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

NUMBERS = range(700_000_001, 700_002_001, 10)


def tried() -> list[int]:
    numbers: list[int] = []

    @settings(max_examples=300)
    @given(st.integers())
    def look(number: int) -> None:
        numbers.append(number)

    look()
    return numbers


def test_what_is_loaded_changes_no_examples(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = tried()
    module = tmp_path / "numbers_of_ours.py"
    module.write_text(f"ALL = {list(NUMBERS)}\n")
    spec = importlib.util.spec_from_file_location(module.stem, module)
    assert spec is not None
    assert spec.loader is not None
    loaded = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, module.stem, loaded)
    spec.loader.exec_module(loaded)
    assert len(before) == 300
    assert tried() == before
