"""Objectives over the whole turn: closed forms, ceilings, goals in their order, and what is refused."""

from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from optimizer.analyze import analyze
from optimizer.errors import MissingInput
from optimizer.optimize import optimize
from schemas.answer.answers import Certificate, OptimizeAnswer
from schemas.front.pareto import ParetoRequest
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from tests.optimize.whole_turn import ALONE, inline_six, request_of, single_throw
from tests.pairs.asking import body_of


def answered(machine: dict[str, Any], **objective: Any) -> tuple[OptimizeAnswer, Certificate]:
    answer = optimize(request_of(machine, **objective))
    assert answer.status == "optimal", answer.status_reason
    assert answer.certificate is not None
    return answer, answer.certificate


@pytest.mark.parametrize(("rod", "radius", "share"), [(None, 0.25, 0.5), (3.0, 0.346038, 0.661)])
def test_one_throw_between_two_bearings(rod: float | None, radius: float, share: float) -> None:
    """Analytic: m_rec/4 on each bearing with (m_rot + m_rec/2)/2 on each web; published for a ratio of 1/3."""
    answer, proof = answered(single_throw(rod), bearing_weight=1, **ALONE)
    assert proof.objective == pytest.approx(radius, abs=2.5e-6)
    assert proof.objective_without_counterweights == pytest.approx(1.0 if rod is None else 1.0 + 1.0 / 6.0, rel=1e-6)
    for counterweight in answer.counterweights:
        assert counterweight.mass_kg == pytest.approx((1.0 + share) / 2, abs=2e-3)
        assert counterweight.angle_deg == pytest.approx(180.0, abs=0.1)
    assert proof.lower_bound is not None
    assert proof.lower_bound <= radius + 1e-6
    assert proof.cuts is not None
    assert proof.rounds is not None
    assert answer.main_bearings is not None


def test_a_web_without_a_limit_beside_others_that_have_one() -> None:
    """Analytic: as where no web has one, as each needs no more; what it could be of use is told of that web alone."""
    machine = single_throw(None)
    for web, most in zip(machine["webs"], (9.0, None), strict=True):
        web["max_mass_kg"] = most
    answer, proof = answered(machine, bearing_weight=1, **ALONE)
    assert proof.objective == pytest.approx(0.25, abs=2.5e-6)
    (limit,) = proof.implied_max_mass_kg.items()
    assert limit[0] == machine["webs"][1]["name"]
    assert answer.counterweights[1].mass_kg < limit[1] < np.inf


def test_one_throw_shakes_with_all_orders() -> None:
    """Published in the mathematics of this project: lam 0.3, a web takes the single's 1.3 down to .6964692."""
    machine = single_throw(1.0 / 0.3)
    machine["throws"][0]["rotating_mass_kg"] = 0.0
    machine["webs"] = [{"name": "w", "position_m": 0.0, "counterweight_radius_m": 1.0, "max_mass_kg": 9.0}]
    del machine["bearings"]
    answer, proof = answered(machine, orders="all", moment_weight=0, least_mass=False)
    assert proof.objective_without_counterweights == pytest.approx(1.3, rel=1e-9)
    assert proof.objective == pytest.approx(0.6964692, abs=2e-6)
    assert answer.counterweights[0].mass_kg == pytest.approx(0.603531, abs=1e-3)
    assert answer.main_bearings is None
    turn = answer.residual.turn
    assert turn is not None
    assert turn.after is not None
    assert turn.before.force_peak_N == pytest.approx(1.3, rel=1e-8)
    assert turn.after.force_peak_N == pytest.approx(proof.objective, rel=1e-7)
    # analytic: all of it is in one plane, of which the moment is told
    assert turn.after.moment_peak_Nm == pytest.approx(0.0, abs=1e-12)
    # the first order alone is another program
    first, alone = answered(machine, moment_weight=0)
    assert alone.objective == pytest.approx(0.5, rel=3e-6)
    assert first.residual.turn is None


def test_bearings_of_an_inline_six() -> None:
    """Regression, and published in the mathematics of this project for such a machine: 43.6 kN to 8.360 kN."""
    answer, proof = answered(inline_six(), bearing_weight=1, **ALONE)
    assert proof.objective_without_counterweights == pytest.approx(43.6e3, abs=50)
    assert proof.objective == pytest.approx(8.360e3, abs=1)
    assert proof.relative_gap is not None
    assert proof.relative_gap <= 1e-6
    assert proof.mass_relative_gap is not None
    assert proof.mass_relative_gap <= 1e-4
    assert answer.main_bearings is not None
    sampled = [bearing.after.peak_N for bearing in answer.main_bearings.bearings if bearing.after is not None]
    assert max(sampled) <= proof.objective * (1 + 1e-9)
    terms = proof.multipliers.objective.terms
    assert {term.response for term in terms} <= {f"bearing:{k}" for k in range(7)}
    assert all(term.angle_deg is not None for term in terms)
    assert sum(row.value for row in proof.multipliers.objective.rows) == pytest.approx(1.0, rel=1e-12)


def test_specific_loads_are_loads_over_areas() -> None:
    _, plain = answered(inline_six(), bearing_weight=1, least_mass=False, **ALONE)
    answer, specific = answered(inline_six(), bearing_weight=1, bearing_measure="specific", least_mass=False, **ALONE)
    assert specific.objective == pytest.approx(plain.objective / (0.06 * 0.02), rel=2e-6)
    assert answer.main_bearings is not None
    specific_loads_Pa = [
        bearing.after.specific_load_Pa for bearing in answer.main_bearings.bearings if bearing.after is not None
    ]
    assert max(load for load in specific_loads_Pa if load is not None) == pytest.approx(specific.objective, rel=1e-8)


def test_root_mean_squares_are_smaller_than_peaks() -> None:
    _, peak = answered(inline_six(), bearing_weight=1, least_mass=False, **ALONE)
    _, rms = answered(inline_six(), bearing_weight=1, bearing_measure="rms", least_mass=False, **ALONE)
    assert rms.objective < peak.objective


@pytest.mark.parametrize("rod", [1.01, 1.0001])
def test_root_mean_squares_of_rods_hardly_longer_than_the_crank_are_proven(rod: float) -> None:
    answer, proof = answered(single_throw(rod), bearing_weight=1, bearing_measure="rms", least_mass=False, **ALONE)
    assert answer.main_bearings is not None
    rmse_N = max(bearing.after.rms_N for bearing in answer.main_bearings.bearings if bearing.after is not None)
    assert proof.lower_bound is not None
    assert proof.lower_bound <= rmse_N <= proof.objective


def test_force_and_bearings_are_weighed_together() -> None:
    machine = inline_six()
    both, together = answered(machine, bearing_weight=1)
    _, bearings = answered(machine, bearing_weight=1, **ALONE)
    assert together.objective >= bearings.objective - 1.0
    assert both.residual.after is not None
    external = both.residual.after.force.peak_N + both.residual.after.moment.peak_Nm / 0.55
    assert together.objective == pytest.approx(bearings.objective + external, rel=1e-2)


def test_a_ceiling_on_bearings_is_kept_and_touched() -> None:
    answer, proof = answered(inline_six(), bearing_ceiling_N=12e3)
    assert answer.active_limits == ("bearing_ceiling",)
    assert answer.total_mass_kg is not None
    assert answer.total_mass_kg > 0
    assert answer.main_bearings is not None
    assert all(bearing.after is not None and bearing.after.peak_N <= 12e3 for bearing in answer.main_bearings.bearings)
    assert proof.multipliers.mass is not None
    assert any(ceiling.x or ceiling.y for ceiling in proof.multipliers.mass.ceilings)
    # a looser ceiling takes less iron
    looser, _ = answered(inline_six(), bearing_ceiling_N=20e3)
    assert looser.total_mass_kg is not None
    assert looser.total_mass_kg < answer.total_mass_kg


@pytest.mark.parametrize("field", ["bearing_ceiling_N", "specific_load_ceiling_Pa"])
def test_ceilings_below_the_floor_are_out_of_reach_and_say_by_how_much(field: str) -> None:
    area = 1.0 if field == "bearing_ceiling_N" else 0.06 * 0.02
    answer = optimize(request_of(inline_six(), **{field: 6e3 / area}))
    assert answer.status == "infeasible"
    why = answer.infeasibility
    assert why is not None
    assert why.conflict == (field,)
    (middle,) = why.smallest
    assert middle.response == "bearing:3"
    assert middle.ceiling == pytest.approx(6e3)
    assert middle.smallest == pytest.approx(8.360e3, abs=1)
    assert 6e3 < middle.lower_bound <= middle.smallest
    assert why.multipliers.conflict.ceilings


def test_smallest_peaks_of_all_orders_are_of_all_orders_with_a_ceiling_or_without() -> None:
    """Independent: what the peak comes to where it is weighed alone. The first order of the moment is 938 N m."""
    body = body_of("twin", ["orders all"])
    assert body is not None
    why = optimize(
        OptimizeRequest.model_validate(body | {"objective": {"orders": "all", "force_ceiling_N": 1}})
    ).infeasibility
    assert why is not None
    alone = {**body, "objective": {"orders": "all", "force_weight": 0, "moment_weight": 1}}
    proof = optimize(OptimizeRequest.model_validate(alone)).certificate
    assert proof is not None
    assert why.smallest_moment_Nm == pytest.approx(proof.objective, rel=1e-5)
    assert why.smallest_moment_lower_bound_Nm == pytest.approx(proof.lower_bound, rel=1e-5)
    assert why.smallest_moment_Nm > 1.4 * why.closest.first_order.moment.counter_rotating_Nm


def test_machines_without_webs_are_answered() -> None:
    machine = inline_six() | {"webs": []}
    _, proof = answered(machine, bearing_weight=1, **ALONE)
    # analytic: nothing can be fitted; both are brackets of the same peak
    assert proof.objective == pytest.approx(proof.objective_without_counterweights, rel=1e-9)
    assert answered(machine, bearing_ceiling_N=1e6)[1].objective == 0.0
    assert optimize(request_of(machine, bearing_ceiling_N=1e3)).status == "infeasible"


def test_bending_has_a_weight_and_a_ceiling() -> None:
    machine = inline_six()
    _, smallest = answered(machine, bending_weight=1, least_mass=False, **ALONE)
    assert 0 < smallest.objective < 0.5 * smallest.objective_without_counterweights
    answer, _ = answered(machine, bending_ceiling_Nm=1.5 * smallest.objective)
    assert answer.active_limits == ("bending_ceiling",)
    assert answer.main_bearings is not None
    assert answer.main_bearings.bending.after_Nm is not None
    assert max(answer.main_bearings.bending.after_Nm) <= 1.5 * smallest.objective * (1 + 1e-9)


def test_goals_are_met_one_after_the_other() -> None:
    order = [{"goal": "external", "allowance": 0.001}, {"goal": "bearings"}, {"goal": "mass"}]
    answer, proof = answered(inline_six(), bearing_weight=1, priorities=order)
    (external,) = proof.goals
    assert external.goal == "external"
    assert external.value <= external.limit
    assert proof.objective == pytest.approx(8.360e3, abs=1)
    assert answer.residual.after is not None
    assert answer.residual.after.force.peak_N <= external.limit * (1 + 1e-9)


def test_continuous_shafts_carry_otherwise() -> None:
    request = request_of(inline_six(), bearing_weight=1, least_mass=False, **ALONE)
    continuous = request.model_copy(update={"fidelity": request.fidelity.model_copy(update={"shaft": "continuous"})})
    certificate, second_certificate = optimize(request).certificate, optimize(continuous).certificate
    assert certificate is not None
    assert second_certificate is not None
    assert abs(certificate.objective - second_certificate.objective) > 0.05 * certificate.objective


@pytest.mark.parametrize(
    ("objective", "field"),
    [
        ({"bearing_weight": 0, **ALONE}, "moment_weight"),
        ({"orders": "all", "direction_weights": {"x": 1, "y": 2}}, "direction_weights"),
        ({"priorities": [{"goal": "external"}, {"goal": "external"}]}, "goal"),
        ({"priorities": [{"goal": "mass"}, {"goal": "external"}]}, "goal"),
        ({"priorities": [{"goal": "mass"}]}, "goal"),
        ({"priorities": [{"goal": "bearings"}]}, "goal"),
        ({"bearing_weight": 1, "priorities": [{"goal": "bearings"}]}, "priorities"),
        ({"least_mass": False, "priorities": [{"goal": "external"}, {"goal": "mass"}]}, "least_mass"),
        ({"bearing_measure": "mean"}, "bearing_measure"),
    ],
)
def test_objectives_that_contradict_themselves_name_the_field(objective: dict[str, Any], field: str) -> None:
    with pytest.raises(ValidationError) as refused:
        request_of(inline_six(), **objective)
    assert field in {str(part) for error in refused.value.errors() for part in (*error["loc"], error["msg"])} or any(
        field in str(error) for error in refused.value.errors()
    )


def test_what_a_machine_lacks_is_named() -> None:
    machine = inline_six()
    del machine["bearings"][2]["length_m"]
    with pytest.raises(MissingInput) as missing:
        optimize(request_of(machine, specific_load_ceiling_Pa=1e7))
    assert [problem.path for problem in missing.value.problems] == [("machine", "bearings", 2, "length_m")]
    del machine["bearings"]
    with pytest.raises(MissingInput) as missing:
        optimize(request_of(machine, bearing_weight=1))
    (problem,) = missing.value.problems
    assert problem.path == ("machine", "bearings")
    assert problem.message == "bearing loads need the bearings; needed by objective.bearing_weight"
    with pytest.raises(MissingInput) as missing:
        optimize(request_of(machine, bending_ceiling_Nm=5.0))
    (problem,) = missing.value.problems
    assert problem.path == ("machine", "bearings")
    assert problem.message.startswith("a free shaft bends in a known way only where its loads balance at every angle")
    del machine["throws"][0]["rows"][0]["connecting_rod"]
    with pytest.raises(MissingInput) as missing:
        optimize(request_of(machine, orders="all"))
    (problem,) = missing.value.problems
    assert problem.path == ("machine", "throws", 0, "rows", 0, "connecting_rod")
    assert problem.message.endswith("needed by objective.orders")


def test_fronts_refuse_the_whole_turn() -> None:
    base = {"machine": inline_six(), "objective": {"bearing_weight": 1}}
    with pytest.raises(ValidationError, match="name the goals in `responses`"):
        ParetoRequest.model_validate(base)


@pytest.mark.parametrize("seed", range(3))
def test_brute_force_never_beats_the_certificate(seed: int) -> None:
    """Independent: peaks of random counterweights near the answer, at 0.1 degree, by the analysis of samples."""
    machine = inline_six()
    answer, proof = answered(machine, bearing_weight=1, least_mass=False, **ALONE)
    rng = np.random.default_rng(seed)
    fitted = [
        {
            "web": counterweight.web,
            "mass_kg": counterweight.mass_kg * rng.uniform(0.9, 1.1),
            "angle_deg": counterweight.angle_deg + rng.normal(),
        }
        for counterweight in answer.counterweights
    ]

    body = {"machine": machine, "counterweights": fitted, "outputs": ["main_bearings"], "angles": {"step_deg": 0.1}}
    loads = analyze(AnalyzeRequest.model_validate(body)).main_bearings
    assert loads is not None
    peak = max(bearing.after.peak_N for bearing in loads.bearings if bearing.after is not None)
    assert proof.lower_bound is not None
    # what 0.1 degree may miss of the curve
    assert proof.lower_bound <= peak * (1 + 1e-5)


@pytest.mark.parametrize("objective", [{"bearing_weight": 1}, {"bearing_ceiling_N": 12e3}])
def test_a_search_that_its_time_limit_ends_says_so(objective: dict[str, Any]) -> None:
    request = request_of(inline_six(), **objective)
    accuracy = request.accuracy.model_copy(update={"time_limit_s": 1e-9, "relative_gap": 1e-12})
    answer = optimize(request.model_copy(update={"accuracy": accuracy}))
    assert answer.status == "inaccurate"
    assert answer.status_reason.startswith("The time limit of 1e-09 s ended the search. ")
    proof = answer.certificate
    assert proof is not None
    assert proof.lower_bound is not None
    assert proof.lower_bound <= proof.objective


@pytest.mark.parametrize("shaft", ["simple_spans", "continuous"])
def test_a_shaft_whose_loads_sit_on_bearings_does_not_bend(shaft: str) -> None:
    """Analytic: the only throw is in the plane of a bearing, and no web is anywhere else."""
    body = body_of("vee", ["three bearings", "bending alone", "no webs"])
    assert body is not None
    answer = optimize(OptimizeRequest.model_validate({**body, "fidelity": {"shaft": shaft}}))
    assert answer.status == "optimal"
    assert answer.certificate is not None
    assert (answer.certificate.objective, answer.certificate.lower_bound) == (0.0, 0.0)
