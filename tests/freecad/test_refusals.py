"""Bad input is said in words, at its cell; the document stays as it was, and what was drawn can be undone."""

from tests.freecad.conftest import Run


def test_bad_input_is_said_and_changes_nothing(run: Run) -> None:
    found = run("refusals")
    words = {
        "a box": "no crankshaft: the selected bodies: no outer cylinder is among them",
        "a bar": "no crankshaft: the selected bodies: there is no crank pin",
        "nothing": "nothing that is selected is a solid",
        "not asked": "there is no answer yet: balance first",
        "service away": "the service at http://127.0.0.1:9 does not answer: ",
        # what the service refuses, at the cell that it concerns
        "a plate of no thickness": "webs!G3: must be at least",
        "a text": "webs!G3: envelope.thickness_m: must be a number, or one with a unit such as '180 mm', not 'thick'",
    }
    for name, begins in words.items():
        assert found[name]["lines"][0].startswith(begins), found[name]
        assert found[name]["as it was"], name
    assert found["status of a text"].startswith("webs!G3")

    assert len(found["drawn"]) == 4
    assert found["undone"] == []
    assert found["status when undone"] == "not balanced yet"
    assert found["verified when redone"]
    assert found["drawn again"] == found["drawn"]
