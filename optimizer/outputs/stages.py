"""The eight balancing stages of the slides on balancing, for any layout.

What turns with the shaft can be balanced on the shaft, nothing else can. In every stage ``value`` is what the
machine has without counterweights and ``remaining`` is what the counterweights leave of it.

Superposition (stage VII of the slides) splits the phasor c of what turns with the crankshaft, counterweights and
balance shafts of its speed, force and moment each for itself:
- the rotating masses R come first: they take the part of c that is opposed to R, at most -R;
- the rest serves the first-order reciprocating masses (A1, B1).
With c = -q R/|R| + c', where q is Re(-c conj(R))/|R| held within [0, |R|], stages I and II keep (|R| - q) R/|R|,
stages III and IV keep (A1 + c', B1 + b), b of the balance shafts that turn backwards. Their sum is the first-order
residual, whatever the split; without counterweights every ``remaining`` equals its ``value``. Where there are webs in
two planes, iron shared out in this way exists. Balance shafts at twice the speed leave (A2 + c2, B2 + b2).
"""

from collections.abc import Sequence
from typing import Any, Literal, NamedTuple

import numpy as np

from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.balance_shafts import of_balance_shafts
from optimizer.mechanics.inertia import Wrench, counterweights
from optimizer.mechanics.layout import Layout
from optimizer.numerics.arrays import Complex, Real
from optimizer.outputs.ellipses import Ellipse
from optimizer.outputs.output import Columns, Output
from optimizer.outputs.phasors import PlainWrench, polar_wrenches
from optimizer.outputs.rules_of_thumb import SAME_PLANE_M, SHAPE_TOLERANCE, force_rules, moment_rules
from optimizer.outputs.stage_headings import HEADINGS, STAGE_III, STAGE_IV, STAGE_VII, STAGE_VIII, WORDS
from optimizer.outputs.stage_parts import (
    about_centre,
    actings,
    in_two_planes,
    iron,
    missing,
    superposed,
)
from optimizer.responses.response import Phasors
from schemas.answer.outputs import STAGE_UNITS

Balanceable = Literal["fully", "partly", "no"]

#: what is smaller than this share of the machine's scale is not worth a word in the summary
_NEGLIGIBLE = 1e-5
#: share of the machine's scale that is rounding
_ROUNDING = 1e-13


class _Shape(NamedTuple):
    """What an engineer reads of a stage beside its size."""

    plane: str
    frequency: str
    balanceable: Balanceable


#: of forces and moments of the stages I to VI, and of what stage VIII sums up
_ORDERS, _SUMMARY_ORDERS = (1, 1, 1, 1, 2, 2), (1, 1, 2, 2)
_NAMES = ("first-order force", "first-order moment", "second-order force", "second-order moment")


def stages(
    layout: Layout,
    turning: Wrench,
    first: Wrench,
    second: Wrench,
    unbalance: Complex | None,
    shafts: Complex | None = None,
) -> tuple[dict[str, Any], ...]:
    """Stages I to VIII of one machine: fields of :class:`schemas.answer.outputs.Stage`.

    Parameters
    ----------
    layout : a machine without leading axes.
    turning, first, second : force and moment of its rotating masses, and of the first and second order of
        its reciprocating masses, over omega^2.
    unbalance : (webs,) mass-radius products m R e^{ja} of the counterweights, kg m; None where there are
        none to show (infeasible), which leaves ``remaining`` null.
    shafts : (S,) the same of its balance shafts, kg m; None where there are none.
    """
    speed, planes, centre = float(layout.omega), layout.webs.position.tolist(), float(layout.centre_plane)
    square, (low, high) = speed * speed, (min(planes), max(planes)) if planes else (centre, centre)
    centred, *about = about_centre(layout, turning, first)
    rotating, moving = (PlainWrench.of(wrench) for wrench in about)
    whole = rotating.plus(moving)
    lacking = missing(planes, centre, whole.force, whole.moment)
    in_units = [PlainWrench.of(part, square) for part in (turning, first, second)]
    primary = in_units[0].plus(in_units[1])
    wrenches = [PlainWrench.of(first), primary, *in_units]
    if unbalance is not None:
        fitted = PlainWrench.of(_fitted(layout, unbalance, shafts), square)
        wrenches += [primary.plus(fitted), *superposed(in_units[0], in_units[1], fitted)]
        whole = whole.plus(PlainWrench.of(_fitted(centred, unbalance, shafts)))
        if shafts is not None:
            wrenches.append(in_units[2].plus(PlainWrench.of(_of_shafts(layout, shafts, 2), square)))
    of_force, of_moment, *pairs = [pair.ellipse for wrench in polar_wrenches(wrenches) for pair in wrench]
    of_all, was, with_fitted = [*pairs[:2], *pairs[6:8]], pairs[2:8], pairs[8:]
    value = [*(pair.peak for pair in was), lacking, of_all[0].peak + of_all[2].peak]
    now, all_left = was, of_all
    remaining: Sequence[float | None] = [None] * len(HEADINGS)
    if unbalance is not None:
        # counterweights on the crankshaft leave the second order as it is
        twice = with_fitted[6:] or was[4:]
        now, all_left = [*with_fitted[2:6], *twice], [*with_fitted[:2], *twice]
        lacking = missing(planes, centre, whole.force, whole.moment)
        remaining = [*(pair.peak for pair in now), lacking, all_left[0].peak + all_left[2].peak]
    scale = _scale(layout)
    noise = (_ROUNDING * scale[0], _ROUNDING * scale[1])
    before, after, summed, remainder = (
        actings(list(zip(pairs, orders, strict=True)), speed, noise)
        for pairs, orders in ((was, _ORDERS), (now, _ORDERS), (of_all, _SUMMARY_ORDERS), (all_left, _SUMMARY_ORDERS))
    )
    shapes = [
        _Shape(_plane(pair), _frequency(n, speed), _balanceable(pair, n)) for pair, n in zip(was, _ORDERS, strict=True)
    ]
    shapes.append(_Shape(_planes_of_iron(planes), _frequency(1, speed), "fully"))
    shapes.append(_summary(of_all, all_left, scale, speed))
    in_planes = iron(planes, centre, rotating, moving)
    rules = {STAGE_III: force_rules(of_force, square), STAGE_IV: moment_rules(of_moment, square, high - low)}
    return tuple(
        [
            {
                **WORDS[k],
                "plane": shape.plane,
                "frequency": shape.frequency,
                "balanceable": shape.balanceable,
                "value": value[k],
                "remaining": remaining[k],
                "acting": summed if heading is STAGE_VIII else before[k : k + 1],
                "left": None if unbalance is None else remainder if heading is STAGE_VIII else after[k : k + 1],
                "iron": in_planes if heading is STAGE_VII else (),
                "rules_of_thumb": rules.get(heading, ()),
            }
            for k, (heading, shape) in enumerate(zip(HEADINGS, shapes, strict=True))
        ]
    )


def _fitted(layout: Layout, unbalance: Complex, shafts: Complex | None) -> Wrench:
    """First order of counterweights (..., webs) kg m and of balance shafts (..., S) kg m, over omega^2."""
    own = counterweights(layout, unbalance)
    return own if shafts is None else own.plus(_of_shafts(layout, shafts, 1))


def _of_shafts(layout: Layout, shafts: Complex, order: int) -> Wrench:
    if layout.balance is None:
        raise ValueError("unbalances of balance shafts, and the machine has none")
    return of_balance_shafts(layout, layout.balance, shafts, order)


def amounts(
    layout: Layout,
    turning: Wrench,
    first: Wrench,
    second: Wrench,
    unbalance: Complex | None,
    shafts: Complex | None = None,
) -> Real:
    """What the eight stages come to with counterweights (..., webs) kg m, or without: (..., 8) in their units.

    Parameters
    ----------
    layout : of one machine, or of many with leading axes (...).
    turning, first, second : as for :func:`stages`.
    shafts : (..., S) kg m, as for :func:`stages`.
    """
    square = layout.omega**2
    missing = _Missing(*about_centre(layout, turning, first)).of(unbalance, shafts)
    if unbalance is not None and shafts is not None:
        second = second.plus(_of_shafts(layout, shafts, 2))
    turning, first, second = (part.times(square) for part in (turning, first, second))
    primary = turning.plus(first)
    if unbalance is not None:
        fitted = _fitted(layout, unbalance, shafts).times(square)
        primary = primary.plus(fitted)
        turning, first = _superpose(turning, first, fitted)
    sizes = [pair.peak for part in (turning, first, second) for pair in part]
    return np.stack([*sizes, missing, primary.force.peak + second.force.peak], axis=-1)


def _superpose(turning: Wrench, first: Wrench, fitted: Wrench) -> tuple[Wrench, Wrench]:
    """What is left of rotating and of first-order reciprocating masses."""
    force = _split(turning.force, first.force, fitted.force)
    moment = _split(turning.moment, first.moment, fitted.moment)
    return Wrench(force[0], moment[0]), Wrench(force[1], moment[1])


def _split(turning: Phasors, first: Phasors, fitted: Phasors) -> tuple[Phasors, Phasors]:
    size = np.abs(turning.co)
    # a denormal number has no direction that could be divided out
    nonzero = size > np.finfo(float).tiny
    outward: Complex = np.where(nonzero, turning.co / np.where(nonzero, size, 1.0), 0j)
    opposed = np.minimum(np.maximum(-(fitted.co * np.conj(outward)).real, 0.0), size)
    return (
        Phasors((size - opposed) * outward, turning.counter),
        Phasors(first.co + fitted.co + opposed * outward, first.counter + fitted.counter),
    )


class _Missing:
    """Stage VII: |u1| + |u2| of two planes that cancel all that turns with the shaft, (...) kg m."""

    def __init__(self, centred: Layout, turning: Wrench, first: Wrench) -> None:
        self._centred, self._wrench = centred, turning.plus(first)

    def of(self, unbalance: Complex | None, shafts: Complex | None) -> Real:
        """With counterweights (..., webs) kg m and balance shafts (..., S) kg m, or without."""
        centred, wrench = self._centred, self._wrench
        if unbalance is not None:
            wrench = wrench.plus(_fitted(centred, unbalance, shafts))
        force, couple = wrench.force.co, wrench.moment.co
        planes, centre = centred.webs.position, centred.centre_plane
        if planes.shape[-1] == 0:
            return np.abs(force)
        low, high = np.minimum.reduce(planes, axis=-1), np.maximum.reduce(planes, axis=-1)
        apart = high - low > SAME_PLANE_M
        ends = in_two_planes(force, couple, low, np.where(apart, high, low + 1.0), centre)
        return np.where(apart, ends, np.abs(force))


def _planes_of_iron(planes: Sequence[float]) -> str:
    """Where stage VII puts it."""
    if not planes:
        return "no webs, force only"
    low, high = min(planes), max(planes)
    if high - low > SAME_PLANE_M:
        return f"planes z = {low:.6g} m and z = {high:.6g} m"
    return f"plane z = {low:.6g} m, force only"


def _summary(was: Sequence[Ellipse], left: Sequence[Ellipse], scale: tuple[float, float], speed: float) -> _Shape:
    """Stage VIII: every force and moment of orders 1 and 2 together.

    Parameters
    ----------
    was, left : force and moment of the first order, then of the second, without and with counterweights.
    scale : of the machine, N and N m.
    """
    orders, words, verdicts = set[int](), [], set[Balanceable]()
    for k, (name, order, before, after) in enumerate(zip(_NAMES, _SUMMARY_ORDERS, was, left, strict=True)):
        if after.peak > _NEGLIGIBLE * scale[k % 2]:
            orders.add(order)
            words.append(f"{name} {after.peak:.5g} {('N', 'N m')[k % 2]}, {_plane(after)}")
        if before.peak > 0:
            verdicts.add(_balanceable(before, order))
    return _Shape(
        plane="; ".join(words) or "none",
        frequency=", ".join(_frequency(order, speed) for order in sorted(orders)) or "none",
        balanceable="partly" if len(verdicts) > 1 else next(iter(verdicts), "fully"),
    )


def _scale(layout: Layout) -> tuple[float, float]:
    """Force in N if all masses pushed the same way, and moment in N m if they did so at opposite ends."""
    turning, moving = layout.rotating, layout.reciprocating
    product = float(turning.mass @ turning.radius) + float(moving.mass @ moving.crank_radius)
    places = (turning.position, moving.position, layout.webs.position)
    planes = [plane for part in places for plane in part.tolist()] + [float(layout.reference_plane)]
    speed = float(layout.omega)
    force = product * (speed * speed)
    return force, force * (max(planes) - min(planes))


def _balanceable(pair: Ellipse, order: int) -> Balanceable:
    """Whether counterweights on the shaft can balance a pair: only the co-rotating phasor of the first order."""
    if pair.peak == 0 or (order == 1 and pair.counter <= SHAPE_TOLERANCE * pair.co):
        return "fully"
    return "no" if order > 1 or pair.co <= SHAPE_TOLERANCE * pair.counter else "partly"


def _plane(pair: Ellipse) -> str:
    """Direction of a force, or the direction that spans the plane of a couple together with the shaft."""
    if pair.peak == 0:
        return "none"
    if pair.counter <= SHAPE_TOLERANCE * pair.co:
        return f"rotates with the shaft, at {_degrees(pair.co_deg, 360)} deg at shaft angle 0"
    if pair.co <= SHAPE_TOLERANCE * pair.counter:
        return f"rotates against the shaft, at {_degrees(pair.counter_deg, 360)} deg at shaft angle 0"
    axis = _degrees(pair.axis_deg, 180)
    if pair.minor <= SHAPE_TOLERANCE * pair.peak:
        return f"along {axis} deg (fixed direction)"
    return f"ellipse, major axis {axis} deg"


def _degrees(angle: float, period: int) -> str:
    return f"{round(angle, 1) % period:.1f}"


def _frequency(order: int, speed: float) -> str:
    return f"{'n' if order == 1 else f'{order}n'} = {order * speed / (2.0 * np.pi):.3f} Hz"


#: effects whose results the stages are about
_PARTS = ("rotating_inertia", "reciprocating_inertia", "second_order")


def _figure(scene: Prepared, unbalance: Complex | None) -> tuple[dict[str, Any], ...]:
    turning, first, second = (scene.results[name] for name in _PARTS)
    return stages(scene.layout, turning, first, second, unbalance, scene.shafts)


def _columns(scene: Prepared, unbalance: Complex) -> dict[str, Real]:
    turning, first, second = (scene.results[name] for name in _PARTS)
    results: dict[str, Real] = {}
    for name, fitted in (("value", None), ("remaining", unbalance)):
        sizes = amounts(scene.layout, turning, first, second, fitted, scene.shafts)
        results |= {f"stage_{name}.{stage}": sizes[..., k] for k, stage in enumerate(STAGE_UNITS)}
    return results


STAGES = Output("stages", "the eight balancing stages", _PARTS, _figure, Columns(_columns))
