"""Documents and the texts in the code keep to docs/style.md."""

import pytest

from tests.docs.reading import ROOT
from tests.docs.sentences import DISCOURAGED, discouraged, lengths, names, prose, sentences, text


@pytest.mark.parametrize("name", sorted(names()))
def test_a_text_is_short_of_breath_and_plain(name: str) -> None:
    measured = lengths(sentences(text(name)))
    assert measured.within_limits, measured
    assert discouraged(text(name)) == []


def test_the_style_page_is_one_screen() -> None:
    lines = (ROOT / "docs" / "style.md").read_text().splitlines()
    assert len(lines) <= 60
    assert max(map(len, lines)) <= 120


def test_sentences_are_counted_as_people_count_them() -> None:
    counted = (
        "# A heading\n\nTwo words. Three more words, `with code inside` and [a link](there.md).\n\n"
        "* An item\n  over two lines.\n* Another.\n\n```sh\nno prose here\n```\n\n    nor here\n\n"
        "| label | a cell with more than eight words is prose too |\n"
    )
    actual_sentences = sentences(counted)
    assert [len(actual_sentence.split()) for actual_sentence in actual_sentences] == [2, 7, 5, 1, 10]
    assert lengths(actual_sentences) == (5, 5.0, 10.0)
    assert lengths(actual_sentences).within_limits
    assert not lengths([" ".join(["word"] * 40)]).within_limits
    assert lengths([]).sentences == 0


def test_names_in_code_are_no_words() -> None:
    assert discouraged("`yardstick` and `least_mass`, in turn") == []
    values = discouraged("The yardstick over a turn\nof the least\nmass.")
    assert [word for word, _ in values] == ["yardstick", "a turn", "least mass"]
    assert "yardstick" not in prose("a `yardstick`")
    assert all(better for better in DISCOURAGED.values())
