"""The smallest circle around a bearing load as the shaft sees it: counterweights move it, and nothing else."""

import cmath
import math
from typing import Any

import pytest

from schemas.answer.dynamics import BearingLoad
from tests.analyze.driven import ask, random_driven


def _phasors(load: BearingLoad, angles: tuple[float, ...], sense: int) -> list[complex]:
    pairs = zip(load.force_x_N, load.force_y_N, angles, strict=True)
    return [complex(x, y) * cmath.exp(-1j * sense * math.radians(angle)) for x, y, angle in pairs]


@pytest.mark.parametrize("rotation", ["ccw", "cw"])
def test_the_circle_holds_the_load_wherever_counterweights_move_it(rotation: str) -> None:
    body: dict[str, Any] = {**random_driven(3, "v", throws=2), "rotation": rotation}
    fitted = [{"web": "a", "mass_kg": 12.0, "angle_deg": 70.0}]
    main_bearings = ask(body, "main_bearings", step_deg=1.0, counterweights=fitted).main_bearings
    for bearing in main_bearings.bearings:
        moved = set()
        for load in (bearing.before, bearing.after):
            centre = complex(load.circle_x_N, load.circle_y_N)
            points = _phasors(load, main_bearings.angle_deg, 1 if rotation == "ccw" else -1)
            distances = [abs(point - centre) for point in points]
            # property: nothing is outside, and samples a degree apart come close to the rim
            assert max(distances) <= load.floor_N * (1.0 + 1e-6)
            assert max(distances) >= load.floor_N * 0.99
            # analytic: the peak lies between the farthest points that the circle allows
            assert load.floor_N <= load.peak_N * (1.0 + 1e-6) <= (abs(centre) + load.floor_N) * (1.0 + 1e-5)
            moved.add(complex(round((points[0] - centre).real, 3), round((points[0] - centre).imag, 3)))
        # analytic: seen from the circle the load is the same
        first, *rest = sorted(moved, key=abs)
        assert all(abs(phasor - first) <= 1e-6 * bearing.before.peak_N + 2e-3 for phasor in rest)
