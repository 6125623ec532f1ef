"""The ladder of machines with balance shafts: every method chooses what they carry, and no bound is too high."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from optimizer.optimize import optimize
from optimizer.program.rows import combined, statement, weighted_peak
from optimizer.responses.response import Phasors, Response
from optimizer.studies.accuracy.measure import accuracy
from optimizer.studies.accuracy.methods import LadderProgram, methods
from optimizer.studies.accuracy.rivals.sampled import OverTheTurn, WeightedResponse, sampled
from schemas.request.accuracy import AccuracyAnswer
from tests.night import part
from tests.optimize.shafts import WHOLE, shaft, single
from tests.program.cases import random_limits, random_point
from tests.studies.accuracy.test_choices import ALIKE, twin
from tests.studies.accuracy.test_programs import good, reference, rest, solved

SHAFTS = [shaft("p", 1, 0.1, 1.0), shaft("q", -1, 0.3, 3.0), shaft("r", -1, -0.2, 4.0), shaft("s", 2, 0.0, 1.0)]
TOO_SMALL = single([shaft("back", -1, max_mass=2.0)])


def mixed(seed: int, combine: str, weights: tuple[float, float], sectors: bool, ceilings: bool) -> LadderProgram:
    """Two responses to webs of which some turn backwards; ceilings along x and y are met by some point."""
    rng = np.random.default_rng(seed)
    webs = int(rng.integers(2, 7))
    limits, back = random_limits(rng, webs, sectors, False), rng.random(webs) < 0.5
    responses = [
        Response(
            name,
            unit,
            Phasors(*(np.asarray(rng.normal() + 1j * rng.normal()) for _ in range(2))),
            np.where(back, 0.0, rng.normal(size=webs)),
            counter_influence=np.where(back, rng.normal(size=webs), 0.0),
        )
        for name, unit in (("force", "N"), ("moment", "N m"))
    ]
    inside = random_point(rng, limits)
    along = [response.along(axis) for response in responses for axis in ("x", "y")] if ceilings else []
    allowed = [(response, 1.05 * float(response.to(inside).peak)) for response in along]
    peaks = [WeightedResponse(response, 1.0, *weights) for response in responses]
    return LadderProgram(
        statement(
            combined([weighted_peak(response, 1.0, *weights) for response in responses], combine), allowed, limits
        ),
        OverTheTurn(
            tuple(peaks), combine, tuple((WeightedResponse(response, 1.0), most) for response, most in allowed)
        ),
    )


@pytest.mark.parametrize("seed", part(4, range(12)))
@pytest.mark.parametrize("ceilings", part(2, [True, False]))
@pytest.mark.parametrize(("combine", "weights"), [("sum", (1.0, 1.0)), ("max", (1.0, 0.3))])
def test_no_bound_is_above_what_another_method_reached(
    seed: int, ceilings: bool, combine: str, weights: tuple[float, float]
) -> None:
    """Property: of webs that turn backwards the multipliers of samples and polygons prove bounds too."""
    task = mixed(seed, combine, weights, seed % 2 == 0, ceilings)
    best = reference(task)
    assert best.keeps_ceilings
    for method in methods():
        if method.setting.split()[0] not in ("12", "72", "32") and "1e-06" not in method.setting:
            continue
        outcome = method.prepare()(task, method.positions[-1], 5.0)
        assert not isinstance(outcome, str), (method, outcome)
        assert outcome.prove() <= best.objective + 1e-9 * rest(task), method
        assert good(task, outcome, best.lower_bound), method


@pytest.mark.parametrize("angles", [6, 12, 72])
@pytest.mark.parametrize("seed", range(4))
def test_sampled_programs_bracket_the_optimum(angles: int, seed: int) -> None:
    """Analytic: P_n <= P* <= P(u_n) <= P_n / cos(pi/n), whichever way webs turn."""
    task = mixed(seed, "sum", (1.0, 1.0), False, False)
    best = reference(task)
    point = solved(sampled(task.statement, task.turn, angles, 0.25, 5.0))
    reached, slack = float(task.statement.objective(point.unbalance)), 1e-6 * rest(task)
    assert point.claimed is not None
    assert point.claimed <= best.objective + slack
    assert reached * np.cos(np.pi / angles) <= point.claimed + slack


def test_webs_that_cannot_carry_anything_are_left_out_of_samples() -> None:
    """Analytic: of what is chosen the columns are those of the whole."""
    task = mixed(3, "sum", (1.0, 1.0), False, True)
    webs = np.arange(task.statement.limits.radius.size) != 0
    for peak in (*task.turn.only(webs).peaks, *(ceiling for ceiling, _ in task.turn.only(webs).ceilings)):
        assert peak.response.influence.shape == (webs.sum(),)
        against = peak.response.counter_influence
        assert against is None or against.shape == (webs.sum(),)
    response, second_response = task.turn.peaks[0].response, task.turn.only(webs).peaks[0].response
    u = np.full(webs.size, 0.3 - 0.1j) * webs
    assert replace(response).to(u).counter == pytest.approx(complex(second_response.to(u[webs]).counter), rel=1e-14)


def measured(machine: dict[str, Any], **more: Any) -> AccuracyAnswer:
    return accuracy({"machine": machine, "repeats": 1, **more})


def test_every_method_finds_what_the_shaft_lacks() -> None:
    """Analytic: a shaft that carries 2 kg of 5 leaves 0.3 of the force, for every method."""
    answer = measured(TOO_SMALL)
    assert (answer.status, answer.size.webs) == ("measured", 2)
    assert answer.reference is not None
    assert answer.reference.lower_bound == pytest.approx(0.3 * WHOLE, rel=1e-9)
    for row in answer.ladder:
        assert row.skipped is None
        assert row.relative_error is not None
        assert row.certified_gap is not None
        assert 0.0 <= row.relative_error <= row.certified_gap + 1e-15, row
        fine = row.setting in ("relative gap 1e-06", "tolerance 1e-08", "720 angles", "256 sides")
        assert not fine or row.relative_error <= 1e-4, row


@pytest.mark.parametrize(
    "goal",
    part(3, [{"combine": "max", "direction_weights": {"x": 1, "y": 0.3}}, {}, {"moment_ceiling_y_Nm": 300.0}]),
)
def test_the_ladder_stands_on_the_optimum_of_the_service(goal: dict[str, Any]) -> None:
    """Property: its bound is not above what the service reaches, and no lower than the gap."""
    body = {"machine": twin(balance_shafts=SHAFTS), "objective": goal}
    measurement, best = measured(**body), optimize(body)
    assert measurement.status == "measured"
    assert measurement.reference is not None
    # a shaft at twice the speed could carry something, which is of no use to the first order
    assert measurement.size.webs == 8
    # the gap that is asked of the service
    near = 1e-6 * measurement.reference.objective_without_counterweights
    assert best.certificate.objective == pytest.approx(measurement.reference.objective, abs=near)
    assert measurement.reference.lower_bound <= best.certificate.objective * (1.0 + 1e-12)
    assert all(row.certified_gap is None or row.certified_gap > -1e-12 for row in measurement.ladder)


def test_groups_beside_shafts_have_a_ladder_of_masses() -> None:
    """Property: masses and numbers are of all shafts together, as the service answers them."""
    body = {"machine": twin(**ALIKE, balance_shafts=SHAFTS)}
    measurement, best = measured(**body), optimize(body)
    assert best.total_mass_kg is not None
    assert best.balance_shafts_mass_kg is not None
    row = next(row for row in measurement.choices_ladder if row.method == "service")
    assert row.total_mass_kg == pytest.approx(best.total_mass_kg + best.balance_shafts_mass_kg, rel=1e-3)
    assert all(row.limits_kept for row in measurement.choices_ladder)
    assert all(row.relative_error is not None and row.relative_error >= 0.0 for row in measurement.choices_ladder)
