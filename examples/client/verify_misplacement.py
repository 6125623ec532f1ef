"""What goals over a revolution rise by where all counterweights are off together, each whichever way is worst.

A peak is a convex function of what counterweights add to its curve, so it is largest at a corner of all that they may
add. Of masses these are the corners of a zonotope. Of angles an arc lies within the two ends and the two points where
the tangents at its ends and in its middle meet; all arcs together within the Minkowski sum of these four points.
"""

from __future__ import annotations

from cmath import phase, rect
from math import cos, hypot, radians
from typing import Dict, Iterator, List, Sequence

from verify_answer import Fitted
from verify_bearings import SAMPLE, peak_of, within
from verify_cases import Scatter
from verify_claims import Claims
from verify_cuts import Part
from verify_numbers import ZERO, NotCovered, Number, Place
from verify_prices import worst_by_angle, worst_by_mass
from verify_values import Range, Value, most

ANGLE, SHARE = radians(1.0), 0.01
ROUNDING = 1e-15  # share of what a length is a sum of by which it may be off
WIDE = 3e-7  # share of the goal by which the service's brackets are wide
MOST = 500  # peaks that are enclosed for one answer


class Misplaced(Value):
    """What one machine comes to with counterweights that are off by a degree, or by a per cent."""

    def __init__(self, part: Part, fitted: Fitted, by_angle: bool) -> None:
        super().__init__(part, fitted, Scatter(ZERO, ZERO))
        self.by_angle = by_angle
        webs = part.machine.webs
        self.free = [u for u, web in zip(self.fitted.turning, webs) if web.fixed is None and u.product.high > 0]

    def response(self, name: str, enough: float = 0.0, axis: str = "") -> Range:
        loads = self.part.loads
        curve = loads.with_weights(name, self.fitted.turning)
        ranges = [Range(*peak_of(curve, self.part.goal, enough)[:2])]
        vectors = [loads.vector(name, [item]) for item in self.free]
        corners = rotation_outline(vectors) if self.by_angle else [SHARE * item for item in zonotope(vectors)]
        for corner in corners:
            ranges.append(Range(*peak_of(curve.plus(corner), self.part.goal, max(most(ranges).low, enough))[:2]))
        still = curve.plus(-curve.mean).size
        if still <= SAMPLE * loads.size_of(name):
            # what turns with the shaft alone has one length, at worst no more than at a corner
            least = self._at_worst(curve.mean, vectors)
            return Range(least, max(least, most(ranges).high))
        return most(ranges)

    def _at_worst(self, middle: complex, vectors: Sequence[complex]) -> float:
        """The largest length of a vector of which these are parts."""
        worst, step = (worst_by_angle, ANGLE) if self.by_angle else (worst_by_mass, SHARE)
        return worst(middle - sum(vectors), vectors, step)

    def _external(self) -> Iterator[Range]:
        if self.part.all:
            yield from super()._external()
            return
        worst = worst_by_angle if self.by_angle else worst_by_mass
        vectors, noise = self._vectors(), 0.0
        most_of: Dict[str, float] = {}
        for statement in self.part.statements:
            rows: Dict[str, float] = {row: float(floor) for row, floor in statement.floor.items()}
            for term in statement.terms.values():
                shifts = [(vector * factor).middle() for vector, factor in zip(vectors, self.part.of_first_order(term))]
                rows[term.row] += worst(term.start.middle(), shifts, ANGLE if self.by_angle else SHARE)
            there = statement.machine.responses(self.fitted.first)
            for name in {term.moves for term in statement.terms.values()}:
                noise = max(noise, ROUNDING * float(self.part.size(statement, there, name)))
            most_of = {row: max(value, most_of.get(row, 0.0)) for row, value in rows.items()}
        value = self.part.together(most_of.values())
        yield Range(value - noise, value + noise)

    def _vectors(self) -> List[Number]:
        """What is chosen on every web; what is fixed is in the start of every length."""
        webs = zip(self.fitted.turning, self.part.machine.webs)
        own = [ZERO if web.fixed else item.product * item.co for item, web in webs]
        return [*own, *(item.vector(mass) for item, (_, mass) in zip(self.part.geared, self.fitted.on_shafts))]

    def _mean(self, name: str, weight: float) -> Range:
        loads = self.part.loads
        curve = loads.with_weights(name, self.fitted.turning)
        still, vectors = curve.mean, [loads.vector(name, [mass]) for mass in self.free]
        value = hypot(curve.plus(-still).rms, self._at_worst(still, vectors)) * weight
        return Range(value, value)


def zonotope(vectors: Sequence[complex]) -> List[complex]:
    """Corners of all sums of vectors, each times a number from -1 to 1."""
    ahead = sorted((v if (v.imag, v.real) >= (0.0, 0.0) else -v for v in vectors if v), key=phase)
    corner = sum(ahead, 0j)
    corners = [corner, -corner] if ahead else []
    for v in ahead[:-1]:
        corner -= 2 * v
        corners += [corner, -corner]
    return corners


def rotation_outline(vectors: Sequence[complex]) -> List[complex]:
    """Corners of an outline around all sums of v (e^{j psi} - 1), |psi| up to the angle."""
    start, edges = 0j, []
    for v in vectors:
        if v:
            bends = [rect(1, -ANGLE), rect(1 / cos(ANGLE / 2), -ANGLE / 2), rect(1 / cos(ANGLE / 2), ANGLE / 2)]
            points = [v * (bend - 1) for bend in (*bends, rect(1, ANGLE))]
            own = [after - before for before, after in zip(points, [*points[1:], points[0]])]
            first = min(range(4), key=lambda k: phase(own[k]))
            start += points[first]
            edges += own
    corners = []
    for edge in sorted(edges, key=phase):
        start += edge
        corners.append(start)
    return corners


def misplacement(parts: Sequence[Part], goal: str, fitted: Fitted, entry: Place) -> Claims:
    """Both rises of the last goal."""
    if not entry:
        return
    part = parts[0]
    if fitted.on_shafts and part.over_turn:
        raise NotCovered(entry)
    weighed = [float(part.weights[name]) > 0 for name in ("bearing", "bending")]
    count = (
        len(part.turn.bearings) * (weighed[0] and not part.mean) + len(part.loads.planes) * weighed[1] + 2 * part.all
    )
    if count * 6 * len(part.machine.webs) * len(parts) > MOST:
        raise NotCovered(entry)
    nothing_off = Scatter(ZERO, ZERO)
    as_it_is = most([Value(case, fitted, nothing_off).goal(goal) for case in parts])
    for field, by_angle in (("objective_rise_per_deg", True), ("objective_rise_per_percent", False)):
        worst = most([Misplaced(case, fitted, by_angle).goal(goal) for case in parts])
        low, high = max(worst.low - as_it_is.high, 0.0), max(worst.high - as_it_is.low, 0.0)
        yield within("sensitivity", entry / field, low, high, WIDE * (worst.high + as_it_is.high))
