"""Forces and moments of every layout in the seeds."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from optimizer.mechanics.angles import angle_deg
from optimizer.mechanics.inertia import Wrench, reciprocating, rotating
from optimizer.mechanics.layout import Layout
from optimizer.mechanics.slider_crank import acceleration_harmonic_order_2
from optimizer.responses.response import Phasors
from tests.reference.seed_figures import ATOL, RTOL, THETA, as_arrays, as_machine, checks


def figure(layout: Layout, name: str) -> Any:
    """A figure by its name in the file, such as F1_major or C2_minor."""
    square = layout.omega**2
    if name.endswith(("rot", "rot_phase_deg")):
        wrench = rotating(layout).times(square)
        pair = _part(wrench, name)
        return angle_deg(pair.co) if name.endswith("deg") else pair.peak
    order = int(name[1])
    pair = _part(reciprocating(layout, order, acceleration_harmonic_order_2).times(square), name)
    return {
        "major": lambda: pair.peak,
        "minor": lambda: pair.minor,
        "major_dir_deg": lambda: pair.major_axis_deg,
        "forward": lambda: np.abs(pair.co),
        "backward": lambda: np.abs(pair.counter),
        "x": lambda: pair.at(layout.sense * THETA, order).real,
        "y": lambda: pair.at(layout.sense * THETA, order).imag,
    }[name[3:]]()


def _part(wrench: Wrench, name: str) -> Phasors:
    return wrench.moment if name.startswith("C") else wrench.force


@pytest.mark.parametrize("build", [as_arrays, as_machine], ids=["arrays", "machine"])
@pytest.mark.parametrize("check", checks("layout"))
def test_layout(check: Any, build: Callable[[Any], Layout]) -> None:
    layout = build(check["inputs"])
    for name, expected in check["expected"].items():
        atol = RTOL * float(np.max(np.abs(expected))) + ATOL
        np.testing.assert_allclose(figure(layout, name), expected, rtol=0.0, atol=atol, err_msg=name)
