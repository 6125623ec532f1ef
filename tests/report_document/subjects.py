"""Answers of the other kinds, and requests, with the chapters that show them: each small, with all that it may hold.

``python -m tests.report_document.subjects`` prints the table of subjects.txt, as tests.report_document.follow does.
"""

import sys
from collections.abc import Callable, Iterable
from functools import cache
from pathlib import Path
from pkgutil import resolve_name
from typing import Any

from schemas.front.counts import CountFront
from schemas.request.accuracy import AccuracyAnswer, AccuracyRequest
from schemas.request.requests import OptimizeRequest
from service.computations.table import COMPUTATIONS
from service.documents.examples import bodies
from service.report.blocks import Chapter
from service.report.chapters.accuracy import ladders
from service.report.chapters.counts import count_table
from service.report.chapters.inputs import inputs
from tests.optimize.machines import machine, row, throw, web
from tests.report_document.follow import NOWHERE, Subject

TABLE = Path(__file__).with_name("subjects.txt")
_ROD = {"length_m": 0.6, "mass_kg": 12.0, "reciprocating_share": 0.31}
_CYLINDER = {
    "bore_m": 0.24,
    "piston_rod_diameter_m": 0.05,
    "suction_pressure_Pa": 1.01e5,
    "discharge_pressure_Pa": 4.2e5,
    "relative_clearance": 0.11,
    "expansion_exponent": 1.21,
    "compression_exponent": 1.34,
}
_PARTS = [
    {"name": "piston", "mass_kg": 17.0, "motion": "reciprocating"},
    {"name": "nut", "mass_kg": 0.7, "motion": "rotating"},
]
_PLATE = {
    "shape": "segment",
    "outer_radius_m": 0.21,
    "inner_radius_m": 0.05,
    "thickness_m": 0.04,
    "density_kg_m3": 7800.0,
    "max_half_angle_deg": 71.0,
}
#: all that a machine may say of itself
_WHOLE = {
    **machine(
        [
            throw(-0.31, 10.0, [row(45.0, 12.0, offset_m=0.02, connecting_rod=_ROD, cylinder=_CYLINDER)], 0.11, 5.0),
            throw(0.42, 130.0, [row(115.0, 11.0, parts=_PARTS)], rotating=3.0),
        ],
        [
            web("a", -0.45, 4.0, 0.12, sector={"centre_deg": 190.0, "half_angle_deg": 40.0}),
            web("b", 0.55, 3.0, 0.15, max_centrifugal_force_N=5e5),
            {"name": "plate", "position_m": 0.05, "envelope": _PLATE},
        ],
        reference_plane_m=0.07,
        max_total_mass_kg=9.0,
    ),
    "overspeed_rpm": 660.0,
    "bearings": [{"name": "A", "position_m": -0.61}, {"name": "B", "position_m": 0.66}],
    "shaft_parts": [{"name": "flywheel", "mass_kg": 210.0, "position_m": 0.81}],
    "unbalances": [{"name": "pulley", "position_m": -0.72, "x_kg_m": 0.013, "y_kg_m": -0.017}],
    "friction": {"mechanical_efficiency": 0.91, "reciprocating_share": 0.62},
    "flywheel": {"irregularity": 0.012},
}
_SHAFTS = [{"name": "back", "speed_ratio": -1, "x_m": 0.19, "y_m": 0.23, "webs": [web("s", 0.11, 8.0, 0.09)]}]
_OBJECTIVE = {
    "force_weight": 1.1,
    "moment_weight": 2.3,
    "force_ceiling_N": 51000.0,
    "moment_ceiling_Nm": 23000.0,
    "force_ceiling_x_N": 52000.0,
    "moment_ceiling_y_Nm": 24000.0,
    "direction_weights": {"x": 0.9, "y": 1.2},
}
_SMALL = machine(
    [throw(-0.31, 10.0, [row(45.0, 12.0, connecting_rod=_ROD)], rotating=5.0), throw(0.42, 130.0, [row(115.0, 11.0)])],
    [web("a", -0.45, 4.0), web("b", 0.1, 3.0), web("c", 0.55, 3.0, 0.15)],
)
_WEIGHTS = [
    {"web": "a", "mass_kg": 3.1, "angle_deg": 201.0},
    {"web": "c", "mass_kg": 2.3, "angle_deg": 317.0},
]
_LADDER = {
    "method": "sampled_angles",
    "setting": "36 angles",
    "time_ms": 1.9,
    "first_ms": 2.9,
    "relative_error": 1.3e-3,
    "as_drawn_error": 2.3e-3,
    "certified_gap": 3.3e-3,
    "claim_error": 4.3e-3,
    "excess": 0.0,
    "programs": 1,
    "runs": 5,
    "on_frontier": True,
    "skipped": None,
}
_CHOICE = {
    "method": "rounding",
    "setting": "0.3 s",
    "status": "optimal",
    "time_ms": 1.7,
    "objective": 107.0,
    "lower_bound": 99.0,
    "relative_error": 1.7e-3,
    "certified_gap": 2.7e-3,
    "total_mass_kg": 31.0,
    "pieces": 3,
    "sizes": 2,
    "limits_kept": True,
    "on_frontier": False,
    "runs": 5,
}
_EFFECT = {"quantity": "peak_torque", "setting": "5 deg", "time_ms": 1.3, "first_ms": 2.1, "runs": 5}
_MEASURED = {
    "version": "1",
    "status": "measured",
    "reference": {
        "objective": 103.0,
        "lower_bound": 102.0,
        "objective_without_counterweights": 401.0,
        "objective_of_any_mass": 97.0,
        "resolution": 1e-12,
    },
    "size": {"webs": 3, "norm_terms": 2, "ceilings": 0, "sectors": 1, "mass_budget": False, "rows": 2},
    "repeats": 5,
    "positions": 4,
    "ladder": [_LADDER],
    "choices_ladder": [],
    "effects_ladder": [],
    "peaks_ladder": [
        {**_EFFECT, "method": "samples", "angles": 360, "relative_error": 5.7e-4, "certified_gap": 6.7e-4}
    ],
    "environment": {"versions": {}, "cpus": 2},
    "total_ms": 907.0,
}
_COUNTS = {
    "max_total_mass_kg": None,
    "of": "weights",
    "least": "objective",
    "status": "optimal",
    "points": [
        {
            "at_most": 2,
            "status": "optimal",
            "status_reason": "",
            "value": 7504.6,
            "lower_bound": 7301.2,
            "relative_gap": 2.3e-4,
            "weights": 2,
            "part_numbers": 1,
            "total_mass_kg": 51.0,
            "force_peak_N": 7705.7,
            "moment_peak_Nm": 20123.3,
            "counterweights": [],
            "nodes": 0,
            "method": "exhaustion",
        }
    ],
}


def _answered(name: str, body: Any) -> Subject:
    """The answer to a request, with the chapters that a terminal shows."""
    computation = COMPUTATIONS[name]
    assert computation.chapters is not None
    request, chapters = computation.request_model.model_validate(body), resolve_name(computation.chapters)
    return Subject(computation.function(request), lambda answer: chapters(request, answer), ("effects.", "timing."))


def _match() -> Subject:
    cranks = [throw(0.1 * k, 90.0 * k, [row(0.0, 10.0)], rotating=1.0) for k in range(4)]
    parts = [{"kind": "piston", "names": [f"p{k}" for k in range(4)], "masses_kg": [2.0, 2.11, 2.44, 2.99]}]
    return _answered("match", {"machine": machine(cranks, [web("a", 0.15, 4.0)]), "parts": parts})


def _optimum_subject(body: Any) -> Subject:
    # what weighs loads or the roll moment calls for more of a machine
    silent = ("accuracy.", "angles.", *(f"objective.{name}_weight" for name in ("bearing", "bending", "roll")))
    return Subject(OptimizeRequest.model_validate(body), lambda request: [inputs(request, 0.07)], silent)


def _accuracy(**changes: Any) -> Subject:
    answer = AccuracyAnswer.model_validate({**_MEASURED, **changes})
    request = AccuracyRequest.model_validate({"machine": _SMALL})
    return Subject(answer, lambda answer: ladders(request, answer))


def accuracy(*rungs: dict[str, Any]) -> AccuracyAnswer:
    """A ladder of such rungs."""
    return AccuracyAnswer.model_validate({**_MEASURED, "ladder": [{**_LADDER, **rung} for rung in rungs]})


def _counts() -> Subject:
    return Subject(CountFront.model_validate(_COUNTS), lambda front: [Chapter("Numbers", (count_table(front),))])


_MADE: dict[str, Callable[[], Subject]] = {
    "match": _match,
    "inputs": lambda: _optimum_subject({"machine": _WHOLE, "objective": _OBJECTIVE}),
    "inputs of balance shafts": lambda: _optimum_subject({"machine": {**_SMALL, "balance_shafts": _SHAFTS}}),
    "inputs of a scroll": lambda: _optimum_subject(bodies("")["scroll-oldham"]),
    "analyze": lambda: _answered("analyze", {"machine": _SMALL, "counterweights": _WEIGHTS}),
    "pareto": lambda: _answered("pareto", {"machine": _SMALL, "points": 3}),
    "round": lambda: _answered("round", {"request": {"machine": _SMALL}, "mass_step_kg": 0.5, "angle_step_deg": 15}),
    "plates, infeasible": lambda: _answered(
        "optimize", {"machine": _WHOLE, "objective": {"force_ceiling_N": 10.0, "moment_ceiling_Nm": 5.0}}
    ),
    "plates": lambda: _answered("optimize", {"machine": _WHOLE}),
    "scenarios": lambda: _answered(
        "optimize",
        {
            "machine": _SMALL,
            "scenarios": [
                {"name": "slow", "changes": [{"path": "/machine/speed_rpm", "value": 500.0}]},
                {"name": "light", "changes": [{"path": "/machine/throws/1/rotating_mass_kg", "value": 2.0}]},
            ],
        },
    ),
    "accuracy": _accuracy,
    "accuracy of choices": lambda: _accuracy(choices_ladder=[_CHOICE]),
    "counts": _counts,
    "shaft": lambda: _answered("shaft", bodies("shaft")["two-throws"]),
    "pins": lambda: _answered("pin_loads", {**bodies("pin-loads")["three-pins"]}),
}
NAMES = tuple(_MADE)


@cache
def subject_of(name: str) -> Subject:
    """One of them."""
    return _MADE[name]()


def written(names: Iterable[str] = NAMES) -> Iterable[str]:
    """The table: of every subject those of its leaves that have places, with these."""
    for name in names:
        yield from (f"{name}: {line}" for line in subject_of(name).written() if not line.endswith(f" {NOWHERE}\n"))


if __name__ == "__main__":
    sys.stdout.writelines(written(sys.argv[1:] or NAMES))
