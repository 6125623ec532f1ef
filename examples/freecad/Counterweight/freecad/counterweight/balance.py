"""The job: read the shaft, ask the service, draw the counterweights, hold the solids against the answer.

Needs FreeCAD, no window. Whatever goes wrong leaves the document as it was.
"""

from __future__ import annotations

import json
from contextlib import contextmanager

import Part

from . import cranks
from .asking import ask
from .features import Counterweight, Machine, asked, shaft_moments, weight_moments
from .plate import Plate
from .sheets import MACHINE, ROD, ROWS, THROW, THROWS, USE, WEBS, Wrong, completed, table
from .solids import MM, STEEL_KG_M3, shape_of
from .tables import write
from .verdict import verdict

#: below this share of the heaviest a counterweight is none
_NOTHING = 1e-9
_ROW_HEADS = (
    THROW, "name", "axis_deg", "reciprocating_mass_kg", "connecting_rod.length_m", "connecting_rod.mass_kg",
    "connecting_rod.reciprocating_share", ROD,
)  # fmt: skip


@contextmanager
def change(document, words):
    """A change of a document that is made as a whole or not at all, and can be undone."""
    if not document.UndoMode:
        # without a window it is off
        document.UndoMode = 1
    document.openTransaction(words)
    try:
        yield
    except BaseException:
        document.abortTransaction()
        raise
    document.commitTransaction()


def read_shaft(document, bodies, densities=None, frame=None, said=None):
    """The machine of some bodies, with tables of what their faces show; it is for the designer to correct and complete.

    Parameters
    ----------
    densities : of the bodies, kg/m3; steel if not said.
    frame : of the shaft; from its faces if not said: x towards the first crank pin.
    said : a request with what no face shows, if it is known already.

    Raises
    ------
    Wrong
    """
    shape = Part.makeCompound([shape_of(body) for body in bodies])
    if not shape.Solids:
        raise Wrong(["nothing that is selected is a solid: select the bodies of the shaft"])
    try:
        frame = frame or cranks.frame_of(shape)
        shown = tables(cranks.read(cranks.inside(shape, frame)))
    except cranks.NoShaft as error:
        raise Wrong([f"no crankshaft: {error}"]) from None
    if said is not None:
        shown = completed(shown, said)
    with change(document, "Read shaft"):
        machine = document.addObject("App::FeaturePython", "Machine")
        Machine(machine)
        machine.Shaft, machine.Frame = list(bodies), frame
        machine.Densities = list(densities or [STEEL_KG_M3] * len(bodies))
        sheets = []
        for name, lines in shown.items():
            sheet = document.addObject("Spreadsheet::Sheet", name)
            sheet.Label = name
            write(sheet, lines)
            sheets.append(sheet)
        machine.Tables = sheets
        document.recompute()
    return machine


def tables(found):
    """What the faces show, as the tables that the designer completes."""
    pins = sorted(found.pins + found.doubtful, key=lambda pin: pin.low)
    names = {id(pin): str(number) for number, pin in enumerate((pin for pin in pins if pin in found.pins), start=1)}
    throws = [
        {
            USE: "yes" if id(pin) in names else "no",
            "name": names.get(id(pin), f"web? {pin.radius:g} mm"),
            "position_m": pin.middle * MM,
            "crank_radius_m": pin.offset * MM,
            "crank_angle_deg": pin.angle_deg,
        }
        for pin in pins
    ]
    webs = [
        {
            USE: "yes",
            "name": f"web {number}",
            "position_m": (web.low + web.high) / 2 * MM,
            "envelope.shape": "sector",
            "envelope.inner_radius_m": web.hub * MM,
            "envelope.outer_radius_m": web.reach * MM,
            "envelope.thickness_m": (web.high - web.low) * MM,
            "envelope.density_kg_m3": STEEL_KG_M3,
            "envelope.max_half_angle_deg": 90,
        }
        for number, web in enumerate(found.webs, start=1)
    ]
    rows = [{THROW: name, "name": name, "axis_deg": 0} for name in names.values()]
    return {
        MACHINE: [["field", "value"], ["machine.name", "from CAD"], ["machine.speed_rpm", None]],
        THROWS: table(list(throws[0]), throws),
        ROWS: table(_ROW_HEADS, rows),
        WEBS: table(list(webs[0]) if webs else [USE, "name", "position_m"], webs),
    }


def balance(machine, service):
    """Ask and draw; the verdict on the solids."""
    question = asked(machine)
    return draw(machine, question.body, ask(service, question))


def draw(machine, request, answer):
    """Draw the counterweights of an answer; those that were drawn before follow, or go.

    Raises
    ------
    Wrong
        if one cannot be drawn, or the solids do not leave what the answer says.
    """
    document = machine.Document
    with change(document, "Balance"):
        drawn = {one.Web: one for one in machine.Counterweights}
        heaviest = max((one["mass_kg"] for one in answer["counterweights"]), default=0.0)
        webs = {web["name"]: web for web in request["machine"]["webs"]}
        kept = []
        for one in answer["counterweights"]:
            if one["mass_kg"] > _NOTHING * heaviest:
                made = drawn.pop(one["web"], None) or _new(document, one["web"])
                _ask_for(made, machine, webs[one["web"]], one)
                kept.append(made)
        machine.Counterweights = kept
        machine.Request, machine.Answer = json.dumps(request), json.dumps(answer)
        for one in drawn.values():
            document.removeObject(one.Name)
        document.recompute()
        failed = [one.Label for one in kept if "Invalid" in one.State]
        if failed:
            raise Wrong([f"{label}: no opening of its plate has the unbalance that was asked for" for label in failed])
        found = verify(machine)
        if not found.held:
            raise Wrong(found.words())
    return found


def verify(machine):
    """Hold the solids, as they are now, against the answer.

    Raises
    ------
    Wrong
    """
    if not machine.Answer:
        raise Wrong(["there is no answer yet: balance first"])
    now = asked(machine).body["machine"]
    shaft = shaft_moments(machine)
    first, *others = shaft.values()
    try:
        return verdict(now, json.loads(machine.Answer), sum(others, first), weight_moments(machine))
    except KeyError as missing:
        raise Wrong([f"the tables no longer say {missing}"]) from None


def _new(document, web):
    made = document.addObject("Part::FeaturePython", "Counterweight")
    Counterweight(made)
    made.Label = f"Counterweight {web}"
    if getattr(made, "ViewObject", None) is not None:
        # shown as any other solid
        made.ViewObject.Proxy = 0
    return made


def _ask_for(made, machine, web, one):
    plate = Plate.of(web["envelope"])
    made.Web, made.Outline, made.Frame = web["name"], plate.shape, machine.Frame
    made.InnerRadius, made.OuterRadius = plate.inner_m / MM, plate.outer_m / MM
    made.Thickness, made.Density = plate.thickness_m / MM, plate.density_kg_m3
    made.LargestHalfAngle = web["envelope"].get("max_half_angle_deg", 90.0)
    made.Position = web["position_m"] / MM
    made.AskedUnbalance, made.AskedAngle = one["mass_radius_kg_m"], one["angle_deg"]
