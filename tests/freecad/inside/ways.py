"""What stands in the way, and what does not."""

import os

import FreeCAD as App
import Part
from freecad.counterweight import clearance as ways_of
from freecad.counterweight.asking import service_at
from freecad.counterweight.balance import balance
from freecad.counterweight.clearance import clearance
from freecad.counterweight.sheets import Wrong
from freecad.counterweight.tables import table_of
from loop import machine_of

LENGTH = 700.0


def main():
    # enough for a rod that is in the way for most of a turn
    ways_of.STEPS = 6
    document = App.newDocument("shaft")
    machine = machine_of("imported", document)
    balance(machine, service_at(os.environ["URL"]))
    clearances = {"bare": clearance(machine)}

    for name, bore in (("roomy", 380.0), ("near", 363.0), ("tight", 350.0)):
        machine.Obstacles = [case(document, machine, name, bore)]
        clearances[name] = clearance(machine)
    machine.Obstacles = []

    for name, width in (("slim", 120.0), ("wide", 150.0)):
        machine_rods(document, machine, name, width)
        clearances[f"{name} rods"] = clearance(machine)
    rows = {sheet.Label: sheet for sheet in machine.Tables}["rows"]
    rows.set("H2", "'no such rod")
    document.recompute()
    clearances["no rod"] = refused(machine)
    rows.set("H2", "'tight")
    document.recompute()
    clearances["not a rod"] = refused(machine)
    rows.set("H2", "")
    rows.set("H3", "")

    # a counterweight that is turned stands in its own web
    first = machine.Counterweights[0]
    first.AskedAngle = first.AskedAngle.Value + 180.0
    document.recompute()
    clearances["turned"] = clearance(machine)
    return clearances


def refused(machine):
    try:
        clearance(machine)
    except Wrong as wrong:
        return wrong.lines
    raise AssertionError("nothing was refused")


def put(document, machine, label, shape):
    """A body that is drawn in the shaft's frame."""
    body = document.addObject("Part::Feature", "Body")
    body.Label, body.Shape = label, shape
    body.Placement = machine.Frame
    document.recompute()
    return body


def case(document, machine, name, bore):
    low, length = App.Vector(0, 0, -2000), 4000
    return put(document, machine, name, Part.makeCylinder(420, length, low).cut(Part.makeCylinder(bore, length, low)))


def machine_rods(document, machine, name, width):
    """A rod on each throw, where it is at shaft angle 0, and named in the table of rows."""
    sheets = {sheet.Label: sheet for sheet in machine.Tables}
    throws = table_of(sheets["throws"])[1:]
    rows = table_of(sheets["rows"])
    for number, (line, throw) in enumerate(zip(rows[1:], throws, strict=True), start=1):
        _, _, position, radius, angle = throw
        pin = App.Rotation(App.Vector(0, 0, 1), angle).multVec(App.Vector(1e3 * radius, 0, 1e3 * position))
        along = App.Rotation(App.Vector(0, 0, 1), line[2]).multVec(App.Vector(1, 0, 0))
        # the crosshead is on the axis of the row, a rod's length from the pin
        across = pin - along * pin.dot(along)
        across.z = 0
        reach = pin.dot(along) + (LENGTH**2 - across.Length**2) ** 0.5
        head = along * reach
        head.z = pin.z
        towards = App.Rotation(App.Vector(1, 0, 0), head - pin)
        shape = rod(width)
        shape.Placement = App.Placement(pin, towards)
        label = f"{name} {number}"
        put(document, machine, label, shape)
        # the placement of the body is the frame: what is within it moves along
        body = document.getObjectsByLabel(label)[0]
        body.Placement = machine.Frame.multiply(shape.Placement)
        sheets["rows"].set(f"H{number + 1}", f"'{label}")
    document.recompute()


def rod(width):
    """Big end about the origin, small end along x."""
    eye = Part.makeCylinder(115, width, App.Vector(0, 0, -width / 2))
    shank = Part.makeBox(585, 90, width, App.Vector(100, -45, -width / 2))
    bore = Part.makeCylinder(75, width, App.Vector(0, 0, -width / 2))
    return eye.fuse(shank).cut(bore)
