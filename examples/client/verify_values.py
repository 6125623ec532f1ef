"""What one machine comes to with counterweights over a revolution: enclosed for every angle."""

from __future__ import annotations

from math import hypot
from typing import Iterator, List, NamedTuple, Sequence

from verify_answer import Fitted
from verify_bearings import SAMPLE, peak_of
from verify_cases import Scatter
from verify_cuts import Part
from verify_harmonics import Curve
from verify_machine import ON_FRAME
from verify_numbers import ZERO, Number, largest
from verify_program import phasors


class Range(NamedTuple):
    """A figure is between these."""

    low: float
    high: float


NOTHING = Range(0.0, 0.0)


def most(ranges: Sequence[Range]) -> Range:
    """The largest of several figures."""
    return Range(max(figure.low for figure in ranges), max(figure.high for figure in ranges)) if ranges else NOTHING


def together(ranges: Sequence[Range]) -> Range:
    """The sum of several figures."""
    return Range(sum(figure.low for figure in ranges), sum(figure.high for figure in ranges))


def _range(number: Number) -> Range:
    return Range(float(Number(number.low, number.low)), float(number))


def off_sizes(part: Part, fitted: Fitted) -> List[Number]:
    """What is off by a share of itself [kg m], web by web, those of balance shafts last: what is fixed is as it is."""
    webs = zip(fitted.turning, part.machine.webs)
    own = [ZERO if web.fixed else mass.product for mass, web in webs]
    on_shafts = [mass.product for _, mass in fitted.on_shafts] or [ZERO for _ in part.geared]
    return [*own, *on_shafts]


class Value:
    """What one machine comes to with counterweights that may be off."""

    def __init__(self, part: Part, fitted: Fitted, off: Scatter) -> None:
        self.part, self.fitted, self.off = part, part.placed(fitted), off

    def goal(self, name: str) -> Range:
        """Of all that is weighed together, or of one of the goals in their order."""
        kinds = [name] if name != "all" else ["external", "bearings", "bending"]
        groups = [group for kind in kinds for group in getattr(self, f"_{kind}")()]
        return together(groups) if self.part.apart else most(groups)

    def response(self, name: str, enough: float = 0.0, axis: str = "") -> Range:
        """The peak of a response over the revolution, or of a component; of no interest up to ``enough``."""
        curve = self.part.loads.with_weights(name, self.fitted.turning, self.fitted.on_shafts)
        curve = curve.along(axis) if axis and isinstance(curve, Curve) else curve
        off = self._off(name)
        peak = peak_of(curve, self.part.goal, max(enough - off, 0.0))
        rounding = SAMPLE * self.part.loads.size_of(name)
        return Range(peak.low + off - rounding, peak.high + off + rounding)

    def under(self, response: str) -> Range:
        """What a ceiling on a response limits, or on its component along an axis."""
        name, _, axis = response.partition(":")
        if name not in ON_FRAME:
            return self.response(response)
        if not self.part.all:
            every = (phasors(corner.responses(self.fitted.first), response) for corner in self.part.machines)
            most_of = largest(ZERO, *(abs(co) + abs(counter) for co, counter in every))
            return _range(most_of + self.part.grown(name, self.off, off_sizes(self.part, self.fitted)))
        return self.response(name, axis=axis)

    def of_first_order(self, name: str) -> Range:
        """A peak of the first order."""
        return _range(self.part.peak(self.fitted.first, name, self.off, off_sizes(self.part, self.fitted)))

    def bearings(self) -> Range:
        """The largest load."""
        ranges: List[Range] = []
        for name in self.part.turn.bearings:
            ranges.append(self.response(f"bearing:{name}", most(ranges).low))
        return most(ranges)

    def _off(self, name: str) -> float:
        if self.off.share.high == self.off.besides.high == 0:
            return 0.0
        share, besides = float(self.off.share), float(self.off.besides)
        loads = self.part.loads
        factors = [loads.factor(name, web.position) for web in self.part.machine.webs]
        for gear in self.part.geared:
            arm = loads.factor(name, gear.web.position) if name in ON_FRAME else 0.0
            factors.append(gear.ratio**2 * (abs(gear.place.middle()) if name == "roll" else arm))
        sizes = off_sizes(self.part, self.fitted)
        return sum(
            abs(factor) * loads.square * (share * abs(size.middle().real) + besides)
            for factor, size in zip(factors, sizes)
        )

    def _external(self) -> Iterator[Range]:
        weights = self.part.weights
        if float(weights["roll"]) > 0:
            yield self._weighed("roll", float(weights["roll"]))
        if self.part.all:
            for name in ON_FRAME:
                if name in weights:
                    yield self._weighed(name, float(weights[name]))
            return
        sizes = off_sizes(self.part, self.fitted)
        value = self.part.value(self.fitted.first, self.off, sizes)
        yield _range(value)

    def _bearings(self) -> Iterator[Range]:
        weight = float(self.part.weights["bearing"])
        ranges: List[Range] = []
        for name in self.part.turn.bearings if weight > 0 else ():
            area = self.part.area[name].middle().real if self.part.specific else 1.0
            if self.part.mean:
                ranges.append(self._mean(f"bearing:{name}", weight / area))
            else:
                ranges.append(self._weighed(f"bearing:{name}", weight / area, most(ranges).low))
        yield most(ranges)

    def _bending(self) -> Iterator[Range]:
        weight = float(self.part.weights["bending"])
        ranges: List[Range] = []
        for plane in self.part.loads.planes if weight > 0 else ():
            ranges.append(self._weighed(f"bending:{plane!r}", weight, most(ranges).low))
        yield most(ranges)

    def _weighed(self, name: str, weight: float, enough: float = 0.0) -> Range:
        low, high = self.response(name, enough / weight)
        return Range(low * weight, high * weight)

    def _mean(self, name: str, weight: float) -> Range:
        """Of a root mean square: what stands still grows by what is off."""
        curve = self.part.loads.with_weights(name, self.fitted.turning)
        still = curve.mean
        value = hypot(curve.plus(-still).rms, abs(still) + self._off(name)) * weight
        rounding = 10 * SAMPLE * curve.size * weight
        return Range(value - rounding, value + rounding)
