"""docs/validation.md shows what the pack finds; one machine of the three goes through the multibody program here."""

import re
from pathlib import Path

import pytest

from optimizer.outputs.registry import OUTPUTS
from service.documents.examples import bodies as examples
from tests.validation import bodies, pack
from tests.validation.comparison import Comparison
from tests.validation.contents import CONTENTS
from tests.validation.document import DOCUMENT, MISPRINTS, table_rows

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("title", pack.AT_ONCE)
def test_all_agree_as_the_document_says(title: str) -> None:
    comparisons = list(pack.CHAPTERS[title]())
    assert [comparison for comparison in comparisons if not comparison.agrees] == []
    rows = table_rows(title)
    assert [row[:4] for row in rows] == [list(comparison.cells[:4]) for comparison in comparisons]
    for row, single_comparison in zip(rows, comparisons, strict=True):
        assert float(row[4]) == pytest.approx(
            single_comparison.ours, rel=1e-5, abs=max(1e-9, 1e-5 * single_comparison.allowed)
        )


def test_misprints_are_as_the_document_says() -> None:
    misprints = list(pack.misprints())
    assert [misprint for misprint in misprints if not misprint.right.agrees] == []
    # a misprint that is right would be none
    assert [
        misprint for misprint in misprints if abs(misprint.printed - misprint.right.expected) <= misprint.right.allowed
    ] == []
    rows = table_rows(MISPRINTS)
    assert [row[0] for row in rows] == [f"{misprint.source}: {misprint.place}" for misprint in misprints]
    for row, single_misprint in zip(rows, misprints, strict=True):
        assert float(row[3]) == pytest.approx(single_misprint.right.ours, rel=1e-5, abs=1e-9)


def test_rigid_bodies_independent() -> None:
    pytest.importorskip("exudyn", reason="a development extra, not made for every platform")
    comparisons = list(bodies.comparisons(("v90-equal",)))
    assert len(comparisons) == 8
    assert [comparison for comparison in comparisons if not comparison.agrees] == []


def test_the_document_has_every_machine_of_the_multibody_program() -> None:
    rows = table_rows("Rigid bodies in EXUDYN")
    assert list(dict.fromkeys(row[0] for row in rows)) == list(bodies.MACHINES)
    for row in rows:
        theirs, ours, allowed = float(row[3]), float(row[4]), float(row[6])
        # six figures of each are shown
        assert abs(ours - theirs) <= allowed + 1e-5 * abs(theirs)


def test_every_row_of_the_sources_contents_has_its_place() -> None:
    _, words = DOCUMENT.read_text().split("\n## Where each part of the sources is computed\n")
    rows = re.findall(r"^\| (?!source|---)(.+?) \| (.+?) \|$", words, re.MULTILINE)
    source, of_source = "", dict[str, list[str]]()
    for topics_of_row, place in rows:
        assert place
        source = next((name for name in CONTENTS if re.match(rf"{name}\b", topics_of_row)), source)
        of_source.setdefault(source, []).append(topics_of_row)
    assert list(of_source) == list(CONTENTS)
    for name, topics in CONTENTS.items():
        parts = {part.strip() for text in of_source[name] for part in re.split(r"[;:]", text)}
        lost = [topic for topic in topics if not any(topic in text for text in (*of_source[name], *parts))]
        assert not lost, (name, lost)


def test_the_contents_name_what_there_is() -> None:
    (contents,) = re.findall(r"\n## Where each part.*", DOCUMENT.read_text(), re.DOTALL)
    rows = re.findall(r"^\| (?!source|---)(.+?) \| (.+?) \|$", contents, re.MULTILINE)
    assert len(rows) > 40
    for _, place in rows:
        for name in re.findall(r"`([\w/]+\.(?:py|md))`", place):
            assert (ROOT / name).exists(), name
        for names in re.findall(r"outputs? ((?:`\w+`(?:, )?)+)", place):
            assert set(re.findall(r"`(\w+)`", names)) <= set(OUTPUTS), names
        for names in re.findall(r"examples? ((?:`[\w-]+`(?:, )?)+)", place):
            assert set(re.findall(r"`([\w-]+)`", names)) <= set(examples("")), names


def test_a_figure_that_is_none_agrees_with_nothing() -> None:
    comparison = Comparison("m", "q", "analytic", 1.0, float("nan"), 1.0, "-")
    assert not comparison.agrees
    assert not Comparison("m", "q", "analytic", 1.0, 1.3, 0.2, "-").agrees
    assert Comparison("m", "q", "analytic", 1.0, 1.1, 0.2, "-").agrees
