"""The largest load of a pin over a revolution, enclosed for every angle.

Between two angles h apart a load T c sin(t - g) / D with a linear torque T is above its ends by at most h^2/8 times
its largest second derivative. That is bounded by the values of D, D' and D'' there. The intervals that may hold more
are halved until none can exceed the largest value by more than 10^-10 of it.
"""

from __future__ import annotations

from heapq import heapify, heappop, heappush
from math import ceil, degrees, pi, radians, sin, sqrt
from typing import List, Optional

from verify_harmonics import Peak
from verify_pins import Pins, Torque

#: share by which the largest load may exceed the largest value, and intervals after which none is told
CLOSE, MOST = 1e-10, 5_000
#: of an angle: by which doubles are off, which counts where levers are all but equal
ROUNDED = 1e-14
#: degrees of an interval at first
FIRST = 30.0


def peak(pins: Pins, k: int, torque: Torque) -> Optional[Peak]:
    """Of one pin, with the angle where it is [degrees]; None where it is not enclosed."""
    edges = _edges(pins, torque)
    ends = [abs(_load(pins, k, torque, edge)) for edge in edges]
    low, angle = max(zip(ends, edges), key=lambda pair: pair[0])
    pieces = zip(edges, edges[1:], ends, ends[1:])
    heap = [(-_most(pins, k, torque, *piece), *piece) for piece in pieces]
    heapify(heap)
    close = CLOSE + (ROUNDED / sqrt(pins.rest) if pins.rest > 0 else 0.0)
    for _ in range(MOST):
        high, start, end, first, last = heappop(heap)
        if -high <= low * (1 + close):
            return Peak(low, max(low, -high), angle)
        middle = (start + end) / 2
        value = abs(_load(pins, k, torque, middle))
        if value > low:
            low, angle = value, middle
        for piece in ((start, middle, first, value), (middle, end, value, last)):
            heappush(heap, (-_most(pins, k, torque, *piece), *piece))
    return None


def _edges(pins: Pins, torque: Torque) -> List[float]:
    """Angles between which the torque is linear [degrees]."""
    count = ceil(360 / FIRST)
    axes = [degrees(pins.axis) % 90 + 90 * n for n in range(4)]
    return sorted({*(FIRST * n for n in range(count + 1)), *torque.angles, *(axes if pins.flat else [])})


def _load(pins: Pins, k: int, torque: Torque, angle: float) -> float:
    return pins.load(k, torque.at(angle), angle)[0]


def _most(pins: Pins, k: int, torque: Torque, start: float, end: float, first: float, last: float) -> float:
    """No load between two angles is above this."""
    wide, factor = radians(end - start), pins.shapes[k].factor
    values = torque.at(start), torque.at(end - 1e-12 * (end - start))
    slope, size = abs(values[1] - values[0]) / wide, max(map(abs, values))
    left, right = radians(start) - pins.axis, radians(end) - pins.axis
    # the denominator is least at an end or on the axis, and its slope is largest next to a middle
    on_axis = ceil(left / pi) * pi <= right
    below = pins.rest if on_axis else min(pins.below(radians(start)), pins.below(radians(end)))
    if below <= 0:
        return float("inf") if size > 0 else 0.0
    turn = min(abs(sin(left + right)) + wide, 1.0)
    change, bent = 2 * pins.flat * turn, 4 * pins.flat
    steep = 1 / below + change / below**2
    curved = 1 / below + 2 * change / below**2 + bent / below**2 + 2 * change**2 / below**3
    return max(first, last) + wide**2 / 8 * factor * (2 * slope * steep + size * curved)
