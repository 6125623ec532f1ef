"""Steps of mass and angle on balance shafts: against all roundings, and figures that are those of what is made."""

from itertools import product
from typing import Any

import numpy as np
import pytest

from optimizer.analyze import analyze
from optimizer.choices.discrete import search as discrete
from optimizer.errors import OutOfRange
from optimizer.optimize import optimize
from optimizer.studies.rounding.round import round_weights
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from schemas.request.rounding import RoundAnswer, RoundRequest
from service.report.chapters.rounding import with_rounding
from tests.night import part
from tests.optimize.machines import web
from tests.optimize.shafts import WHOLE, at, in_line_four, shaft, single
from tests.studies.accuracy.test_choices import ALIKE, twin

Body = dict[str, Any]
#: from its sector, and from its largest mass, some steps of a shaft are missing
SECTOR = {"centre_deg": 262.0, "half_angle_deg": 9.0}
TWO = twin(balance_shafts=[shaft("q", -1, 0.3, 3.2, sector=SECTOR), shaft("p", 1, -0.2, 4.0)])
TWO["webs"] = TWO["webs"][:3]


def lanchester(**more: Any) -> Body:
    body = single([shaft("back", -1, radius=0.05)])
    return body | {"webs": [web("a", 0.0, None, throw=0)], **more}


def on_steps(request: Body, mass_step_kg: float = 0.5, angle_step_deg: float = 5.0) -> RoundAnswer:
    sent = {"request": request, "mass_step_kg": mass_step_kg, "angle_step_deg": angle_step_deg}
    return round_weights(RoundRequest.model_validate(sent))


def fitted(answer: Any) -> list[Any]:
    """All counterweights, those of balance shafts last."""
    return [*answer.counterweights, *(weight for each in answer.balance_shafts for weight in each.counterweights)]


def value_of(request: Body, weights: list[dict[str, Any]]) -> float:
    """Independent: the objective of the first order of given weights, by their analysis; inf above the ceiling."""
    sent = {"machine": request["machine"], "outputs": ["residual"]}
    sent["counterweights"] = [weight for weight in weights if weight["mass_kg"] > 0]
    after = analyze(AnalyzeRequest.model_validate(sent)).residual.after
    places = [each["position_m"] for name in ("throws", "webs") for each in request["machine"][name]]
    span = max(places) - min(places) or 1.0
    if after.moment.peak_y_Nm > request.get("objective", {}).get("moment_ceiling_y_Nm", np.inf) * (1 + 1e-9):
        return np.inf
    return float(after.force.peak_N + after.moment.peak_Nm / span)


def best_by_hand(request: Body, mass_step: float, angle_step: float) -> float:
    """Independent: the smallest of all roundings of the optimum, one by one."""
    free = optimize(OptimizeRequest.model_validate(request))
    cranks = {place["name"]: request["machine"]["throws"][place["throw"]]["crank_angle_deg"]
              for place in request["machine"]["webs"]}  # fmt: skip
    places = {place["name"]: place for place in request["machine"]["webs"]}
    places |= {place["name"]: place for each in request["machine"]["balance_shafts"] for place in each["webs"]}
    options = []
    for one in fitted(free):
        own, from_crank = [(0.0, 0.0)], one.angle_deg - cranks.get(one.web, 0.0)
        for n, i in product((np.floor, np.ceil), repeat=2):
            mass, angle = n(one.mass_kg / mass_step) * mass_step, i(from_crank / angle_step) * angle_step
            angle = (angle + cranks.get(one.web, 0.0)) % 360.0
            sector = places[one.web].get("sector")
            off = 0.0 if sector is None else abs((angle - sector["centre_deg"] + 180.0) % 360.0 - 180.0)
            if 0.0 < mass <= places[one.web]["max_mass_kg"] and (sector is None or off <= sector["half_angle_deg"]):
                own.append((float(mass), float(angle)))
        options.append(own if one.mass_kg > 0 else own[:1])
    names = [one.web for one in fitted(free)]
    return min(
        value_of(
            request, [{"web": name, "mass_kg": m, "angle_deg": a} for name, (m, a) in zip(names, some, strict=True)]
        )
        for some in product(*options)
    )


@pytest.mark.parametrize("rotation", ["ccw", "cw"])
def test_what_cancels_all_on_steps_stays_as_it_is(rotation: str) -> None:
    # published: half of the reciprocating mass on either shaft, opposite the crank, cancels the first order
    found = on_steps({"machine": lanchester(rotation=rotation)})
    assert found.status == "optimal"
    assert [(one.mass_kg, one.angle_deg) for one in fitted(found)] == [(5.0, 270.0), (10.0, 270.0)]
    assert (found.total_mass_kg, found.balance_shafts_mass_kg) == (5.0, 10.0)
    assert found.certificate.objective <= 1e-9 * WHOLE
    # the optimum of any masses is nothing as far as its gap tells, and the share of nothing says nothing
    assert found.rounding.relative_rise is None
    for weights in (found.rounding.nearest, found.rounding.optimum):
        assert weights.balance_shafts_mass_kg == pytest.approx(10.0, rel=1e-5)
    # analytic: a step of 0.5 kg at the radius of the crank leaves 0.05 of the force of 10 kg, at half of it 0.025
    on_crank, on_shaft = found.rounding.steps
    assert (on_crank.web, on_shaft.web) == ("a", "back web")
    assert [on_crank.lighter, on_crank.heavier] == pytest.approx([0.05 * WHOLE] * 2, rel=1e-6)
    assert [on_shaft.lighter, on_shaft.heavier] == pytest.approx([0.025 * WHOLE] * 2, rel=1e-6)
    turned = 2.0 * np.sin(np.deg2rad(2.5)) * 0.5 * WHOLE
    assert [on_shaft.backward, on_shaft.forward] == pytest.approx([turned] * 2, rel=1e-6)


@pytest.mark.parametrize("rotation", part(2, ["ccw", "cw"]))
@pytest.mark.parametrize("goal", part(2, [{}, {"moment_ceiling_y_Nm": 700.0}]))
@pytest.mark.parametrize("steps", part(2, [(0.5, 5.0), (0.7, 7.2)]))
def test_the_answer_is_the_best_of_all_roundings(rotation: str, goal: Body, steps: tuple[float, float]) -> None:
    request = {"machine": TWO | {"rotation": rotation}, "objective": goal}
    found = on_steps(request, *steps)
    assert found.status == "optimal"
    best = best_by_hand(request, *steps)
    assert found.certificate.objective == pytest.approx(best, rel=1e-8)
    assert found.certificate.lower_bound <= best * (1 + 1e-9)
    made = [{"web": one.web, "mass_kg": one.mass_kg, "angle_deg": one.angle_deg} for one in fitted(found)]
    assert value_of(request, made) == pytest.approx(found.certificate.objective, rel=1e-9)
    for one in fitted(found):
        crank = 90.0 if one.web.startswith("1") else 0.0
        for value, step in ((one.mass_kg, steps[0]), (one.angle_deg - crank, steps[1])):
            # to the last digit: 64.1, not what is left of it where its mirror image is mirrored back
            assert abs(value / step - round(value / step)) <= 1e-12 * max(1.0, value / step)
            assert value == float(f"{value:.12g}")
    assert found.rounding.optimum.objective <= found.certificate.objective


@pytest.mark.parametrize("machine", part(2, [lanchester(), in_line_four(
    [shaft("a", 2, 0.2, y_m=0.3), shaft("b", -2, 0.1)], ratio=0.25)]))  # fmt: skip
def test_figures_over_all_orders_are_those_of_what_is_made(machine: Body) -> None:
    """Independent: masses times accelerations of the weights on steps, at every angle."""
    found = on_steps({"machine": machine, "objective": {"orders": "all", "moment_weight": 0}}, 0.1, 7.2)
    assert found.status == "optimal"
    shown = found.model_dump()
    turn = np.array([at(machine, shown, theta)[0] for theta in np.arange(0.0, 360.0, 0.5)])
    assert np.max(np.abs(turn)) == pytest.approx(found.certificate.objective, rel=1e-4)
    assert found.rounding.objective_rise >= 0.0
    assert found.rounding.nearest.objective >= found.certificate.objective * (1 - 1e-9)


def test_groups_and_fixed_weights_stand_beside_shafts() -> None:
    machine = twin(**ALIKE, balance_shafts=[shaft("q", -1, 0.3, 3.2), shaft("p", 1, -0.2, 4.0)])
    machine["webs"].append(web("there", 0.2, None, fixed={"mass_kg": 1.3, "angle_deg": 33.0}))
    found = on_steps({"machine": machine})
    assert found.status == "optimal"
    by_name = {one.web: one for one in fitted(found)}
    assert (by_name["there"].mass_kg, by_name["there"].angle_deg) == (1.3, 33.0)
    assert by_name["0a"].mass_kg == by_name["1b"].mass_kg
    assert "there" not in [step.web for step in found.rounding.steps]


def _refused(sent: Body) -> tuple[str | int, ...]:
    with pytest.raises(ValueError, match=r".") as refused:
        RoundRequest.model_validate(sent)
    (problem,) = refused.value.errors()[0]["ctx"]["problems"]
    return tuple(problem.path)


def test_wrong_steps_are_refused_by_their_fields() -> None:
    small = lanchester(webs=[web("a", 0.0, 0.4, throw=0)])
    small["balance_shafts"] = [shaft("back", -1, max_mass=0.3)]
    assert _refused({"request": {"machine": small}, "mass_step_kg": 0.5, "angle_step_deg": 5.0}) == ("mass_step_kg",)
    narrow = lanchester(balance_shafts=[shaft("back", -1, sector={"centre_deg": 262.0, "half_angle_deg": 1.0})])
    with pytest.raises(OutOfRange) as refused:
        on_steps({"machine": narrow})
    path = ("request", "machine", "balance_shafts", 0, "webs", 0, "sector")
    assert [tuple(problem.path) for problem in refused.value.problems] == [path]


def test_the_report_counts_what_is_on_the_shafts() -> None:
    request = {"request": {"machine": lanchester()}, "mass_step_kg": 0.5, "angle_step_deg": 5.0}
    sent = RoundRequest.model_validate(request)
    chapter = next(iter(with_rounding(sent, round_weights(sent))))
    table = chapter.blocks[0]
    assert [column.title for column in table.columns if "kg" in column.title] == [
        "mass on the crankshaft, kg",
        "on balance shafts, kg",
    ]
    assert str(table.rows[2]).count("'2'") == 1


def test_a_tree_over_a_revolution_takes_shafts_at_twice_the_speed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Regression: what turns faster has influences with a phase, which the compiled kernel does not take."""
    monkeypatch.setattr(discrete, "_SUMS", 0)
    machine = in_line_four([shaft("a", 2, 0.1), shaft("b", -2, 0.26)])
    request = {"machine": machine, "objective": {"orders": "all"}, "accuracy": {"time_limit_s": 5}}
    found = round_weights(RoundRequest.model_validate({"request": request, "mass_step_kg": 0.5, "angle_step_deg": 15}))
    assert found.status == "optimal"
