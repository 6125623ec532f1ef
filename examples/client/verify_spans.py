"""What a load across the shaft puts on each bearing, and how it bends the shaft; in fractions, without rounding.

Simple spans: every span carries its own loads by the lever rule, overhangs with the span next to them. A continuous
shaft of even stiffness on rigid bearings has moments M_i over its inner bearings that leave no kink there, with the
lengths l_i of the spans (equation of three moments, Clapeyron 1857):

    l_{i-1} M_{i-1} + 2 (l_{i-1} + l_i) M_i + l_i M_{i+1} = -(kinks of the loads)
"""

from __future__ import annotations

from fractions import Fraction
from typing import Dict, List, Sequence


class Spans:
    """Bearings in rising places [m]."""

    def __init__(self, places: Sequence[Fraction], continuous: bool) -> None:
        self.places, self.continuous = list(places), continuous
        self.lengths = [end - start for start, end in zip(places, places[1:])]
        self.extent = places[-1] - places[0]
        self._shares_by_place: Dict[Fraction, List[Fraction]] = {}

    def shares(self, place: Fraction) -> List[Fraction]:
        """What a unit of load in a plane puts on every bearing."""
        if place not in self._shares_by_place:
            self._shares_by_place[place] = self._shares(place)
        return self._shares_by_place[place]

    def bending(self, plane: Fraction, place: Fraction) -> Fraction:
        """The moment in a plane of the shaft from a unit of load in another."""
        carried = sum(max(seat - plane, Fraction(0)) * share for seat, share in zip(self.places, self.shares(place)))
        return carried - max(place - plane, Fraction(0))

    def _shares(self, place: Fraction) -> List[Fraction]:
        k = sum(place >= seat for seat in self.places[1:-1])
        length = self.lengths[k]
        ahead, behind = place - self.places[k], self.places[k + 1] - place
        shares = [Fraction(0) for _ in self.places]
        shares[k], shares[k + 1] = behind / length, ahead / length
        if self.continuous:
            moments = self._over_bearings(k, ahead, behind)
            for n, length in enumerate(self.lengths):
                tilt = (moments[n + 1] - moments[n]) / length
                shares[n], shares[n + 1] = shares[n] + tilt, shares[n + 1] - tilt
        return shares

    def _over_bearings(self, k: int, ahead: Fraction, behind: Fraction) -> List[Fraction]:
        """Moments over all bearings, 0 over both outer ones: the rows of the equation, solved one by one."""
        kinks = [Fraction(0) for _ in self.places]
        kinks[k], kinks[k + 1] = _kink(behind, self.lengths[k]), _kink(ahead, self.lengths[k])
        count, lengths = len(self.places), self.lengths
        diagonal, right = [Fraction(1)], [Fraction(0)]
        for n in range(1, count - 1):
            # of the row before, what stands beside its diagonal is the length between both
            factor = lengths[n - 1] / diagonal[-1] if n > 1 else Fraction(0)
            diagonal.append(2 * (lengths[n - 1] + lengths[n]) - factor * lengths[n - 1])
            right.append(-kinks[n] - factor * right[-1])
        moments = [Fraction(0) for _ in self.places]
        for n in range(count - 2, 0, -1):
            moments[n] = (right[n] - lengths[n] * moments[n + 1]) / diagonal[n]
        return moments


def _kink(distance: Fraction, length: Fraction) -> Fraction:
    """At one end of a span, of a load at a distance from the other; below 0 it hangs over that end."""
    within = max(distance, Fraction(0))
    return distance * (length - within) * (length + within) / length
