"""Subjects of the last commits: `area: verb ...`, 72 characters at most (docs/style.md)."""

import re
import subprocess

import pytest

from tests.docs.reading import ROOT

LONGEST = 72
_SUBJECT = re.compile(r"[a-z0-9_./-]+(?:, [a-z0-9_./-]+)*: [a-z]\S* \S.*[^.\s]")


def faults(subjects: list[str]) -> list[str]:
    """Those that are too long or name no area."""
    return [subject for subject in subjects if len(subject) > LONGEST or not _SUBJECT.fullmatch(subject)]


def test_the_last_commits() -> None:
    if not (ROOT / ".git").exists():
        pytest.skip("no history beside this tree")
    command = ["git", "log", "-20", "--no-merges", "--format=%s"]
    ran = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    assert faults(ran.stdout.splitlines()) == []


@pytest.mark.parametrize(
    ("subject", "good"),
    [
        ("docs: state what is measured", True),
        ("tests, docs: match smaller sets", True),
        ("The guess of plates, as it is", False),
        ("docs: State it", False),
        ("docs: end with a full stop.", False),
        ("docs:", False),
        ("docs: " + "very " * 14 + "long", False),
    ],
)
def test_subjects(subject: str, good: bool) -> None:
    assert faults([subject]) == ([] if good else [subject])
