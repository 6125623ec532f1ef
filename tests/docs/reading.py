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


def agrees(subject: Any, number: Any) -> None:
    """Everything shown is in what was found, to the digits shown."""
    if isinstance(subject, dict):
        for key, value in subject.items():
            agrees(value, number[key])
    elif isinstance(subject, list):
        assert len(subject) == len(number)
        for first, second in zip(subject, number, strict=True):
            agrees(first, second)
    elif isinstance(subject, float):
        assert number == pytest.approx(subject, rel=1e-4, abs=1e-8)
    else:
        assert subject == number
