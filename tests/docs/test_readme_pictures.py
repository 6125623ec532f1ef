"""The pictures of the README are those that the service gives: ``make pictures``."""

import re
import struct
import sys
from pathlib import Path

import pytest

from tests.docs.reading import ROOT

sys.path.insert(0, str(ROOT / "docs"))
import readme_pictures


def _size(path: Path) -> tuple[int, int]:
    """Width and height of a PNG, px, from its first chunk."""
    head = path.read_bytes()[:24]
    assert head[:8] == b"\x89PNG\r\n\x1a\n"
    width, height = struct.unpack(">II", head[16:24])
    return width, height


def test_the_readme_shows_what_the_command_draws() -> None:
    matches = re.findall(r"!\[[^]]+\]\(docs/([^)]+)\)", (ROOT / "README.md").read_text())
    assert matches == [readme_pictures.PAGE, readme_pictures.REPORT, readme_pictures.FRONT]
    assert _size(readme_pictures.DOCS / readme_pictures.PAGE) == (1280, 900)
    assert _size(readme_pictures.DOCS / readme_pictures.REPORT) == tuple(readme_pictures.SHEET.values())


@pytest.mark.nightly
def test_pictures_are_as_the_service_gives_them_today(tmp_path: Path) -> None:
    readme_pictures.draw(tmp_path)
    # pixels of a browser differ by its version and carry the time of a computation; the front is the same to the letter
    drawn, committed = ((folder / readme_pictures.FRONT).read_bytes() for folder in (tmp_path, readme_pictures.DOCS))
    assert drawn == committed, "run `make pictures`"
    for name in (readme_pictures.PAGE, readme_pictures.REPORT):
        assert _size(tmp_path / name) == _size(readme_pictures.DOCS / name)
