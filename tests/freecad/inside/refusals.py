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
    found = {
        "a box": said(document, lambda: read_shaft(document, [box], service)),
        "a bar": said(document, lambda: read_shaft(document, [round_bar], service)),
        "nothing": said(document, lambda: read_shaft(document, [], service)),
    }
    machine = machine_of("native", document)
    webs = next(sheet for sheet in machine.Tables if sheet.Label == "webs")
    found["not asked"] = said(document, lambda: verify(machine))
    found["service away"] = said(document, lambda: balance(machine, service_at("http://127.0.0.1:9")))

    thickness = webs.getContents("G3")
    webs.set("G3", "-1")
    document.recompute()
    found["a plate of no thickness"] = said(document, lambda: balance(machine, service))
    webs.set("G3", "'thick")
    document.recompute()
    found["a text"] = said(document, lambda: balance(machine, service))
    found["status of a text"] = machine.Status
    webs.set("G3", thickness)
    document.recompute()

    before = names(document)
    balance(machine, service)
    found["drawn"] = sorted(names(document) - before)
    document.undo()
    found["undone"] = sorted(names(document) - before)
    found["status when undone"] = machine.Status
    document.redo()
    document.recompute()
    found["verified when redone"] = verify(machine).held

    # drawn again, they are the same objects
    balance(machine, service)
    found["drawn again"] = sorted(names(document) - before)
    return found


def names(document):
    return {one.Name for one in document.Objects}


def said(document, attempt):
    before = names(document)
    try:
        attempt()
    except Wrong as wrong:
        return {"lines": wrong.lines, "as it was": names(document) == before}
    raise AssertionError("nothing was refused")
