"""The eight stages of balancing: what each comes to, what counterweights leave of it, and what acts.

I and II are the force and the moment of what rotates, R; III and IV of the first order of what moves along the rows,
(A1, B1); V and VI of the second, (A2, B2). What turns with the shaft and is fitted, c, comes against R first:
c = -q R/|R| + c' with q = Re(-c conj(R))/|R| within [0, |R|] leaves (|R| - q) R/|R|, and (A1 + c', B1 + b) beside what
is fitted that turns backwards, b. VII is the iron for all that turns with the shaft, VIII the sum of both orders.
"""

from __future__ import annotations

from typing import Dict, List, NamedTuple, Optional, Sequence, Tuple

from verify_answer import Fitted
from verify_claims import EVIDENCE, Claims, figure, same
from verify_ellipses import Motion, Pair, acting, all_balanceable, balanceable
from verify_iron import ends, iron, missing
from verify_machine import NAMES, Machine, Responses
from verify_numbers import ABOUT_ONE, ONE, ZERO, J, NotCovered, Number, Place, largest, real, total
from verify_orders import of_order
from verify_thumb import rules

CLAIM = "stages"
NUMBERS = ("I", "II", "III", "IV", "V", "VI", "VII", "VIII")
UNITS = {"force": "N", "moment": "N m"}
#: of the figures of each stage
_FIGURES = ("N", "N m", "N", "N m", "N", "N m", "kg m", "N")
#: force or moment of the stages I to VI, and of all that the last one holds, each with its order
_STAGES = [(name, order) for order in (1, 1, 2) for name in NAMES]
_ALL = [(name, order) for order in (1, 2) for name in NAMES]
#: share of the machine's scale that is rounding, and how much of it may be counted otherwise here
_ROUNDING, _WIDE = 1e-13, 2.0
#: of what rotates there is no direction where so much of its size is unknown
_UNKNOWN = 4
_WORDS = ("title", "quantity", "formula", "plane", "frequency")


class State(NamedTuple):
    """A machine without or with what is fitted: pairs of the stages I to VI, and those of both orders."""

    stages: List[Pair]
    orders: List[Pair]
    values: List[Number]  # of all stages


def stages(request: Place, machine: Machine, answer: Place, there: Optional[Fitted]) -> Claims:
    """All eight; without what is fitted where there is none to show."""
    place = answer / "stages"
    if not place:
        return
    entries = list(place)
    yield CLAIM, place, ONE if len(entries) == len(NUMBERS) else -ONE, ONE
    planes = ends(machine)
    was = _before(request, machine, planes)
    now = None if there is None else _after(request, machine, was, there, planes)
    speed = (request / "machine" / "speed_rpm").number() * ABOUT_ONE / real(60)
    noise = _noise(machine)
    for k, entry in enumerate(entries[: len(NUMBERS)]):
        yield same(CLAIM, entry / "stage", NUMBERS[k])
        yield same(CLAIM, entry / "unit", _FIGURES[k])
        for field in _WORDS:
            yield EVIDENCE, entry / field, None, ONE
        yield figure(CLAIM, entry / "value", was.values[k])
        verdicts = _verdicts(was, k)
        yield CLAIM, entry / "balanceable", ONE if (entry / "balanceable").value in verdicts else -ONE, ONE
        yield from _moving(entry / "acting", was, k, noise, speed)
        if now is None:
            yield same(CLAIM, entry / "remaining", None)
            yield same(CLAIM, entry / "left", None)
        else:
            yield figure(CLAIM, entry / "remaining", now.values[k])
            yield from _moving(entry / "left", now, k, noise, speed)
        yield from iron(CLAIM, machine, entry / "iron", planes if NUMBERS[k] == "VII" else [])
        yield from _rules(machine, entry / "rules_of_thumb", was, k, planes)


def _verdicts(was: State, k: int) -> Sequence[str]:
    """What may be said of whether a stage can be balanced."""
    if NUMBERS[k] == "VII":
        return ["fully"]
    if NUMBERS[k] == "VIII":
        return [*all_balanceable([(pair, order) for pair, (_, order) in zip(was.orders, _ALL)])]
    return [*balanceable(was.stages[k], _STAGES[k][1])]


def _moving(place: Place, state: State, k: int, noise: Dict[str, Number], speed: Number) -> Claims:
    """What acts in a stage, as data: one pair, of the last stage all, of iron none."""
    pairs, kinds = (state.orders, _ALL) if NUMBERS[k] == "VIII" else (state.stages[k : k + 1], _STAGES[k : k + 1])
    entries = list(place)
    yield CLAIM, place, ONE if place and len(entries) == len(pairs) else -ONE, ONE
    for entry, pair, (name, order) in zip(entries, pairs, kinds):
        yield from acting(CLAIM, entry, pair, Motion(name, UNITS[name], order, noise[name]), speed)


def _rules(machine: Machine, place: Place, was: State, k: int, planes: Sequence[float]) -> Claims:
    """Of the first order of what moves along the rows; a couple takes two counterweights, in planes that are apart."""
    if NUMBERS[k] == "III":
        yield from rules(CLAIM, place, was.stages[k], "force", machine.square, ONE)
    elif NUMBERS[k] == "IV":
        span = None if len(planes) < 2 else real(2) / ((real(planes[1]) - real(planes[0])) * ABOUT_ONE)
        yield from rules(CLAIM, place, was.stages[k], "moment", machine.square, span)
    else:
        yield CLAIM, place, ONE if not list(place) else -ONE, ONE


def _before(request: Place, machine: Machine, planes: Sequence[float]) -> State:
    second = of_order(request, machine, 2)
    if second is None:
        raise NotCovered(request / "machine" / "throws")
    turning = machine.alone([mass for mass in machine.masses if mass.counter is ZERO])
    moving = machine.alone([mass for mass in machine.masses if mass.counter is not ZERO])
    pairs = [*_pairs(turning), *_pairs(moving), *_pairs(second)]
    return _state(pairs, [*_pairs(machine.before), *pairs[4:]], missing(machine, machine.masses, planes))


def _after(request: Place, machine: Machine, was: State, there: Fitted, planes: Sequence[float]) -> State:
    fitted, second = _pairs(machine.alone(there.first)), of_order(request, machine, 2, there.on_shafts)
    twice = _pairs(second or {})
    shared = [superposed(*pairs) for pairs in zip(was.stages[:2], was.stages[2:4], fitted)]
    return _state(
        [*(turning for turning, _ in shared), *(moving for _, moving in shared), *twice],
        [*_pairs(machine.responses(there.first)), *twice],
        missing(machine, [*machine.masses, *there.first], planes),
    )


def _state(pairs: List[Pair], orders: List[Pair], lacking: Number) -> State:
    return State(pairs, orders, [*(pair.peak for pair in pairs), lacking, orders[0].peak + orders[2].peak])


def _pairs(responses: Responses) -> List[Pair]:
    return [Pair(*responses[name]) for name in NAMES]


def superposed(turning: Pair, moving: Pair, fitted: Pair) -> Tuple[Pair, Pair]:
    """What is left of what rotates and of what moves along the rows: the former is opposed first."""
    size = abs(turning.co)
    if size.low * _UNKNOWN <= size.high:
        # whatever its direction, no more than all of it is opposed
        noise = Number(-size.high, size.high)
        anywhere = noise + J * noise
        left, iron_share = anywhere, anywhere
    else:
        outward = turning.co / size
        share = largest(-(fitted.co * outward.conjugate()).parts()[0], ZERO)
        share = -largest(-share, -size)
        left, iron_share = (size - share) * outward, share * outward
    return Pair(left, turning.counter), Pair(moving.co + fitted.co + iron_share, moving.counter + fitted.counter)


def _noise(machine: Machine) -> Dict[str, Number]:
    """What is rounding beside all masses at one end, in force and in moment."""
    size = total(abs(mass.product) * real(1 if mass.counter is ZERO else 2) for mass in machine.masses) * machine.square
    planes: List[Number] = [mass.position for mass in machine.masses]
    planes += [*(web.position for web in machine.webs), machine.plane]
    span = largest(*planes) + largest(*(-plane for plane in planes))
    low, high = real(_ROUNDING / _WIDE), real(_ROUNDING * _WIDE)
    ranges = {name: size * arm for name, arm in (("force", ONE), ("moment", span))}
    return {name: Number((noise * low).low, (noise * high).high) for name, noise in ranges.items()}
