"""Loads of the main bearings as the shaft sees them, with their smallest circles, before and after."""

import cmath
import math
from collections.abc import Iterator, Sequence

from schemas.answer.dynamics import BearingLoad, MainBearing, MainBearings
from schemas.machine.machine import Machine
from service.drawings.svg import AFTER, BEFORE, Drawing
from service.report.blocks import Figure
from service.report.loci import Curve, locus

#: bearings that are drawn; of more those with the largest loads
_MOST = 4


def bearing_loci(machine: Machine, found: MainBearings) -> Iterator[Figure]:
    """Pictures, two to a row."""
    drawn = loci(machine, found)
    words = (
        "Loads of the main bearings as the shaft sees them, each with the smallest circle around it. Counterweights "
        "move curve and circle together and change neither, so that no peak, the distance of the farthest point from "
        "the dot at the origin, is ever below the radius."
    )
    if len(found.bearings) > _MOST:
        words += f" Drawn are the {_MOST} of {len(found.bearings)} with the largest loads."
    for first in range(0, len(drawn), 2):
        yield Figure(tuple(drawn[first : first + 2]), words if first == 0 else "")


def loci(machine: Machine, found: MainBearings) -> list[Drawing]:
    """A picture of each bearing, of those with the largest loads where they are many."""
    worst = sorted(found.bearings, key=lambda one: -max(load.peak_N for load in _loads(one)))[:_MOST]
    sense = 1.0 if machine.rotation == "ccw" else -1.0
    return [_drawn(one, found.angle_deg, sense) for one in found.bearings if one in worst]


def _drawn(one: MainBearing, angle_deg: Sequence[float], sense: float) -> Drawing:
    strokes = (("without counterweights", BEFORE, "7 3"), ("with counterweights", AFTER, None))
    curves = []
    for load, (name, stroke, dash) in zip(_loads(one), strokes, strict=False):
        centre = complex(load.circle_x_N, load.circle_y_N)
        curves.append(Curve(name, _turned(load, angle_deg, sense), centre, load.floor_N, stroke, dash))
    return locus(f"load of bearing {one.name}", "N", curves)


def _loads(one: MainBearing) -> list[BearingLoad]:
    """Without counterweights, and with them where there are any."""
    return [load for load in (one.before, one.after) if load is not None]


def _turned(load: BearingLoad, angle_deg: Sequence[float], sense: float) -> list[complex]:
    """The load over the turn in a frame that turns with the shaft, as drawn at shaft angle 0."""
    return [
        complex(x, y) * cmath.exp(-1j * sense * math.radians(angle))
        for x, y, angle in zip(load.force_x_N, load.force_y_N, angle_deg, strict=True)
    ]
