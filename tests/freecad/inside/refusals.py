"""Bad input: what is said of it, and that the document stays as it was."""

import os

import FreeCAD as App
from freecad.counterweight.asking import service_at
from freecad.counterweight.balance import balance, read_shaft, verify
from freecad.counterweight.sheets import Wrong
from loop import machine_of


def main():
    service = service_at(os.environ["URL"])
    document = App.newDocument("shaft")
    box = document.addObject("Part::Box", "Box")
    round_bar = document.addObject("Part::Cylinder", "Bar")
    document.recompute()
    texts = {
        "a box": refusal(document, lambda: read_shaft(document, [box], service)),
        "a bar": refusal(document, lambda: read_shaft(document, [round_bar], service)),
        "nothing": refusal(document, lambda: read_shaft(document, [], service)),
    }
    machine = machine_of("native", document)
    webs = next(sheet for sheet in machine.Tables if sheet.Label == "webs")
    texts["not asked"] = refusal(document, lambda: verify(machine))
    texts["service away"] = refusal(document, lambda: balance(machine, service_at("http://127.0.0.1:9")))

    thickness = webs.getContents("G3")
    webs.set("G3", "-1")
    document.recompute()
    texts["a plate of no thickness"] = refusal(document, lambda: balance(machine, service))
    webs.set("G3", "'thick")
    document.recompute()
    texts["a text"] = refusal(document, lambda: balance(machine, service))
    texts["status of a text"] = machine.Status
    webs.set("G3", thickness)
    document.recompute()

    before = names(document)
    balance(machine, service)
    texts["drawn"] = sorted(names(document) - before)
    document.undo()
    texts["undone"] = sorted(names(document) - before)
    texts["status when undone"] = machine.Status
    document.redo()
    document.recompute()
    texts["verified when redone"] = verify(machine).held

    # drawn again, they are the same objects
    balance(machine, service)
    texts["drawn again"] = sorted(names(document) - before)
    return texts


def names(document):
    return {document_object.Name for document_object in document.Objects}


def refusal(document, attempt):
    before = names(document)
    try:
        attempt()
    except Wrong as wrong:
        return {"lines": wrong.lines, "as it was": names(document) == before}
    raise AssertionError("nothing was refused")
