"""The bodies of a shaft as one rotor: mass, centre, and its unbalance in two planes."""

from collections.abc import Iterator, Sequence

import numpy as np

from optimizer.errors import refuse
from optimizer.mechanics.crankshaft.doubts import doubt
from optimizer.mechanics.crankshaft.faces import Frame
from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record
from schemas.answer.shaft import Doubt
from schemas.base.model import FieldProblem
from schemas.request.shaft import Body

#: kg/m3 between which shafts are
_LIGHTEST, _HEAVIEST = 1_000.0, 20_000.0
#: share of the trace, by which a tensor may be off
_ROUNDING = 1e-6
#: lengths of the shaft, above which a body is in other units
_FAR = 5.0


@record(frozen=True)
class RotorMoments:
    """Mass [kg], sum m r (3,) [kg m], and sum m z (x + iy) [kg m2], about the origin of the shaft's frame."""

    mass: float
    first: Real
    axial: complex

    def in_planes(self, planes: tuple[float, float]) -> Complex:
        """Unbalances (2,) in two planes with the same force and couple, kg m."""
        low, high = planes
        static = complex(self.first[0], self.first[1])
        at_low = (static * high - self.axial) / (high - low)
        return np.array([at_low, static - at_low])


def rotor_of(bodies: Sequence[Body], frame: Frame, ends: tuple[float, float] | None) -> RotorMoments:
    """All bodies together, in the frame of the shaft.

    Parameters
    ----------
    ends : of the shaft along its axis, m; None where no face shows them.

    Raises
    ------
    OutOfRange
        where a tensor belongs to no body, or a body to no shaft of that length.
    """
    refuse(problem for n, body in enumerate(bodies) for problem in _problems(n, body, frame, ends))
    mass = np.array([body.mass_kg for body in bodies])
    centre = frame.points(np.array([body.centre_m for body in bodies], dtype=float))
    second = np.stack([_second_moments(body) for body in bodies])
    in_frame = frame.across @ second @ frame.across.T
    products = np.einsum("n,ni,nj->ij", mass, centre, centre) + np.sum(in_frame, axis=0)
    return RotorMoments(float(np.sum(mass)), mass @ centre, complex(products[0, 2], products[1, 2]))


def density_doubts(bodies: Sequence[Body]) -> Iterator[Doubt]:
    """Bodies whose density is that of no metal."""
    for n, body in enumerate(bodies):
        if body.volume_m3 is not None:
            density = body.mass_kg / body.volume_m3
            if not _LIGHTEST <= density <= _HEAVIEST:
                message = f"its density is {density:.4g} kg/m3: shafts have {_LIGHTEST:g} to {_HEAVIEST:g}"
                yield doubt("density", n, message, serious=True, of="bodies")


def _second_moments(body: Body) -> Real:
    """Sum m p pT (3, 3) about the centre of mass, of the tensor of inertia sum m (p.p E - p pT)."""
    tensor = _tensor(body)
    return np.trace(tensor) / 2 * np.eye(3) - tensor


def _tensor(body: Body) -> Real:
    return np.zeros((3, 3)) if body.inertia_kg_m2 is None else np.array(body.inertia_kg_m2, dtype=float)


def _problems(n: int, body: Body, frame: Frame, ends: tuple[float, float] | None) -> Iterator[FieldProblem]:
    tensor, path = _tensor(body), ("bodies", n, "inertia_kg_m2")
    trace = float(np.trace(tensor))
    if np.max(np.abs(tensor - tensor.T)) > _ROUNDING * abs(trace):
        yield FieldProblem(path, "must be symmetric: row by row, minus the products of inertia off the diagonal")
    elif np.min(np.linalg.eigvalsh(_second_moments(body))) < -_ROUNDING * abs(trace):
        message = "belongs to no body: a moment of inertia is larger than both others together, or below zero"
        yield FieldProblem(path, message)
    if ends is not None:
        length, middle = ends[1] - ends[0], np.array([0.0, 0.0, (ends[0] + ends[1]) / 2])
        away = float(np.linalg.norm(frame.points(np.array(body.centre_m, dtype=float)) - middle))
        if away > _FAR * length:
            message = f"{away / length:.4g} lengths of the shaft away from it: are its units those of the faces?"
            yield FieldProblem(("bodies", n, "centre_m"), message)
        gyration = float(np.sqrt(max(0.0, trace) / body.mass_kg))
        if gyration > _FAR * length:
            message = f"a radius of gyration of {gyration:.4g} m in a shaft of {length:.4g} m: is it in kg m2?"
            yield FieldProblem(path, message)
