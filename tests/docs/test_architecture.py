"""The pictures of docs/architecture.md are those that the code gives today, and what it names is there."""

import re
import sys
import xml.etree.ElementTree as ET

import pytest

from tests.docs.reading import ROOT

sys.path.insert(0, str(ROOT / "docs"))
import room_map
import sequences

PAGE = ROOT / "docs" / "architecture.md"


@pytest.fixture(scope="module")
def arrows() -> dict[str, frozenset[str]]:
    """Which room imports which; every file of the packages is parsed."""
    imports: dict[str, frozenset[str]] = room_map.imports()
    return imports


def test_the_rooms_are_drawn_from_the_imports(arrows: dict[str, frozenset[str]]) -> None:
    drawn = room_map.picture(arrows)
    assert room_map.PICTURE.read_text() == drawn, "run `make map`"
    assert {text.text for text in ET.fromstring(drawn).iter("{http://www.w3.org/2000/svg}text")} >= {
        name.split(".")[1] for name in arrows
    }
    text = PAGE.read_text()
    assert room_map.page(text, arrows) == text, "run `make map`"


def test_every_room_states_its_purpose(arrows: dict[str, frozenset[str]]) -> None:
    assert [name for name in arrows if len(room_map.purpose(name)) < 10] == []


@pytest.mark.parametrize("name", sequences.SEQUENCES)
def test_a_sequence_is_as_drawn_and_goes_through_files_that_are_there(name: str) -> None:
    sequence = sequences.SEQUENCES[name]
    assert (ROOT / "docs" / f"{name}.svg").read_text() == sequences.picture(sequence), "run `make map`"
    for participant in sequence.participants:
        assert participant == sequences.CLIENT or (ROOT / participant).exists(), participant
    # a participant speaks only after something has reached it; a coordinator begins by itself
    reached = {sequences.CLIENT, "service/jobs/coordinator.py"}
    for message in sequence.messages:
        assert message.sender in reached, message
        reached.add(message.receiver)


def test_the_files_of_ideas_are_there() -> None:
    named = re.findall(r"`((?:optimizer|service|schemas)/[\w/.]*)`", PAGE.read_text())
    assert len(named) > 30
    assert [name for name in named if not (ROOT / name).exists()] == []


def test_arrows_are_reduced_and_circles_are_refused() -> None:
    chain = {"a.x": frozenset({"a.y", "a.z"}), "a.y": frozenset({"a.z"}), "a.z": frozenset[str]()}
    assert room_map.floors(chain) == {"a.x": 2, "a.y": 1, "a.z": 0}
    assert room_map.reduced(chain) == {**chain, "a.x": frozenset({"a.y"})}
    with pytest.raises(ValueError, match="circle"):
        room_map.floors({"a.x": frozenset({"a.y"}), "a.y": frozenset({"a.x"})})
