"""What stands in a document, and whether it is what was found."""

import json
import re
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]


def document(name: str) -> str:
    """Text of a file of the tree."""
    return (ROOT / name).read_text()


def section(name: str, heading: str) -> str:
    """Text below a heading of the second rank in a document."""
    return document(name).split(f"\n## {heading}\n")[1].split("\n## ")[0]


def blocks(text: str) -> list[Any]:
    """What the JSON in a text says."""
    return [json.loads(block) for block in re.findall(r"```json\n(.*?)```", text, re.DOTALL)]


def agrees(shown: Any, found: Any) -> None:
    """Everything shown is in what was found, to the digits shown."""
    if isinstance(shown, dict):
        for key, value in shown.items():
            agrees(value, found[key])
    elif isinstance(shown, list):
        assert len(shown) == len(found)
        for one, other in zip(shown, found, strict=True):
            agrees(one, other)
    elif isinstance(shown, float):
        assert found == pytest.approx(shown, rel=1e-4, abs=1e-8)
    else:
        assert shown == found
