"""The benchmark's cases run once on every change; times are for `make bench`."""

from collections.abc import Callable
from typing import Any

import pytest

from optimizer.optimize import optimize
from schemas.request.requests import OptimizeRequest
from tests.benchmarks import discrete, outputs, plates, sweep_outputs, sweep_over_turn, sweep_time, whole_turn
from tests.benchmarks.cases import CASES
from tests.benchmarks.phases import PHASES, measure
from tests.benchmarks.stopwatch import Stopwatch
from tests.night import part
from tests.studies.matching.cases import mirrored


@pytest.mark.parametrize("build", CASES.values(), ids=CASES)
def test_every_case_is_certified(build: Callable[[], bytes]) -> None:
    answer = optimize(OptimizeRequest.model_validate_json(build()))
    assert answer.status == "optimal"


def test_phases_add_up() -> None:
    times = measure(next(iter(CASES.values()))())
    assert set(times) == set(PHASES)
    parts = sum(duration for name, duration in times.items() if name != "total")
    assert 0 < parts <= times["total"]


@pytest.mark.parametrize("machine", [outputs.two_rows(), outputs.sixteen_rows()], ids=["2 rows", "16 rows"])
def test_every_output_of_the_benchmark_runs(machine: dict[str, Any]) -> None:
    assert set(outputs.times_by_output(machine, 1)) == set(outputs.SCENES)
    assert set(outputs.residual_with_and_without_gas(machine, 1)) == {"with gas data", "without"}


@pytest.mark.parametrize("build", whole_turn.MACHINES.values(), ids=whole_turn.MACHINES)
def test_every_bearing_optimum_of_the_benchmark_is_certified(build: Callable[[], dict[str, Any]]) -> None:
    assert whole_turn.times(build(), False, 1).gap <= 1e-6


def test_every_part_of_an_answer_over_the_turn_is_watched() -> None:
    parts = whole_turn.where_the_time_goes(whole_turn.MACHINES["in-line six, gas"](), 1)
    assert all(time > 0 for time in parts.values()), parts


@pytest.mark.parametrize("parts", [sweep_outputs.PARTS, sweep_over_turn.PARTS, sweep_time.PARTS])
def test_what_is_watched_is_there(parts: dict[str, tuple[str, ...]]) -> None:
    with Stopwatch().over(parts):
        pass


def test_scroll_pin_cases_run() -> None:
    assert min(outputs.scroll_pins(1).values()) > 0


def test_broadcasting_case_runs() -> None:
    assert min(outputs.broadcasting(3)) > 0


def test_choices_are_those_of_scip_independent() -> None:
    comparison = discrete.beside(discrete.choice(6, None, masses=3), 1, 1e9)
    assert comparison.ours_gap <= 1e-4
    assert abs(comparison.apart) <= 2e-4


@pytest.mark.parametrize("cranks", part(2, [discrete.in_some_order(6), mirrored(6)]))
def test_matches_are_those_of_scip_independent(cranks: list[float]) -> None:
    comparison = discrete.matched_beside(discrete.rows_matched(cranks), 1, 1e9)
    assert max(comparison.ours_gap, comparison.theirs_gap) <= 1e-4
    assert abs(comparison.apart) <= 2e-4


def test_what_else_is_chosen_runs() -> None:
    assert min(discrete.rival_seconds(1).values()) > 0


@pytest.mark.parametrize("body", plates.KINDS.values(), ids=plates.KINDS)
def test_what_is_cut_is_what_the_same_radii_call_for(body: dict[str, Any]) -> None:
    request, plain = plates.plate_and_radius(body)
    plate, radius = optimize(request), optimize(plain)
    assert plate.status == radius.status == "optimal"
    # property: at these radii others may weigh less, but no objective is smaller
    assert plate.certificate is not None
    assert radius.certificate is not None
    # but for a total mass, which at one radius buys less or more
    apart = 1e-6 if request.machine.max_total_mass_kg is None else 0.05
    assert plate.certificate.lower_bound == pytest.approx(radius.certificate.lower_bound, rel=apart)
    assert plate.total_mass_kg is not None
    assert radius.total_mass_kg is not None
    assert radius.total_mass_kg <= plate.total_mass_kg * (1 + 1e-4)
