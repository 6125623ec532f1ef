"""A triple crank in twenty variants: what is read and balanced, and what is refused with its reason.

Crank radius 90, pins of 110, journals of 120, webs of 22 mm; cranks at 0, 120 and 240 degrees.
"""

import os
from math import cos, radians, sin, tan
from pathlib import Path

import FreeCAD as App
import Part
from freecad.counterweight.asking import service_at
from freecad.counterweight.balance import balance, read_shaft, shaft_words
from freecad.counterweight.sheets import Wrong
from freecad.counterweight.tables import table_of

RADIUS, PIN, JOURNAL, HALF, WEB = 90.0, 55.0, 60.0, 70.0, 22.0
CRANKS = (0.0, 120.0, 240.0)
STEEL = 7850.0


def stretches():
    """Kind, low, high and crank along the shaft."""
    z = 0.0
    yield "journal", z, z + 100.0, None
    z += 100.0
    for number, crank in enumerate(CRANKS):
        for kind, length in (("web", WEB), ("pin", 70.0), ("web", WEB)):
            yield kind, z, z + length, crank
            z += length
        length = 100.0 if number == len(CRANKS) - 1 else 60.0
        yield "journal", z, z + length, None
        z += length


def at(crank, z):
    return App.Vector(RADIUS * cos(radians(crank)), RADIUS * sin(radians(crank)), z)


def round_bar(kind, low, high, crank):
    if kind == "pin":
        return Part.makeCylinder(PIN, high - low, at(crank, low))
    return Part.makeCylinder(JOURNAL, high - low, App.Vector(0, 0, low))


def longer(kind, low, high, crank):
    """As far as flanks that lean begin later."""
    return round_bar(kind, low - 12.0, high + 12.0, crank)


def oblong(low, high, crank):
    ends = [Part.makeCylinder(HALF, high - low, App.Vector(x, 0, low)) for x in (0.0, RADIUS)]
    across = Part.makeBox(RADIUS, 2 * HALF, high - low, App.Vector(0, -HALF, low))
    return turned(ends[0].multiFuse([ends[1], across]).removeSplitter(), crank)


def flat(low, high, crank):
    box = Part.makeBox(230.0, 2 * HALF, high - low, App.Vector(-70.0, -HALF, low))
    return turned(box, crank)


def eccentric(low, high, crank):
    return turned(Part.makeCylinder(120.0, high - low, App.Vector(40.0, 0, low)), crank)


def leaning(low, high, crank):
    """Its flanks lean by three degrees, thinner away from the axis."""
    rise = 230.0 * tan(radians(3.0))
    corners = [(-70, low), (160, low + rise), (160, high - rise / 4), (-70, high)]
    wire = Part.makePolygon([App.Vector(x, -HALF, z) for x, z in [*corners, corners[0]]])
    return turned(Part.Face(wire).extrude(App.Vector(0, 2 * HALF, 0)), crank)


def turned(shape, angle):
    shape.rotate(App.Vector(), App.Vector(0, 0, 1), angle)
    return shape


def pieces(web=oblong, bar=round_bar):
    return [
        (web(low, high, crank) if kind == "web" else bar(kind, low, high, crank))
        for kind, low, high, crank in stretches()
    ]


def solid(web=oblong, bar=round_bar):
    first, *segments = pieces(web, bar)
    return first.multiFuse(segments).removeSplitter()


def filleted():
    shape = solid()
    ends = [z for kind, low, high, _ in stretches() if kind == "web" for z in (low, high)]
    edges = [
        edge
        for edge in shape.Edges
        if isinstance(edge.Curve, Part.Circle)
        and min(abs(edge.Curve.Radius - PIN), abs(edge.Curve.Radius - JOURNAL)) < 1e-6
        and min(abs(edge.Curve.Center.z - z) for z in ends) < 1e-6
    ]
    return shape.makeFillet(3.0, edges)


def tapered():
    last = list(stretches())[-1][2]
    cone = Part.makeCone(JOURNAL, 40.0, 80.0, App.Vector(0, 0, last))
    return solid().fuse([cone]).removeSplitter()


def split():
    """The second pin is two, 30 degrees apart."""

    def bar(kind, low, high, crank):
        if kind == "pin" and crank == CRANKS[1]:
            middle = (low + high) / 2
            cylinder = Part.makeCylinder(PIN, high - middle, at(crank + 30.0, middle))
            return Part.makeCylinder(PIN, middle - low, at(crank, low)).fuse(cylinder)
        return round_bar(kind, low, high, crank)

    return solid(bar=bar)


def hollow():
    shape = solid()
    shape = shape.cut(Part.makeCylinder(25.0, 1000.0))
    for kind, low, high, crank in stretches():
        if kind == "pin":
            shape = shape.cut(Part.makeCylinder(20.0, high - low + 2 * WEB, at(crank, low - WEB)))
    return shape


def built_up():
    """Journals and pins go 15 mm into their webs, which are bored for them."""
    bars, webs = [], []
    rows = list(stretches())
    for n, (kind, low, high, crank) in enumerate(rows):
        if kind == "web":
            webs.append(oblong(low, high, crank))
        else:
            first, last = low - (15.0 if n else 0.0), high + (15.0 if n < len(rows) - 1 else 0.0)
            bars.append(round_bar(kind, first, last, crank))
    return [*bars, *(web.cut(Part.makeCompound(bars)) for web in webs)]


def keyed():
    return solid().cut(Part.makeBox(18.0, 11.0, 80.0, App.Vector(-9.0, JOURNAL - 7.0, -5.0)))


def halves():
    """One shaft that is drawn as two bodies, cut through its second journal."""
    shape = solid()
    middle = 100.0 + 2 * WEB + 70.0 + 30.0
    box = Part.makeBox(1000.0, 1000.0, middle, App.Vector(-500.0, -500.0, 0.0))
    return [shape.common(box), shape.cut(box)]


def tilted():
    start, end = at(CRANKS[0], 157.0), App.Vector(0, 0, 50.0)
    shape = solid().cut(Part.makeCylinder(6.0, (end - start).Length, start, end - start))
    shape.Placement = App.Placement(App.Vector(1000, -300, 77), App.Rotation(App.Vector(0.3, 1, 0.2), 63))
    return shape


def imported(shape, document, unit="MILLI"):
    """Through a STEP file; in inches, the figures of the file are inches."""
    path = Path(os.environ["FOLDER"]) / "variant.step"
    shape.exportStep(str(path))
    if unit == "INCH":
        text = path.read_text()
        old = "( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) )"
        assert old in text
        inch = "( CONVERSION_BASED_UNIT('INCH',#90001) LENGTH_UNIT() NAMED_UNIT(#90002) )"
        more = (
            "#90001 = LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#90003);\n"
            "#90002 = DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);\n"
            "#90003 = ( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) );\n"
        )
        head, tail = text.replace(old, inch).rsplit("ENDSEC;", 1)
        path.write_text(f"{head}{more}ENDSEC;{tail}")
    Part.insert(str(path), document.Name)
    document.recompute()
    return [
        document_object for document_object in document.Objects if getattr(document_object, "Shape", None) is not None
    ]


def smaller(shape):
    """The same figures in inches, taken for millimetres."""
    return shape.scaled(1 / 25.4)


VARIANTS = {
    "as drawn": lambda _: [solid()],
    "fillets": lambda _: [filleted()],
    "without webs": lambda _: [piece for piece, (kind, *_) in zip(pieces(), stretches(), strict=True) if kind != "web"],
    "inches read as mm": lambda _: [smaller(solid())],
    "density 7.85": lambda _: [solid()],
    "flat-sided webs": lambda _: [solid(flat)],
    "round webs": lambda _: [solid(eccentric)],
    "tilted STEP with an oblique bore": lambda document: imported(tilted(), document),
    "another crank radius": lambda _: [solid()],
    "tapered end": lambda _: [tapered()],
    "leaning flanks": lambda _: [solid(leaning, longer)],
    "split pins": lambda _: [split()],
    "hollow": lambda _: [hollow()],
    "built up": lambda _: built_up(),
    "STEP in inches": lambda document: imported(smaller(solid()), document, "INCH"),
    "a surface among solids": lambda _: [solid(), Part.makePlane(100.0, 100.0)],
    "two bodies": lambda _: halves(),
    "two shafts": lambda _: [solid(), solid().translated(App.Vector(800.0, 0, 0))],
    "a bar": lambda _: [Part.makeCylinder(60.0, 800.0)],
    "keyway": lambda _: [keyed()],
}


def main():
    service = service_at(os.environ["URL"])
    fields = {name: tried(name, service) for name in os.environ["VARIANTS"].split(";")}
    if os.environ["FORCED"]:
        fields["forced"] = tried(os.environ["FORCED"], service, force=True)
    return {"drawn": sorted(VARIANTS), **fields}


def tried(name, service, force=False):
    document = App.newDocument("variant")
    try:
        bodies = []
        for shape in VARIANTS[name](document):
            if hasattr(shape, "Placement") and not hasattr(shape, "Label"):
                body = document.addObject("Part::Feature", "Body")
                body.Shape = shape
                shape = body
            bodies.append(shape)
        document.recompute()
        return balanced(document, name, bodies, service, force)
    finally:
        App.closeDocument(document.Name)


def balanced(document, name, bodies, service, force):
    row = {"axis_deg": 0, "reciprocating_mass_kg": 20.0, "connecting_rod": {"length_m": 0.4, "mass_kg": 10.0}}
    throw = {"rows": [row], **({"crank_radius_m": 0.1} if name == "another crank radius" else {})}
    throws = [throw] * (4 if name == "split pins" else 3)
    body = {"machine": {"speed_rpm": 1000, "throws": throws}}
    density = 7.85 if name == "density 7.85" else STEEL
    doubts = {}
    try:
        machine = read_shaft(document, bodies, service, [density] * len(bodies), description=body, force=force)
        doubts["doubts"] = list(machine.Doubts)
        heads, *webs = table_of(next(sheet for sheet in machine.Tables if sheet.Label == "webs"))
        doubts["webs"] = [dict(zip(heads, web, strict=True)) for web in webs]
        heads, *cranks = table_of(next(sheet for sheet in machine.Tables if sheet.Label == "throws"))
        doubts["throws"] = [dict(zip(heads, crank, strict=True)) for crank in cranks]
        doubts["said"] = shaft_words(machine)
        verdict = balance(machine, service, force)
        doubts["status"] = machine.Status
        doubts["held"], doubts["words"] = verdict.held, verdict.words()
    except Wrong as wrong:
        doubts["refused"] = wrong.lines
    return doubts
