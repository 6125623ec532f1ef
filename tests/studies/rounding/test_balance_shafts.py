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
    fields = {"request": request, "mass_step_kg": mass_step_kg, "angle_step_deg": angle_step_deg}
    return round_weights(RoundRequest.model_validate(fields))


def fitted(answer: Any) -> list[Any]:
    """All counterweights, those of balance shafts last."""
    return [
        *answer.counterweights,
        *(weight for balance_shaft in answer.balance_shafts for weight in balance_shaft.counterweights),
    ]


def value_of(request: Body, weights: list[dict[str, Any]]) -> float:
    """Independent: the objective of the first order of given weights, by their analysis; inf above the ceiling."""
    body = {"machine": request["machine"], "outputs": ["residual"]}
    body["counterweights"] = [weight for weight in weights if weight["mass_kg"] > 0]
    after = analyze(AnalyzeRequest.model_validate(body)).residual.after
    places = [part["position_m"] for name in ("throws", "webs") for part in request["machine"][name]]
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
    places |= {
        place["name"]: place
        for balance_shaft in request["machine"]["balance_shafts"]
        for place in balance_shaft["webs"]
    }
    options = []
    for counterweight in fitted(free):
        own, from_crank = [(0.0, 0.0)], counterweight.angle_deg - cranks.get(counterweight.web, 0.0)
        for n, i in product((np.floor, np.ceil), repeat=2):
            mass, angle = n(counterweight.mass_kg / mass_step) * mass_step, i(from_crank / angle_step) * angle_step
            angle = (angle + cranks.get(counterweight.web, 0.0)) % 360.0
            sector = places[counterweight.web].get("sector")
            off = 0.0 if sector is None else abs((angle - sector["centre_deg"] + 180.0) % 360.0 - 180.0)
            if 0.0 < mass <= places[counterweight.web]["max_mass_kg"] and (
                sector is None or off <= sector["half_angle_deg"]
            ):
                own.append((float(mass), float(angle)))
        options.append(own if counterweight.mass_kg > 0 else own[:1])
    names = [weight.web for weight in fitted(free)]
    return min(
        value_of(
            request, [{"web": name, "mass_kg": m, "angle_deg": a} for name, (m, a) in zip(names, some, strict=True)]
        )
        for some in product(*options)
    )


@pytest.mark.parametrize("rotation", ["ccw", "cw"])
def test_what_cancels_all_on_steps_stays_as_it_is(rotation: str) -> None:
    # published: half of the reciprocating mass on either shaft, opposite the crank, cancels the first order
    answer = on_steps({"machine": lanchester(rotation=rotation)})
    assert answer.status == "optimal"
    assert [(counterweight.mass_kg, counterweight.angle_deg) for counterweight in fitted(answer)] == [
        (5.0, 270.0),
        (10.0, 270.0),
    ]
    assert (answer.total_mass_kg, answer.balance_shafts_mass_kg) == (5.0, 10.0)
    assert answer.certificate.objective <= 1e-9 * WHOLE
    # the optimum of any masses is nothing as far as its gap tells, and the share of nothing says nothing
    assert answer.rounding.relative_rise is None
    for weights in (answer.rounding.nearest, answer.rounding.optimum):
        assert weights.balance_shafts_mass_kg == pytest.approx(10.0, rel=1e-5)
    # analytic: a step of 0.5 kg at the radius of the crank leaves 0.05 of the force of 10 kg, at half of it 0.025
    on_crank, on_shaft = answer.rounding.steps
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
    answer = on_steps(request, *steps)
    assert answer.status == "optimal"
    best = best_by_hand(request, *steps)
    assert answer.certificate.objective == pytest.approx(best, rel=1e-8)
    assert answer.certificate.lower_bound <= best * (1 + 1e-9)
    counterweights = [
        {"web": counterweight.web, "mass_kg": counterweight.mass_kg, "angle_deg": counterweight.angle_deg}
        for counterweight in fitted(answer)
    ]
    assert value_of(request, counterweights) == pytest.approx(answer.certificate.objective, rel=1e-9)
    for weight in fitted(answer):
        crank = 90.0 if weight.web.startswith("1") else 0.0
        for quantity, step in ((weight.mass_kg, steps[0]), (weight.angle_deg - crank, steps[1])):
            # to the last digit: 64.1, not what is left of it where its mirror image is mirrored back
            assert abs(quantity / step - round(quantity / step)) <= 1e-12 * max(1.0, quantity / step)
            assert quantity == float(f"{quantity:.12g}")
    assert answer.rounding.optimum.objective <= answer.certificate.objective


@pytest.mark.parametrize("machine", part(2, [lanchester(), in_line_four(
    [shaft("a", 2, 0.2, y_m=0.3), shaft("b", -2, 0.1)], ratio=0.25)]))  # fmt: skip
def test_figures_over_all_orders_are_those_of_what_is_made(machine: Body) -> None:
    """Independent: masses times accelerations of the weights on steps, at every angle."""
    answer = on_steps({"machine": machine, "objective": {"orders": "all", "moment_weight": 0}}, 0.1, 7.2)
    assert answer.status == "optimal"
    fields = answer.model_dump()
    turn = np.array([at(machine, fields, theta)[0] for theta in np.arange(0.0, 360.0, 0.5)])
    assert np.max(np.abs(turn)) == pytest.approx(answer.certificate.objective, rel=1e-4)
    assert answer.rounding.objective_rise >= 0.0
    assert answer.rounding.nearest.objective >= answer.certificate.objective * (1 - 1e-9)


def test_groups_and_fixed_weights_stand_beside_shafts() -> None:
    machine = twin(**ALIKE, balance_shafts=[shaft("q", -1, 0.3, 3.2), shaft("p", 1, -0.2, 4.0)])
    machine["webs"].append(web("there", 0.2, None, fixed={"mass_kg": 1.3, "angle_deg": 33.0}))
    answer = on_steps({"machine": machine})
    assert answer.status == "optimal"
    by_name = {weight.web: weight for weight in fitted(answer)}
    assert (by_name["there"].mass_kg, by_name["there"].angle_deg) == (1.3, 33.0)
    assert by_name["0a"].mass_kg == by_name["1b"].mass_kg
    assert "there" not in [step.web for step in answer.rounding.steps]


def _refused(body: Body) -> tuple[str | int, ...]:
    with pytest.raises(ValueError, match=r".") as refused:
        RoundRequest.model_validate(body)
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
    body = RoundRequest.model_validate(request)
    chapter = next(iter(with_rounding(body, round_weights(body))))
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
    answer = round_weights(RoundRequest.model_validate({"request": request, "mass_step_kg": 0.5, "angle_step_deg": 15}))
    assert answer.status == "optimal"
