"""Main-bearing loads without and with counterweights, and the bending moment inside the shaft."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.angles import shaft_vectors
from optimizer.mechanics.shaft_curves import ShaftCurves
from optimizer.numerics.arrays import Complex, Real, in_order
from optimizer.outputs.balance_rate import cranks
from optimizer.outputs.output import Columns, Output
from optimizer.outputs.peaks import (
    FLOOR_TOLERANCE,
    Search,
    customary_search,
    of_shaft,
    separate_groups,
    shaft_peaks,
    shaft_search,
)
from optimizer.responses.curve import floors
from optimizer.responses.floors import Floors
from optimizer.responses.peak_table import PeakList
from schemas.answer.dynamics import MainBearings
from schemas.answer.outputs import labels
from schemas.base.curves import Curve
from schemas.machine.drive import Bearing
from schemas.machine.reciprocating import ReciprocatingMachine


def main_bearings(scene: Prepared, unbalance: Complex | None) -> MainBearings:
    """Loads of the main bearings of one machine, and the bending moments of its shaft."""
    machine = scene.machine
    planes = scene.stations.tolist()
    curves = scene.shaft_curves
    count = len(machine.bearings)
    # every bearing's, and the largest of all bending moments
    fixed = floors(curves.curves, FLOOR_TOLERANCE, None, separate_groups(count, len(planes)))
    sets = _sets(unbalance)
    peaks = shaft_peaks(scene, sets)
    loads = _loads(scene, curves.first(count), peaks, fixed, sets)
    before = loads[0]
    after: Sequence[dict[str, Any] | None] = [None] * count if unbalance is None else loads[-1]
    moments = [peak.part(slice(count, None)) for peak in peaks]
    bending = moments[-1]
    worst = bending.lower.index(max(bending.lower))
    return MainBearings.of_figures(
        {
            "angle_deg": scene.angles,
            "shaft": scene.request.fidelity.shaft,
            "bearings": tuple(
                {"name": bearing.name, "position_m": bearing.position_m, "before": bare, "after": load}
                for bearing, bare, load in zip(machine.bearings, before, after, strict=True)
            ),
            "bending": {
                "position_m": planes,
                "before_Nm": moments[0].lower,
                "after_Nm": None if unbalance is None else bending.lower,
                "peak_Nm": bending.lower[worst],
                "peak_bracket_Nm": (bending.lower[worst], max(bending.upper)),
                "peak_position_m": planes[worst],
                "floor_Nm": max(fixed.radius[count:].tolist()) * scene.omega_squared,
            },
        }
    )


def _sets(unbalance: Complex | None) -> list[Complex | None]:
    """Without counterweights, and with them where they change anything."""
    return [None] if unbalance is None or not np.count_nonzero(unbalance) else [None, unbalance]


def _searches(scene: Prepared, unbalance: Complex | None) -> Iterator[Search]:
    yield shaft_search(scene, _sets(unbalance))
    machine = scene.machine
    if unbalance is not None and isinstance(machine, ReciprocatingMachine) and machine.webs:
        # a warning compares with them
        yield customary_search(scene, cranks(machine).customary)


def _samples(scene: Prepared) -> Complex:
    """Loads of the bearings of one machine without counterweights (B, T) N."""
    _, loads = scene.results["shaft_loads"]
    # the webs come last; a product of real numbers takes half the time of one of complex ones
    samples = scene.bearing_influence[:, : len(loads)] @ in_order(loads).view(float)
    return samples.view(complex)


def _loads(
    scene: Prepared,
    curves: ShaftCurves,
    peaks: Sequence[PeakList],
    fixed: Floors,
    sets: Sequence[Complex | None],
) -> list[list[dict[str, Any]]]:
    """Loads of the bearings of one machine, by their curves, peaks and floors, with sets of counterweights (webs,) kg m
    or without."""
    bearings, square = scene.machine.bearings, scene.omega_squared
    count = len(bearings)
    offset = np.array([curves.offsets(unbalance) for unbalance in sets])
    samples = _samples(scene) + (offset * square)[..., None] * shaft_vectors(scene.layout.sense, scene.angle_rad)
    centre, radius = ((fixed.centre[:count] + offset) * square).tolist(), (fixed.radius[:count] * square).tolist()
    rms = (np.sqrt(curves.curves.variance + np.abs(curves.curves.mean + offset) ** 2) * square).tolist()
    # of all sets, one after the other
    xs, ys = (Curve.rows(part) for part in (samples.real, samples.imag))
    return [
        [
            {
                "force_x_N": xs[number * count + k],
                "force_y_N": ys[number * count + k],
                "peak_N": peak.lower[k],
                "peak_bracket_N": peak.bracket(k),
                "peak_angle_deg": peak.angle_deg[k],
                "specific_load_Pa": _over_area(peak.lower[k], bearing),
                "rms_N": rms[number][k],
                "floor_N": radius[k],
                "circle_x_N": centre[number][k].real,
                "circle_y_N": centre[number][k].imag,
            }
            for k, bearing in enumerate(bearings)
        ]
        for number, peak in enumerate(peaks)
    ]


def _over_area(load: float, bearing: Bearing) -> float | None:
    """Specific load, Pa; None where the machine does not say how large the bearing is."""
    if bearing.diameter_m is None or bearing.length_m is None:
        return None
    return load / (bearing.diameter_m * bearing.length_m)


def _columns(scene: Prepared, unbalance: Complex) -> dict[str, Real]:
    machine = scene.machine
    curves = scene.shaft_curves
    # the largest bending moment alone; the bearings one by one
    count = len(machine.bearings)
    peak = of_shaft(scene, curves, unbalance, separate_groups(count, curves.webs.shape[-2] - count)).lower
    names = labels([bearing.name for bearing in machine.bearings])
    return {
        "peak_bearing_load_N": np.max(peak[..., :count], axis=-1),
        "peak_bending_Nm": peak[..., count],
        **{f"bearing_peak_N.{name}": peak[..., k] for k, name in enumerate(names)},
    }


MAIN_BEARINGS = Output(
    "main_bearings",
    "main-bearing loads and bending of the shaft",
    ("shaft_loads", "whole_turn"),
    main_bearings,
    Columns(_columns, needs=("whole_turn",), readings=("on_shaft",)),
    _searches,
)
