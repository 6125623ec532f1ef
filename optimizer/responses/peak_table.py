"""Peaks over the revolution of one machine by the searches that bracketed them: as arrays, and in plain numbers."""

from collections.abc import Hashable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import any_true
from optimizer.responses.piecewise_cubics import Bracket

#: what says which peaks they are
Name = tuple[Hashable, ...]


class PeakList(NamedTuple):
    """Peaks in plain numbers, as an answer holds them.

    lower, upper : of their brackets.
    angle_deg : shaft angles at which the lower ends are attained.
    """

    lower: list[float]
    upper: list[float]
    angle_deg: list[float]

    def bracket(self, number: int = 0) -> tuple[float, float]:
        """One of the brackets."""
        return self.lower[number], self.upper[number]

    def part(self, rows: slice) -> "PeakList":
        """Some of the peaks."""
        return PeakList(self.lower[rows], self.upper[rows], self.angle_deg[rows])

    def at_places(self, places: Sequence[int], earlier_deg: Sequence[float]) -> "PeakList":
        """These peaks at several places, as many degrees earlier, of a curve that repeats after 360."""
        lower, upper, angle = ([values[place] for place in places] for values in self)
        return PeakList(lower, upper, [(at - ahead) % 360.0 for at, ahead in zip(angle, earlier_deg, strict=True)])

    def split(self, count: int) -> "list[PeakList]":
        """So many parts of equal size, one after the other."""
        size = len(self.lower) // count
        return [self.part(slice(number * size, (number + 1) * size)) for number in range(count)]


class PeakTable:
    """Peaks of several searches, all of one call in one table: what an output shows is some of its rows."""

    def __init__(self) -> None:
        self._brackets: list[Bracket] = []
        self._lists: list[PeakList] = []
        self._places: dict[Name, tuple[int, slice]] = {}

    def __contains__(self, name: Name) -> bool:
        return name in self._places

    def add(self, rows: Mapping[Name, slice], brackets: Bracket) -> None:
        """Brackets (n,), with the rows of each search."""
        number = len(self._brackets)
        self._brackets.append(brackets)
        angle, _, lower, upper = brackets
        self._lists.append(PeakList(lower.tolist(), upper.tolist(), np.rad2deg(angle).tolist()))
        self._places.update((name, (number, place)) for name, place in rows.items())

    def clear(self) -> None:
        """Of other counterweights there may be others."""
        self._brackets, self._lists, self._places = [], [], {}

    def brackets(self, name: Name) -> Bracket:
        """Those of a search, (m,)."""
        number, rows = self._places[name]
        return Bracket._make(part[rows] for part in self._brackets[number])

    def plain(self, name: Name) -> PeakList:
        """The same in plain numbers."""
        number, rows = self._places[name]
        return self._lists[number].part(rows)

    def is_closed(self, share: float) -> bool:
        """Whether no bracket is wider than a share of its larger end."""
        return not any(
            any_true(upper - lower > share * np.maximum(np.abs(lower), np.abs(upper)))
            for _, _, lower, upper in self._brackets
        )
