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


def bearing_loci(machine: Machine, loads: MainBearings) -> Iterator[Figure]:
    """Pictures, two to a row."""
    pictures = loci(machine, loads)
    words = (
        "Loads of the main bearings as the shaft sees them, each with the smallest circle around it. Counterweights "
        "move curve and circle together and change neither, so that no peak, the distance of the farthest point from "
        "the dot at the origin, is ever below the radius."
    )
    if len(loads.bearings) > _MOST:
        words += f" Drawn are the {_MOST} of {len(loads.bearings)} with the largest loads."
    for first in range(0, len(pictures), 2):
        yield Figure(tuple(pictures[first : first + 2]), words if first == 0 else "")


def loci(machine: Machine, loads: MainBearings) -> list[Drawing]:
    """A picture of each bearing, of those with the largest loads where they are many."""
    worst = sorted(loads.bearings, key=lambda bearing: -max(load.peak_N for load in _loads(bearing)))[:_MOST]
    sense = 1.0 if machine.rotation == "ccw" else -1.0
    return [_picture(bearing, loads.angle_deg, sense) for bearing in loads.bearings if bearing in worst]


def _picture(bearing: MainBearing, angle_deg: Sequence[float], sense: float) -> Drawing:
    strokes = (("without counterweights", BEFORE, "7 3"), ("with counterweights", AFTER, None))
    curves = []
    for load, (name, stroke, dash) in zip(_loads(bearing), strokes, strict=False):
        centre = complex(load.circle_x_N, load.circle_y_N)
        curves.append(Curve(name, _on_shaft(load, angle_deg, sense), centre, load.floor_N, stroke, dash))
    return locus(f"load of bearing {bearing.name}", "N", curves)


def _loads(bearing: MainBearing) -> list[BearingLoad]:
    """Without counterweights, and with them where there are any."""
    return [load for load in (bearing.before, bearing.after) if load is not None]


def _on_shaft(load: BearingLoad, angle_deg: Sequence[float], sense: float) -> list[complex]:
    """The load over the turn in a frame that turns with the shaft, as drawn at shaft angle 0."""
    return [
        complex(x, y) * cmath.exp(-1j * sense * math.radians(angle))
        for x, y, angle in zip(load.force_x_N, load.force_y_N, angle_deg, strict=True)
    ]
