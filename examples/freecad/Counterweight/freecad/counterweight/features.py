"""What is added to a document: the machine, and parametric counterweights. Needs FreeCAD, no window, no network."""

from __future__ import annotations

import json
from math import degrees, radians

import FreeCAD as App

from .faces import inside
from .moments import Moments
from .plate import SHAPES, Plate
from .plausible import Piece, Sizes
from .sheets import Wrong, from_tables
from .solids import MM, extruded, in_frame, moments
from .tables import table_of


class _Proxy:
    """What a file keeps of a proxy: nothing; before and after FreeCAD 0.21."""

    def dumps(self):
        return None

    def loads(self, state):
        return None

    __getstate__ = dumps

    def __setstate__(self, state):
        return None


class Machine(_Proxy):
    """The shaft, the tables that describe what moves and where counterweights may sit, the last answer."""

    PROPERTIES = (
        ("App::PropertyLinkList", "Shaft", "bodies of the shaft"),
        ("App::PropertyFloatList", "Densities", "density of each body, kg/m3"),
        ("App::PropertyPlacement", "Frame", "of the shaft: z along it, angles counter-clockwise from x"),
        ("App::PropertyLinkList", "Tables", "spreadsheets machine, throws, rows, webs"),
        ("App::PropertyLinkList", "Counterweights", "what was drawn"),
        ("App::PropertyLinkList", "Obstacles", "bodies that stand still: the crankcase"),
        ("App::PropertyLength", "Clearance", "that is left to obstacles and rods"),
        ("App::PropertyString", "Request", "that the answer is to"),
        ("App::PropertyString", "Answer", "of the service"),
        ("App::PropertyString", "Status", "whether the answer is that to the shaft as it is"),
        ("App::PropertyStringList", "Doubts", "what was seen of the shaft that should be looked at"),
        ("App::PropertyString", "Confirmed", "mass and sizes that the designer has confirmed"),
        ("App::PropertyString", "Forced", "why it should not have been balanced, and was"),
    )

    def __init__(self, feature):
        _add(feature, self.PROPERTIES)
        feature.Clearance = 5.0
        for name in ("Request", "Answer"):
            feature.setEditorMode(name, 2)
        for name in ("Status", "Doubts", "Confirmed", "Forced"):
            feature.setEditorMode(name, 1)
        feature.Proxy = self

    def execute(self, machine):
        machine.Status = status(machine)


class Counterweight(_Proxy):
    """A solid whose opening follows from the unbalance that is asked for."""

    PROPERTIES = (
        ("App::PropertyString", "Web", "where it sits"),
        ("App::PropertyEnumeration", "Outline", "sector or segment"),
        ("App::PropertyLength", "InnerRadius", "of the hub"),
        ("App::PropertyLength", "OuterRadius", "that it may reach"),
        ("App::PropertyLength", "Thickness", "along the shaft"),
        ("App::PropertyFloat", "Density", "kg/m3"),
        ("App::PropertyAngle", "LargestHalfAngle", "half of the largest opening"),
        ("App::PropertyDistance", "Position", "of its middle plane along the shaft"),
        ("App::PropertyFloat", "AskedUnbalance", "mass times radius, kg m"),
        ("App::PropertyAngle", "AskedAngle", "as drawn at shaft angle 0"),
        ("App::PropertyPlacement", "Frame", "of the shaft"),
        ("App::PropertyAngle", "HalfAngle", "half of the opening that follows"),
        ("App::PropertyFloat", "Mass", "of the solid, kg"),
        ("App::PropertyFloat", "Unbalance", "of the solid, kg m"),
    )

    def __init__(self, feature):
        _add(feature, self.PROPERTIES)
        feature.Outline = list(SHAPES)
        for name in ("HalfAngle", "Mass", "Unbalance"):
            feature.setEditorMode(name, 1)
        feature.Proxy = self

    def execute(self, feature):
        plate = Plate(
            feature.Outline,
            feature.InnerRadius.Value * MM,
            feature.OuterRadius.Value * MM,
            feature.Thickness.Value * MM,
            feature.Density,
            radians(feature.LargestHalfAngle.Value),
        )
        half = plate.half(feature.AskedUnbalance)
        shape = extruded(plate.outline(half, radians(feature.AskedAngle.Value)), feature.Thickness.Value)
        along = App.Placement(App.Vector(0, 0, feature.Position.Value), App.Rotation())
        placement = feature.Frame.multiply(along)
        shape.Placement = placement
        feature.Shape, feature.Placement = shape, placement
        result = moments(inside(shape, feature.Frame), feature.Density)
        feature.HalfAngle, feature.Mass, feature.Unbalance = degrees(half), result.mass_kg, abs(result.static_kg_m)


def _add(feature, properties):
    for kind, name, words in properties:
        if not hasattr(feature, name):
            feature.addProperty(kind, name, "Counterweight", words)


# ---- what a machine says now


def sizes(machine):
    """Bodies and length of the shaft as its solids are."""
    shapes = [in_frame(body, machine.Frame) for body in machine.Shaft]
    pieces = tuple(
        Piece(body.Label, sum(solid.Volume for solid in shape.Solids) * MM**3, density)
        for body, shape, density in zip(machine.Shaft, shapes, machine.Densities)
    )
    low, high = min(shape.BoundBox.ZMin for shape in shapes), max(shape.BoundBox.ZMax for shape in shapes)
    return Sizes(pieces, (high - low) * MM)


def shaft_moments(machine):
    """Moments of every body of the shaft by its label."""
    if len(machine.Densities) != len(machine.Shaft):
        raise Wrong(["Densities: one for each body of the shaft"])
    return {
        body.Label: moments(in_frame(body, machine.Frame), density)
        for body, density in zip(machine.Shaft, machine.Densities)
    }


def weight_moments(machine):
    """Moments of every counterweight that was drawn, by its web."""
    sums = {}
    for item in machine.Counterweights:
        sums[item.Web] = sums.get(item.Web, Moments()) + moments(inside(item.Shape, machine.Frame), item.Density)
    return sums


def request_of(machine):
    """The request that tables and solids say.

    Raises
    ------
    Wrong
    """
    question = from_tables({sheet.Label: table_of(sheet) for sheet in machine.Tables})
    boxes = [in_frame(body, machine.Frame).BoundBox for body in machine.Shaft]
    low, high = min(box.ZMin for box in boxes) * MM, max(box.ZMax for box in boxes) * MM
    question.body["machine"]["unbalances"] = [
        unbalance
        for label, moments in shaft_moments(machine).items()
        for unbalance in moments.as_unbalances(label, low, high)
    ]
    return question


def status(machine):
    """In words, whether the last answer is that to what the machine says now."""
    try:
        now = request_of(machine).body
    except Wrong as wrong:
        return wrong.lines[0]
    if not machine.Answer:
        return "not balanced yet"
    if not alike(now, json.loads(machine.Request)):
        return "balance again: shaft or tables have changed"
    return f"balanced, FORCED in spite of: {machine.Forced}" if machine.Forced else "balanced"


def alike(first, second):
    """Whether two requests are the same, to what a file keeps of a shape."""
    if isinstance(first, dict) and isinstance(second, dict):
        return first.keys() == second.keys() and all(alike(first[key], second[key]) for key in first)
    if isinstance(first, list) and isinstance(second, list):
        return len(first) == len(second) and all(map(alike, first, second))
    if isinstance(first, float) and isinstance(second, (int, float)):
        return abs(first - second) <= 1e-9 * max(abs(first), abs(second), 1e-3)
    return first == second
