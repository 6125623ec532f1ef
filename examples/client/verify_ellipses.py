"""How a pair of phasors moves, where it points, and whether what turns with the shaft can balance it.

co e^{jt} + counter e^{-jt} runs on an ellipse: a circle where one of the two is none, a line where they are as long.
What lies so near to an edge that doubles may fall on either side may be called either.
"""

from __future__ import annotations

from itertools import product
from typing import NamedTuple, Sequence, Set, Tuple

from verify_claims import Claim, Claims, figure, same
from verify_machine import NOTHING
from verify_numbers import ABOUT_ONE, BLUR, ONE, Number, Place, direction, real

#: the smaller over the larger below which the smaller is none: of what acts, and of what is told of the machine itself
ACTS, EXACT = 1e-6, 1e-9


class Pair(NamedTuple):
    """What turns with the shaft and against it."""

    co: Number
    counter: Number

    @property
    def sizes(self) -> Tuple[Number, Number]:
        return abs(self.co), abs(self.counter)

    @property
    def peak(self) -> Number:
        co, counter = self.sizes
        return co + counter

    @property
    def minor(self) -> Number:
        co, counter = self.sizes
        return abs(co - counter)


class Motion(NamedTuple):
    """What is said of a pair: a force or a moment, its order, and the size up to which it is none."""

    name: str
    unit: str
    order: int
    noise: Number


def either(number: Number, most: Number) -> Tuple[bool, bool]:
    """Whether a number may be no larger than another, and whether it may be larger."""
    return number.low <= most.high, number.high > most.low


def acting(claim: str, place: Place, pair: Pair, motion: Motion, speed: Number) -> Claims:
    """A force or a moment as data. ``speed``: of the shaft [Hz]."""
    yield same(claim, place / "quantity", motion.name)
    yield same(claim, place / "unit", motion.unit)
    yield same(claim, place / "order", motion.order)
    yield figure(claim, place / "frequency_Hz", real(motion.order) * speed * ABOUT_ONE)
    way = (place / "motion").text()
    yield claim, place / "motion", ONE if way in motions(pair, motion.noise) else -ONE, ONE
    if way == "none":
        for field, nothing in (("peak", 0), ("minor", 0), ("direction_deg", None)):
            yield same(claim, place / field, nothing)
        return
    yield figure(claim, place / "peak", pair.peak)
    yield figure(claim, place / "minor", pair.minor)
    yield _pointed(claim, place / "direction_deg", pair, way)


def motions(pair: Pair, noise: Number) -> Set[str]:
    """All that doubles may call it."""
    co, counter = pair.sizes
    nothing, above = either(pair.peak, noise)
    names = {"none"} if nothing else set()
    edges = (("with_shaft", counter, co), ("against_shaft", co, counter), ("fixed", pair.minor, pair.peak))
    for name, small, large in edges if above else ():
        yes, above = either(small, large * real(ACTS))
        names |= {name} if yes else set()
        if not above:
            break
    return names | {"ellipse"} if above else names


def _pointed(claim: str, place: Place, pair: Pair, way: str) -> Claim:
    """What turns points there at shaft angle 0. On an axis both phasors point there: their product is along e^{2ja}."""
    degrees = place.double()
    unit = direction(degrees) + BLUR
    turning = {"with_shaft": pair.co, "against_shaft": pair.counter}.get(way)
    vector = pair.co * pair.counter if turning is None else turning
    off = abs(vector - (unit * unit if turning is None else unit) * abs(vector))
    return claim, place, -off if 0 <= degrees < (180 if turning is None else 360) else -ONE, abs(vector)


def balanceable(pair: Pair, order: int) -> Set[str]:
    """All that may be said of a pair: counterweights can balance what turns with the shaft in the first order."""
    co, counter = pair.sizes
    names = {"fully"} if pair.peak.low <= 0 else set()
    if is_nothing(pair):
        return names
    if order > 1:
        return names | {"no"}
    for name, small, large in (("fully", counter, co), ("no", co, counter)):
        yes, more = either(small, large * real(EXACT))
        names |= {name} if yes else set()
        if not more:
            return names
    return names | {"partly"}


def all_balanceable(pairs: Sequence[Tuple[Pair, int]]) -> Set[str]:
    """The same of several, each with its order; what is none of them counts for nothing."""
    options = [
        [*(() if is_nothing(pair) else balanceable(pair, order)), *([None] if pair.peak.low <= 0 else [])]
        for pair, order in pairs
    ]
    unions = [{verdict for verdict in choice if verdict is not None} for choice in product(*options)]
    return {"partly" if len(union) > 1 else next(iter(union), "fully") for union in unions}


def is_nothing(pair: Pair) -> bool:
    return pair.peak.high <= real(NOTHING).high
