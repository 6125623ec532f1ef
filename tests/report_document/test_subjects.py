"""What other answers and requests say stands where its name says: a chapter that takes one field for another is seen.

subjects.txt lists the places of every leaf that a chapter shows (``python -m tests.report_document.subjects`` writes
it; regression). Its labels are compared with the names of the leaves as those of follows.txt are.
"""

import re

import pytest

from tests.night import part
from tests.report_document.follow import stored
from tests.report_document.subjects import NAMES, TABLE, subject_of
from tests.report_document.test_follows import SENTENCES

PLACES = stored(TABLE)


def of(name: str) -> dict[str, list[str]]:
    """The leaves of a subject with their places."""
    return {leaf.removeprefix(f"{name}: "): places for leaf, places in PLACES.items() if leaf.startswith(f"{name}: ")}


@pytest.mark.parametrize("name", part(4, NAMES))
def test_chapters_change_where_a_figure_stands_and_nowhere_else(name: str) -> None:
    places, subject = of(name), subject_of(name)
    fields = {change.name: subject.follows(change) for change in subject.changes if change.name in places}
    assert fields == places


def test_the_table_holds_enough_and_no_other_subject() -> None:
    assert {leaf.partition(": ")[0] for leaf in PLACES} == {*NAMES}
    assert sum(place.startswith("= ") for places in PLACES.values() for place in places) > 350


def test_labels_say_what_the_names_of_the_leaves_say() -> None:
    labels = [(leaf, place[2:].rstrip("'")) for leaf, where in PLACES.items() for place in where if place[0] == "="]
    assert [
        (leaf, label)
        for leaf, label in labels
        for name, right in SENTENCES.items()
        if re.search(name, leaf) and not re.search(right, label)
    ] == []
