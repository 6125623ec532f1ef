"""First-order force and moment as ellipses, their floor, and their hodographs."""

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import chain
from typing import NamedTuple

import numpy as np

from optimizer.effects.inertia import FIRST_ORDER_EFFECTS
from optimizer.formulation.formulate import RESPONSES
from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.angles import shaft_vectors
from optimizer.mechanics.balance_shafts import shaft_arms
from optimizer.mechanics.frame import phasors
from optimizer.mechanics.inertia import Wrench
from optimizer.mechanics.layout import Layout
from optimizer.numerics.arrays import Complex, Real, read_only
from optimizer.outputs.ellipses import PolarPair, magnitudes
from optimizer.outputs.output import Columns, Output
from optimizer.outputs.phasors import PlainWrench, PolarWrench, polar_wrenches, vectors_of
from optimizer.responses.response import Phasors
from schemas.answer.first_order import FirstOrder, Floor, Residual, ResponseChange, ResponsePeak
from schemas.answer.outputs import Hodographs, Order
from schemas.answer.proof import BoundMultipliers
from schemas.base.curves import Curve
from schemas.base.responses import PAIR


class _Names(NamedTuple):
    """Fields of an ellipse in their unit."""

    peak: str
    minor: str
    peak_x: str
    peak_y: str
    co_rotating: str
    counter_rotating: str


#: of force and moment over the turn
_HODOGRAPH = ("force_x_N", "force_y_N", "moment_x_Nm", "moment_y_Nm")
#: of force and moment
_FIELDS = tuple(_Names._make(f"{name}_{unit}" for name in _Names._fields) for unit in ("N", "Nm"))


def first_order(wrench: Wrench) -> FirstOrder:
    """Ellipses of force [N] and moment [N m] of one machine."""
    return FirstOrder.of_figures(_ellipses(polar_wrenches([PlainWrench.of(wrench)]))[0])


def floor(layout: Layout, wrench: Wrench) -> Floor:
    """What counterweights on the shaft cannot remove: the counter-rotating phasors.

    A balance shaft that turns backwards can, each by itself; the moment only outside the reference plane.
    """
    force, moment = magnitudes([complex(pair.counter) for pair in wrench])
    if layout.balance is not None:
        backwards = layout.balance.ratio == -1.0
        force = 0.0 if backwards.any() else force
        moment = 0.0 if (backwards & (shaft_arms(layout, layout.balance) != 0.0)).any() else moment
    return Floor.of_figures({"force_N": force, "moment_Nm": moment})


def peaks(wrench: Wrench) -> dict[str, Real]:
    """Peaks of force [N] and moment [N m] as columns (...)."""
    return {"force_peak_N": wrench.force.peak, "moment_peak_Nm": wrench.moment.peak}


def response_peaks(scene: Prepared, wrench: Wrench) -> tuple[ResponsePeak, ...]:
    """Peaks of the responses of one machine that count beside force and moment."""
    return tuple(
        ResponsePeak(
            response=fields.name, label=fields.label, unit=fields.unit, peak=float(phasors(shares, wrench).peak)
        )
        for fields, shares in scene.extra_responses
    )


def _columns(scene: Prepared, unbalance: Complex) -> dict[str, Real]:
    wrench = scene.first_order(unbalance)
    # a response that counts in some designs has its column in all
    return peaks(wrench) | {
        response.fields.peak: phasors(response.shares(scene.layout, scene.objective), wrench).peak
        for response in RESPONSES.values()
        if response.name not in PAIR
    }


def _changes(scene: Prepared, wrenches: Sequence[Wrench]) -> tuple[ResponseChange, ...]:
    """The same before and after; the latter is missing where there are no counterweights to show."""
    if not scene.extra_responses:
        return ()
    before, *after = (response_peaks(scene, wrench) for wrench in wrenches)
    return tuple(
        ResponseChange(
            response=was.response,
            label=was.label,
            unit=was.unit,
            before=was.peak,
            after=after[0][k].peak if after else None,
        )
        for k, was in enumerate(before)
    )


def smallest_peaks(value: Mapping[str, float], bound: Mapping[str, float]) -> dict[str, float]:
    """Fields of the smallest peaks by themselves [N], [N m], and of their bounds, from those by response."""
    return {
        "smallest_force_N": value["force"],
        "smallest_moment_Nm": value["moment"],
        "smallest_force_lower_bound_N": bound["force"],
        "smallest_moment_lower_bound_Nm": bound["moment"],
    }


def smallest_proofs(proofs: Mapping[str, BoundMultipliers]) -> dict[str, BoundMultipliers]:
    """Fields of the proofs of those bounds."""
    return {"smallest_force": proofs["force"], "smallest_moment": proofs["moment"]}


def residual(scene: Prepared, unbalance: Complex | None) -> Residual:
    """First order of one machine without and with counterweights, and the second beside it."""
    wrenches = [scene.first_order()] if unbalance is None else [scene.first_order(), scene.first_order(unbalance)]
    fitted = unbalance is not None
    count, with_shafts = len(wrenches), [False, True] if fitted and scene.shafts is not None else [False]
    polars = polar_wrenches([*map(PlainWrench.of, wrenches), *_second_order(scene, with_shafts)])
    first = [polar.order(1) for polar in polars[:count]]
    # mostly one, which stands without counterweights and with them
    twice = [Order.of_figures(polar.order(2)) for polar in polars[count:]]
    ellipses = _ellipses(polars[:count])
    # one validation of the whole takes a third of the time of one of each part
    return Residual.of_figures(
        {
            "before": ellipses[0],
            "after": ellipses[1] if fitted else None,
            "orders": {
                "before": (first[0], twice[0] if twice else None),
                "after": (first[1], twice[-1] if twice else None) if fitted else None,
            },
            "responses": _changes(scene, wrenches),
        }
    )


def _second_order(scene: Prepared, with_shafts: Sequence[bool]) -> list[PlainWrench]:
    """Second order of one machine, which balance shafts alone change, without and with them; none where a row has no
    rod."""
    if any(map(math.isnan, scene.layout.reciprocating.rod_ratio.tolist())):
        return []
    own, square = scene.second_order, scene.omega_squared
    return [PlainWrench.of(scene.with_shafts(own, 2) if turning else own, square) for turning in with_shafts]


def hodographs(scene: Prepared, unbalance: Complex | None) -> Hodographs:
    """First order of one machine over the turn."""
    unit = shaft_vectors(scene.layout.sense, scene.angle_rad)[: scene.first_turn_deg.size]
    wrenches = [scene.first_order()] if unbalance is None else [scene.first_order(), scene.first_order(unbalance)]
    # force and moment of each, all at once
    vectors = vectors_of(wrenches)
    curves = Phasors(vectors[..., 0], vectors[..., 1]).of_rotation(unit)
    parts = Curve.rows(read_only(np.stack([curves.real, curves.imag], axis=2)))
    return Hodographs.of_figures(
        {
            "angle_deg": scene.angles if scene.turns == 1 else scene.first_turn_deg,
            "before": dict(zip(_HODOGRAPH, parts[:4], strict=True)),
            "after": dict(zip(_HODOGRAPH, parts[4:], strict=True)) if len(wrenches) > 1 else None,
        }
    )


def _ellipses(wrenches: Sequence[PolarWrench]) -> list[dict[str, dict[str, float]]]:
    """Fields of the ellipses (:class:`schemas.answer.first_order.FirstOrder`) of wrenches.

    Each figure is that of :class:`optimizer.responses.response.Phasors`, from parts that several figures share.
    """
    components: list[complex] = []
    for pair in chain.from_iterable(wrenches):
        across = pair.counter.conjugate()
        components += (pair.co + across, pair.co - across)
    along = iter(magnitudes(components))
    of_force, of_moment = _FIELDS
    return [
        {"force": _ellipse(of_force, force, along), "moment": _ellipse(of_moment, moment, along)}
        for force, moment in wrenches
    ]


def _ellipse(fields: _Names, pair: PolarPair, along: Iterator[float]) -> dict[str, float]:
    """Fields of one.

    Parameters
    ----------
    along : from the largest components along x and y on.
    """
    peak, minor, peak_x, peak_y, co_rotating, counter_rotating = fields
    co, counter = pair.co_size, pair.counter_size
    return {
        peak: co + counter,
        minor: abs(co - counter),
        "major_axis_deg": pair.axis_deg,
        peak_x: next(along),
        peak_y: next(along),
        co_rotating: co,
        counter_rotating: counter,
    }


RESIDUAL = Output(
    "residual",
    "first-order force and moment, before and after",
    FIRST_ORDER_EFFECTS,
    residual,
    Columns(_columns),
)
HODOGRAPH = Output("hodograph", "first-order force and moment over a revolution", FIRST_ORDER_EFFECTS, hodographs)
