"""The sweep's benchmark runs once on every change, on a few designs; times are for `make bench`."""

import psutil
import pytest

from schemas.sweep.request import SweepRequest
from tests.benchmarks import sweep_generated, sweep_limits, sweep_memory, sweep_outputs, sweep_scaling, sweep_time
from tests.benchmarks.operations import Counted, operations_per_program
from tests.benchmarks.sweep import OURS, at_limits, compare
from tests.benchmarks.sweep_case import programs, sweep
from tests.benchmarks.sweep_rivals import Batch, Direct, Parametrised, gaps, rebuilt


@pytest.fixture(scope="module")
def request_() -> SweepRequest:
    return sweep(40)


# the C is generated at night: of every method that has no limits the mass is compared below
@pytest.mark.parametrize("generated", [False, pytest.param(True, marks=pytest.mark.nightly)])
def test_every_method_certifies_both_stages(
    request_: SweepRequest, generated: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    if not generated:
        monkeypatch.setattr(sweep_generated, "available", lambda: False)
    rates, rows = compare(request_, (2, 3, 5, 6), turns=1)
    assert len(rates) == (7 if sweep_generated.available() else 6)
    for rate in rates.values():
        # the asked gap; of the mass what calls an answer inaccurate (optimizer.optimize.MASS_GAP)
        assert rate.worst.objective <= 1e-6
        assert rate.worst.mass <= 1e-4
        assert rate.per_second > 0
    assert rates[OURS].times(rates[OURS]) == 1.0
    assert set(rows["status"].to_pylist()) == {"optimal"}
    assert at_limits(request_, rows) > 0.8


@pytest.mark.nightly
def test_the_methods_find_the_same_mass(request_: SweepRequest) -> None:
    # independent: three formulations, two modelling layers, three solvers
    chosen = programs(request_, (0, 17, 39))
    batches = [Batch(chosen).solve()]
    if sweep_generated.available():
        batches.append(sweep_generated.Generated(chosen).solve())
    for program, *of_batches in zip(chosen, *batches, strict=True):
        alone = [
            solver.solve(program, solver.prepare(program)) for solver in (Direct(program), Direct(program, tuned=True))
        ]
        values = [rebuilt(program), Parametrised(program)(program), *alone, *of_batches]
        masses = [float(program.statement.mass(program.unbalance(stages.lightest))) for stages in values]
        assert masses == pytest.approx([masses[0]] * len(masses), rel=1e-5)
        assert max(gaps(program, stages).objective for stages in values) <= 1e-6


@pytest.mark.parametrize(
    ("case", "generated"),
    [
        *((case, False) for case in sweep_limits.CASES),
        # the C takes 3 s to compile
        *(pytest.param(case, True, marks=pytest.mark.nightly) for case in sweep_limits.CASES),
    ],
)
def test_every_method_certifies_programs_with_limits(
    case: str, generated: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    # independent: what other solvers find is held against our bounds, with multipliers of sectors, budget and ceiling
    if not generated:
        monkeypatch.setattr(sweep_generated, "available", lambda: False)
    rates, _ = sweep_limits.compare(sweep_limits.limited(40, case), (4, 6), turns=1)
    assert len(rates) == (4 if sweep_generated.available() else 3)
    for rate in rates.values():
        assert rate.worst.objective <= 1e-6
        assert rate.worst.mass <= 1e-3
        assert rate.per_second > 0


def test_the_parts_of_the_time(request_: SweepRequest) -> None:
    seconds = sweep_time.where_the_time_goes(request_)
    assert set(seconds) - {"reference solver"} == {*sweep_time.PARTS, "everything else"} - {"reference solver"}
    assert min(seconds.values()) > 0
    assert 0 < sweep_time.first_stage_share(request_) < 1


def test_counted_operations(request_: SweepRequest) -> None:
    number = Counted(3.0)
    Counted.done = 0
    # analytic: four operations
    assert float((2.0 * number - number / 2.0) + number) == 7.5
    assert Counted.done == 4
    operations, iterations = operations_per_program(sweep_time.solved(request_, 1))
    # some thousand operations for eight webs in each of some dozen iterations
    assert 5 < iterations < 80
    assert 1e3 < operations / iterations < 1e5


@pytest.mark.nightly
def test_scaling_and_memory_run() -> None:
    # other tests in this process may have workers of theirs
    workers = sweep_memory.workers()
    assert sweep_scaling.through_the_service("processes", sweep(50), 1) > 0
    _, alive = psutil.wait_procs([worker for worker in sweep_memory.workers() if worker not in workers], timeout=180)
    assert alive == []


def test_every_output_of_a_sweep_is_watched() -> None:
    seconds = sweep_outputs.seconds(sweep_outputs.sweep(*sweep_outputs.AXES["a mass"], 3))
    assert all(seconds[part] > 0 for part in sweep_outputs.PARTS), seconds
