"""The job: read the shaft, ask the service, draw the counterweights, hold the solids against the answer.

Needs FreeCAD, no window. Whatever goes wrong leaves the document as it was.
"""

from __future__ import annotations

import json
from contextlib import contextmanager
from dataclasses import replace
from typing import NamedTuple

import FreeCAD as App

from .asking import ask, warnings
from .faces import MM, body_of, faces_of
from .features import Counterweight, Machine, request_of, shaft_moments, sizes, weight_moments
from .plate import Plate
from .plausible import reasons, summary, unlike
from .shaft import ask_shaft, doubts, tables
from .sheets import Wrong, completed
from .solids import STEEL_KG_M3, shape_of
from .tables import write
from .verdict import verdict

#: below this share of the heaviest a counterweight is none
_NOTHING = 1e-9


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


def read_shaft(document, bodies, service, densities=None, frame=None, description=None, force=False):
    """The machine of some bodies, with tables of what their faces show; it is for the designer to correct and complete.

    Parameters
    ----------
    service : that reads the shaft from the faces.
    densities : of the bodies, kg/m3; steel if not said.
    frame : of the shaft; from its faces if not said: x towards the first crank pin.
    description : a request with what no face shows, if it is known already.
    force : go on in spite of what shows that this is no shaft, and say so.

    Raises
    ------
    Wrong
    """
    selected = selection_of(bodies, densities, frame)
    return drawn_from(document, selected, ask_shaft(service, selected.question), description, force)


class Selected(NamedTuple):
    """Bodies, their densities in kg/m3, and what the service is asked about them."""

    bodies: list
    densities: list
    question: dict


def selection_of(bodies, densities=None, frame=None):
    """Faces and bodies as the service is asked about them; of steel if no density is said.

    Raises
    ------
    Wrong
    """
    densities = list(densities or [STEEL_KG_M3] * len(bodies))
    shapes = [shape_of(body) for body in bodies]
    if not any(shape.Solids for shape in shapes):
        raise Wrong(["nothing that is selected is a solid: select the bodies of the shaft"])
    surfaces = [body.Label for body, shape in zip(bodies, shapes) if not shape.Solids or shape.Volume <= 0.0]
    if surfaces:
        raise Wrong([f"{label}: a surface without volume: select solids only" for label in surfaces])
    question = {
        "faces": [face for body, shape in zip(bodies, shapes) for face in faces_of(shape, body.Label)],
        "bodies": [body_of(shape, body.Label, density) for body, shape, density in zip(bodies, shapes, densities)],
    }
    if frame is not None:
        x, z = (frame.Rotation.multVec(App.Vector(*axis)) for axis in ((1, 0, 0), (0, 0, 1)))
        question["frame"] = {"origin_m": [value * MM for value in frame.Base], "x": list(x), "z": list(z)}
    return Selected(list(bodies), densities, question)


def drawn_from(document, selected, answer, description=None, force=False):
    """The machine that an answer about faces shows, in the document.

    Raises
    ------
    Wrong
        for what has to be corrected first, unless it is forced.
    """
    bodies, densities, question = selected
    serious = doubts(question, answer, serious=True)
    tables_by_name = tables(answer, densities[0] if len(set(densities)) == 1 else STEEL_KG_M3)
    if description is not None:
        serious += unlike(answer["throws"], description.get("machine", {}).get("throws", ()))
    if serious and not force:
        raise Wrong([f"not the shaft that it seems to be: {line}" for line in serious])
    if description is not None:
        tables_by_name = completed(tables_by_name, description)
    with change(document, "Read shaft"):
        machine = document.addObject("App::FeaturePython", "Machine")
        Machine(machine)
        machine.Shaft, machine.Frame = bodies, _placement(answer["frame"])
        machine.Densities, machine.Doubts = densities, serious + doubts(question, answer, serious=False)
        machine.Forced = "; ".join(serious)
        sheets = []
        for name, lines in tables_by_name.items():
            sheet = document.addObject("Spreadsheet::Sheet", name)
            sheet.Label = name
            write(sheet, lines)
            sheets.append(sheet)
        machine.Tables = sheets
        document.recompute()
    return machine


def _placement(frame):
    origin = [value / MM for value in frame["origin_m"]]
    rows = zip(frame["x"], frame["y"], frame["z"], origin)
    return App.Placement(App.Matrix(*(value for row in rows for value in row), 0, 0, 0, 1))


def shaft_words(machine):
    """Mass and sizes of the shaft, for the designer to confirm.

    Raises
    ------
    Wrong
    """
    return summary(sizes(machine), request_of(machine).body["machine"]["throws"])


def question_of(machine, force=False):
    """What is to be asked, if the shaft can be one.

    Raises
    ------
    Wrong
        with what shows that it cannot, unless it is forced; then the machine keeps that.
    """
    question = request_of(machine)
    why = reasons(sizes(machine), question.body["machine"])
    if why and not force:
        raise Wrong([f"not asked: {line}" for line in why])
    if why:
        machine.Forced = "; ".join(dict.fromkeys([*filter(None, machine.Forced.split("; ")), *why]))
    return question


def balance(machine, service, force=False):
    """Ask and draw; the verdict on the solids."""
    question = question_of(machine, force)
    return draw(machine, question, ask(service, question))


def draw(machine, question, answer):
    """Draw the counterweights of an answer; those that were drawn before follow, or go.

    Raises
    ------
    Wrong
        if one cannot be drawn, or the solids do not leave what the answer says.
    """
    document, request = machine.Document, question.body
    with change(document, "Balance"):
        solids = {weight.Web: weight for weight in machine.Counterweights}
        heaviest = max((counterweight["mass_kg"] for counterweight in answer["counterweights"]), default=0.0)
        webs = {web["name"]: web for web in request["machine"]["webs"]}
        weights = []
        for weight in answer["counterweights"]:
            if weight["mass_kg"] > _NOTHING * heaviest:
                solid = solids.pop(weight["web"], None) or _new(document, weight["web"])
                _ask_for(solid, machine, webs[weight["web"]], weight)
                weights.append(solid)
        machine.Counterweights = weights
        machine.Request, machine.Answer = json.dumps(request), json.dumps(answer)
        for weight in solids.values():
            document.removeObject(weight.Name)
        document.recompute()
        failed = [weight.Label for weight in weights if "Invalid" in weight.State]
        if failed:
            raise Wrong([f"{label}: no opening of its plate has the unbalance that was asked for" for label in failed])
        result = verify(machine)
        if not result.held:
            raise Wrong(result.words())
    return replace(result, notes=(*result.notes, *warnings(answer, question)))


def verify(machine):
    """Hold the solids, as they are now, against the answer.

    Raises
    ------
    Wrong
    """
    if not machine.Answer:
        raise Wrong(["there is no answer yet: balance first"])
    now = request_of(machine).body["machine"]
    shaft = shaft_moments(machine)
    first, *remainder = shaft.values()
    try:
        result = verdict(now, json.loads(machine.Answer), sum(remainder, first), weight_moments(machine))
    except KeyError as missing:
        raise Wrong([f"the tables no longer say {missing}"]) from None
    return replace(result, notes=(f"FORCED in spite of: {machine.Forced}",)) if machine.Forced else result


def _new(document, web):
    solid = document.addObject("Part::FeaturePython", "Counterweight")
    Counterweight(solid)
    solid.Label = f"Counterweight {web}"
    if getattr(solid, "ViewObject", None) is not None:
        # shown as any other solid
        solid.ViewObject.Proxy = 0
    return solid


def _ask_for(solid, machine, web, counterweight):
    plate = Plate.of(web["envelope"])
    solid.Web, solid.Outline, solid.Frame = web["name"], plate.shape, machine.Frame
    solid.InnerRadius, solid.OuterRadius = plate.inner_m / MM, plate.outer_m / MM
    solid.Thickness, solid.Density = plate.thickness_m / MM, plate.density_kg_m3
    solid.LargestHalfAngle = web["envelope"].get("max_half_angle_deg", 90.0)
    solid.Position = web["position_m"] / MM
    solid.AskedUnbalance, solid.AskedAngle = counterweight["mass_radius_kg_m"], counterweight["angle_deg"]
