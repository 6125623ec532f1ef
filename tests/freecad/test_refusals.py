"""Bad input is said in words, at its cell; the document stays as it was, and what was drawn can be undone."""

from tests.freecad.conftest import Run


def test_bad_input_is_said_and_changes_nothing(run: Run) -> None:
    process = run("refusals")
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
        assert process[name]["lines"][0].startswith(begins), process[name]
        assert process[name]["as it was"], name
    assert process["status of a text"].startswith("webs!G3")

    assert len(process["drawn"]) == 4
    assert process["undone"] == []
    assert process["status when undone"] == "not balanced yet"
    assert process["verified when redone"]
    assert process["drawn again"] == process["drawn"]
