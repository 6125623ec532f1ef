"""Largest loads of pins and of the drive's bearing over a turn: in closed form, or by a search that a bound ends."""

from collections.abc import Callable

import numpy as np

from optimizer.numerics.arrays import Real
from optimizer.pins.brackets import Peaks, enclosed_peaks
from optimizer.pins.loads import PeriodicTable, peaks
from optimizer.pins.pattern import Pattern

#: grid of the search with clearances or dead points, which does not depend on the samples
GRID_DEG = 0.5
_REFINEMENTS, _PARTS = 8, 16


def is_stuck(pattern: Pattern, torque: PeriodicTable, angle_deg: Real) -> np.ndarray:
    """Whether a torque acts at shaft angles (...) where nothing holds it: the loads there have no meaning."""
    return pattern.at_dead_point(angle_deg) & (torque.at(angle_deg) != 0.0)


def turn_peaks(pattern: Pattern, torque: PeriodicTable) -> Peaks:
    """Largest magnitudes over the turn; beside dead points loads jump, and nothing bounds them."""
    if not pattern.has_clearance and (pattern.formula or not pattern.dead_deg.size):
        size, angle_deg = peaks(pattern.shapes(), torque)
        return Peaks(size, angle_deg, size)

    def magnitude(angle_deg: Real) -> Real:
        load = np.abs(pattern.loads(torque.at(angle_deg), angle_deg))
        return np.where(is_stuck(pattern, torque, angle_deg)[..., None], 0.0, load)

    edges = np.unique(np.append(np.arange(0.0, 360.0 + GRID_DEG, GRID_DEG), torque.angle_deg))
    # what errors strain at a dead point stands there alone: beside it the scroll turns until they do not
    size, angle_deg = _refined_peaks(magnitude, np.append(edges[:-1], pattern.dead_deg))
    if pattern.dead_deg.size:
        return Peaks(size, angle_deg, None)
    return enclosed_peaks(pattern, torque, edges, size, angle_deg)


def _refined_peaks(size: Callable[[Real], Real], grid_deg: Real) -> tuple[Real, Real]:
    """Largest values of every pin, from the best of a grid by ever finer ones around it."""
    on_grid = size(grid_deg)
    best = grid_deg[np.argmax(on_grid, axis=0)]
    half, pin = GRID_DEG, np.arange(best.size)
    # the best so far is the first of equal ones: it stays on a dead point or an entry of the table
    parts = np.append(0.0, np.delete(np.linspace(-1.0, 1.0, _PARTS + 1), _PARTS // 2))
    for _ in range(_REFINEMENTS):
        near = best[:, None] + half * parts
        values = size(near)[pin[:, None], np.arange(parts.size), pin[:, None]]
        best = near[pin, np.argmax(values, axis=-1)]
        half *= 2.0 / _PARTS
    peak = np.max(values, axis=-1)
    return peak, np.where(peak > 0.0, np.mod(best, 360.0), 0.0)
