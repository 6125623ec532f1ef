"""From faces and bodies to a crankshaft: axis -> frame -> round stretches -> webs -> answer."""

import numpy as np

from optimizer.errors import refuse
from optimizer.mechanics.crankshaft.axis import axis_of, extent, frame_of, frame_on, lean, parallel
from optimizer.mechanics.crankshaft.faces import Cylinders, Frame, cylinders_of, freeform_points, planes_of
from optimizer.mechanics.crankshaft.flanks import Flanks
from optimizer.mechanics.crankshaft.plates import Plates, Sides, plates
from optimizer.mechanics.crankshaft.report import Shaft, report
from optimizer.mechanics.crankshaft.rotor import rotor_of
from optimizer.mechanics.crankshaft.stretches import Stretches, stretches
from optimizer.mechanics.crankshaft.units import unit_problems
from schemas.answer.shaft import ShaftAnswer
from schemas.base.model import FieldProblem
from schemas.request.shaft import ShaftFrame, ShaftRequest

#: of the length between the outermost faces, by which measures of one thing differ at most
_TOLERANCE = 1e-5


def read_shaft(request: ShaftRequest) -> ShaftAnswer:
    """The crankshaft that faces and bodies show.

    Raises
    ------
    OutOfRange
        if they show none, or more than one, or are in different units.
    """
    # without faces there are a frame and bodies, as a rule of the request says
    shaft = _shaft(request) if request.faces or request.frame is None else _bare(request.frame)
    rotor = rotor_of(request.bodies, shaft.frame, shaft.ends) if request.bodies else None
    return report(request, shaft, rotor)


def _bare(frame: ShaftFrame) -> Shaft:
    return Shaft(frame_of(frame), Plates((), (), ()), (), None)


def _shaft(request: ShaftRequest) -> Shaft:
    cylinders = cylinders_of(request)
    if not len(cylinders.number):
        refuse([FieldProblem(("faces",), "no outer cylinder is among them: nothing shows where the axis is")])
    refuse(unit_problems(cylinders))
    tolerance = request.tolerance_m or _TOLERANCE * extent(cylinders)
    frame = _pin_frame(request, cylinders, tolerance) if request.frame is None else frame_of(request.frame)
    along, flanks, chain = _faces_in_frame(request, cylinders, frame, tolerance)
    sides = Sides(along, planes_of(request).in_frame(frame), frame.points(freeform_points(request)))
    webs = plates(chain.chain, flanks, sides, tolerance)
    z = along.tips[..., 2]
    if not np.ptp(z) > tolerance:
        refuse([FieldProblem(("faces",), "all round faces along the shaft are at one place: they have no length")])
    return Shaft(frame, webs, chain.doubts, (float(np.min(z)), float(np.max(z))))


def _pin_frame(request: ShaftRequest, cylinders: Cylinders, tolerance: float) -> Frame:
    """The frame with x towards the first pin."""
    line = axis_of(cylinders, tolerance)
    frame = frame_on(line)
    _, _, chain = _faces_in_frame(request, cylinders, frame, tolerance)
    first = next(stretch for stretch in chain.chain if not stretch.journal)
    towards = frame.origin + np.array([first.centre.real, first.centre.imag, 0.0]) @ frame.across
    return frame_on(line, towards)


def _faces_in_frame(
    request: ShaftRequest, cylinders: Cylinders, frame: Frame, tolerance: float
) -> tuple[Cylinders, Flanks, Stretches]:
    """Faces along the shaft, flanks across it, and the round stretches that they show."""
    local = cylinders.in_frame(frame)
    along = local.subset(lean(local.direction, np.array([0.0, 0.0, 1.0])) <= parallel(cylinders, tolerance))
    if not len(along.number):
        refuse([FieldProblem(("frame", "z"), "no outer cylinder is along it")])
    flanks = Flanks.of(planes_of(request).in_frame(frame), tolerance)
    return along, flanks, stretches(along, flanks, tolerance)
