"""Three crankshafts, made in three ways; each with the throws that whoever drew it meant.

Two throws like those of the 2D12: crank radius 140, pins of 150, journals of 160 mm. The second crank stands at 180
degrees to the first, of the imported one at 117.
"""

import os
from math import cos, radians, sin

import FreeCAD as App
import Part
import Sketcher  # noqa: F401  # what a sketch needs

RADIUS, PIN, JOURNAL, WEB, WEB_END = 140.0, 75.0, 80.0, 70.0, 120.0
#: z of the ends of what follows on each other: journal, web, pin, web, journal, web, pin, web, journal
ENDS = (-485.0, -315.0, -245.0, -105.0, -35.0, 35.0, 105.0, 245.0, 315.0, 485.0)


def native(document):
    """Nine parametric bodies, driven by a spreadsheet."""
    sheet = document.addObject("Spreadsheet::Sheet", "Parameters")
    for row, (alias, length) in enumerate((("crank_radius", RADIUS), ("pin_radius", PIN)), start=1):
        sheet.set(f"A{row}", alias)
        sheet.set(f"B{row}", f"={length} mm")
        sheet.setAlias(f"B{row}", alias)
    document.recompute()
    bodies = []
    for low, high, kind in stretches():
        if kind == "web":
            feature = document.addObject("Part::Feature", "Web")
            feature.Shape = web(low, high, 180.0 if low < 0 else 0.0)
        else:
            feature = document.addObject("Part::Cylinder", kind.capitalize())
            feature.Radius, feature.Height, feature.Placement.Base = JOURNAL, high - low, App.Vector(0, 0, low)
            if kind == "pin":
                feature.setExpression("Radius", "Parameters.pin_radius")
                sign = "-" if low < 0 else ""
                feature.setExpression("Placement.Base.x", f"{sign}Parameters.crank_radius")
        bodies.append(feature)
    document.recompute()
    return bodies


def part_design(document):
    """One body of sketches and pads; its webs are round and eccentric, as those of small compressors."""
    body = document.addObject("PartDesign::Body", "Crankshaft")
    for number, (low, high, kind) in enumerate(stretches()):
        centre = {"journal": 0.0, "pin": RADIUS, "web": 60.0}[kind] * (-1.0 if high <= -35.0 else 1.0)
        radius = {"journal": JOURNAL, "pin": PIN, "web": 170.0}[kind]
        sketch = body.newObject("Sketcher::SketchObject", f"Sketch{number}")
        sketch.Support, sketch.MapMode = (document.getObject("XY_Plane"), [""]), "FlatFace"
        sketch.AttachmentOffset = App.Placement(App.Vector(0, 0, low), App.Rotation())
        sketch.addGeometry(Part.Circle(App.Vector(centre, 0, 0), App.Vector(0, 0, 1), radius))
        pad = body.newObject("PartDesign::Pad", f"Pad{number}")
        pad.Profile, pad.Length = sketch, high - low
    document.recompute()
    return [body]


def imported(document):
    """One solid of a STEP file, tilted in space, with an oil bore askew; the cranks stand at 117 degrees."""
    path = os.path.join(os.environ["FOLDER"], "imported.step")
    solid(117.0, bored=True, tilted=True).exportStep(path)
    Part.insert(path, document.Name)
    document.recompute()
    return [document.Objects[-1]]


def solid(second_deg, bored=False, tilted=False):
    """One solid of all stretches."""
    shapes = []
    for low, high, kind in stretches():
        angle = second_deg if low < 0 else 0.0
        if kind == "web":
            shapes.append(web(low, high, angle))
        else:
            offset = RADIUS if kind == "pin" else 0.0
            at = App.Vector(offset * cos(radians(angle)), offset * sin(radians(angle)), low)
            shapes.append(Part.makeCylinder(PIN if kind == "pin" else JOURNAL, high - low, at))
    fused = shapes[0].multiFuse(shapes[1:]).removeSplitter()
    if bored:
        start, end = App.Vector(0, 0, 0), App.Vector(RADIUS, 0, 175.0)
        fused = fused.cut(Part.makeCylinder(10.0, (end - start).Length, start, end - start))
    if tilted:
        fused.Placement = App.Placement(App.Vector(1000, -300, 77), App.Rotation(App.Vector(0.3, 1, 0.2), 63))
    return fused


def stretches():
    """Low, high and kind along the shaft."""
    kinds = ("journal", "web", "pin", "web", "journal", "web", "pin", "web", "journal")
    return zip(ENDS[:-1], ENDS[1:], kinds, strict=True)


def web(low, high, angle_deg):
    """An oblong plate from the axis to the pin."""
    across = Part.makeBox(RADIUS, 2 * WEB_END, high - low, App.Vector(0, -WEB_END, low))
    ends = [Part.makeCylinder(WEB_END, high - low, App.Vector(x, 0, low)) for x in (0.0, RADIUS)]
    solid = ends[0].multiFuse([ends[1], across]).removeSplitter()
    solid.rotate(App.Vector(), App.Vector(0, 0, 1), angle_deg)
    return solid
