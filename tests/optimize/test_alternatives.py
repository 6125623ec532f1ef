"""Cheaper choices beside the best one: against every set, what is refused, and what a stranger finds."""

from importlib import import_module
from typing import Any

import pytest

from optimizer.formulation.task import Task
from optimizer.optimize import optimize
from optimizer.solve.costs import Costs
from schemas.answer.alternatives import Alternative
from schemas.answer.answers import OptimizeAnswer
from schemas.base.model import Model
from schemas.front.pareto import ParetoRequest
from schemas.request.accuracy import AccuracyRequest
from schemas.request.requests import OptimizeRequest
from schemas.sweep.request import SweepRequest
from service.report.chapters.alternatives import alternatives as chapter
from tests.night import part
from tests.optimize.machines import web
from tests.optimize.test_catalogue import every_set, twin
from tests.verification.checking import optimized, verdict

_ALLOWANCES = [0.0, 0.02, 0.1, 0.5]


def question(body: dict[str, Any], **more: Any) -> dict[str, Any]:
    return {"machine": body, "alternatives": _ALLOWANCES, **more}


def small(**more: Any) -> dict[str, Any]:
    webs = [web(name, z, 60.0, 0.12) for name, z in zip("abd", (-0.4, -0.2, 0.4), strict=True)]
    return twin(webs, catalogue={"masses_kg": [3, 7.5, 16], "angle_step_deg": 180}, **more)


@pytest.mark.parametrize("combine", part(2, ["sum", "max"]))
def test_the_cheapest_of_all_sets(combine: str) -> None:
    """Independent: every set, by the analysis of each."""
    body = small()
    answer = optimized(question(body, objective={"combine": combine, "force_weight": 1.0, "moment_weight": 2.0}))
    assert answer.certificate is not None
    sets = []
    for some, after in every_set(body, [[0.0, 180.0], [0.0, 180.0], [90.0, 270.0]]):
        peaks = after.force.peak_N, 2.0 * after.moment.peak_Nm
        masses = [mass for mass, _ in some if mass > 0]
        objective = sum(peaks) if combine == "sum" else max(peaks)
        sets.append((objective, {"mass": sum(masses), "pieces": len(masses), "sizes": len(set(masses))}))
    best = min(objective for objective, _ in sets)
    assert answer.certificate.objective == pytest.approx(best, rel=1e-9)
    own = {
        "mass": answer.total_mass_kg,
        "pieces": sum(counterweight.mass_kg > 0 for counterweight in answer.counterweights),
        "sizes": len({counterweight.mass_kg for counterweight in answer.counterweights if counterweight.mass_kg > 0}),
    }
    for minimised, minimum in own.items():
        expected = []
        for allowance in _ALLOWANCES:
            within = [
                cost[minimised] for objective, cost in sets if objective <= best * (1.0 + allowance) * (1.0 + 1e-9)
            ]
            if min(within) < minimum:
                minimum = min(within)
                expected.append((allowance, minimum))
        listed = [alternative for alternative in answer.alternatives if alternative.minimised == minimised]
        costs = {"mass": "total_mass_kg", "pieces": "pieces", "sizes": "sizes"}
        assert [(alternative.allowance, getattr(alternative, costs[minimised])) for alternative in listed] == expected
        for bound in listed:
            # all sets were compared: the bound is what was found
            assert bound.lower_bound == pytest.approx(getattr(bound, costs[minimised]), rel=1e-9)
            assert bound.objective <= best * (1.0 + bound.allowance) * (1.0 + 1e-9)
    assert answer.alternatives


def test_the_machine_of_the_foundry() -> None:
    """Published (parts.md 10): by hand two castings of 85.5 kg come to 42,252 N, 4.1 % above the best; within 5 % the
    service has lighter ones."""
    cranks, centres = (0.0, 180.0, 90.0, 270.0), (-1.35, -0.45, 0.45, 1.35)
    rows = zip(centres, cranks, (0.0, 180.0, 0.0, 180.0), (420.0, 395.0, 410.0, 388.0), strict=True)
    body = {
        "kind": "reciprocating",
        "speed_rpm": 600,
        "throws": [
            {
                "position_m": z, "crank_radius_m": 0.1, "crank_angle_deg": crank, "rotating_mass_kg": 60,
                "rows": [{"axis_deg": axis, "reciprocating_mass_kg": mass}],
            }
            for z, crank, axis, mass in rows
        ],
        "webs": [
            {
                "name": f"{n}{side}", "position_m": z + off, "counterweight_radius_m": 0.26, "max_mass_kg": 90,
                "sector": {"centre_deg": (crank + 180.0) % 360.0, "half_angle_deg": 60},
            }
            for n, (z, crank) in enumerate(zip(centres, cranks, strict=True), 1)
            for side, off in (("a", -0.15), ("b", 0.15))
        ],
        "catalogue": {"mass_step_kg": 0.5, "angle_step_deg": 5},
    }  # fmt: skip
    answer = optimized({"machine": body, "alternatives": [0.01, 0.05], "accuracy": {"time_limit_s": 2}})
    assert answer.status == "optimal"
    pieces = {
        alternative.allowance: alternative for alternative in answer.alternatives if alternative.minimised == "pieces"
    }
    assert (pieces[0.05].pieces, pieces[0.05].lower_bound) == (2, 2)
    assert pieces[0.05].total_mass_kg <= 85.5
    assert answer.certificate is not None
    assert pieces[0.05].objective <= 1.05 * answer.certificate.objective * (1.0 + 1e-9)
    # two that come to no more than 1 % above the best there are not: all pairs of webs were compared
    assert pieces[0.01].lower_bound == 3
    assert pieces[0.01].pieces < sum(counterweight.mass_kg > 0 for counterweight in answer.counterweights)
    assert next(iter(chapter(answer))).title == "Cheaper choices"


def test_what_nothing_is_cheaper_than() -> None:
    """Analytic: without a word of allowances nothing is listed; where the best is nothing at all, nor is anything."""
    body = small()
    assert optimized({"machine": body}).alternatives == ()
    assert not list(chapter(optimized({"machine": body})))
    idle = {**body, "throws": [{**throw, "rotating_mass_kg": 0, "rows": []} for throw in body["throws"]]}
    assert optimized(question(idle)).alternatives == ()


def test_fixed_weights_count_and_are_not_chosen() -> None:
    """Analytic: what is fixed is in the total mass, and in its bound, and is no piece."""
    body = small()
    body["webs"][0] = {**{k: v for k, v in body["webs"][0].items() if k != "max_mass_kg"},
                       "fixed": {"mass_kg": 5.0, "angle_deg": 180.0}}  # fmt: skip
    answer = optimized(question(body))
    for alternative in answer.alternatives:
        chosen = [
            counterweight
            for counterweight in alternative.counterweights
            if counterweight.mass_kg > 0 and counterweight.web != "a"
        ]
        assert alternative.pieces == len(chosen)
        assert alternative.total_mass_kg == pytest.approx(
            5.0 + sum(counterweight.mass_kg for counterweight in chosen), rel=1e-12
        )
        assert alternative.minimised != "mass" or alternative.lower_bound >= 5.0
    assert answer.alternatives


@pytest.mark.parametrize(("alternatives", "first_s"), [([0.01], 6.0), ([], 10.0)])
def test_all_of_it_shares_one_time_limit(
    monkeypatch: pytest.MonkeyPatch, alternatives: list[float], first_s: float
) -> None:
    """Analytic: the best choice has 6 s of 10 where cheaper ones are listed, and the rest is what it left."""
    body = question(small(), accuracy={"time_limit_s": 10}) | {"alternatives": alternatives}
    module, limits, left = import_module("optimizer.optimize"), list[float](), list[float]()
    search = module.solve

    def solved(task: Task, *rest: Any) -> Any:
        limits.append(task.time_limit_s)
        return search(task, *rest)

    def listed(*some: Any) -> tuple[Alternative, ...]:
        left.append(some[-1])
        return ()

    monkeypatch.setattr(module, "solve", solved)
    monkeypatch.setattr(module, "alternatives", listed)
    optimize(OptimizeRequest.model_validate(body))
    assert limits == [first_s]
    assert all(4.0 <= mass < 10.0 for mass in left)
    assert len(left) == len(alternatives)


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({"alternatives": [-0.1]}, "greater than or equal to 0"),
        ({"alternatives": [1.5]}, "less than or equal to 1"),
        ({"machine": {"catalogue": None}}, "give a catalogue too"),
        (
            {"objective": {"priorities": [{"goal": "external"}, {"goal": "mass"}]}},
            "listed beside one goal",
        ),
    ],
)
def test_refusals_name_the_field(more: dict[str, Any], words: str) -> None:
    body = question({**small(), **more.pop("machine", {})})
    with pytest.raises(ValueError, match=words):
        OptimizeRequest.model_validate({**body, **more})


@pytest.mark.parametrize("model", [ParetoRequest, AccuracyRequest, SweepRequest])
def test_what_lists_none_refuses_them(model: type[Model]) -> None:
    """Fronts, ladders and sweeps have no such list, and say so at the field."""
    body = question(small())
    axes = [{"path": "/machine/speed_rpm", "values": [400, 500]}]
    sweep = {"base": body, "axes": axes} if model is SweepRequest else body
    with pytest.raises(ValueError, match=r"remove it|none for cheaper ones|not a sweep"):
        model.model_validate(sweep)


def test_a_bound_above_its_choice_is_a_fault_that_is_logged(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    """Nothing is proven then, and nothing is clipped."""
    true = Costs._lightest
    monkeypatch.setattr(Costs, "_lightest", lambda costs, level, seconds: 1e6 * (1.0 + true(costs, level, seconds)))
    answer = optimized(question(small()))
    of_mass = [alternative for alternative in answer.alternatives if alternative.minimised == "mass"]
    assert of_mass
    assert all(alternative.lower_bound is None for alternative in of_mass)
    assert any("below its bound" in record.message for record in caplog.records if record.levelname == "ERROR")
    assert next(iter(chapter(answer))).title == "Cheaper choices"


def test_a_stranger_finds_what_is_false() -> None:
    """Independent: the checker of the example client recomputes every choice."""
    body = question(small())
    answer: OptimizeAnswer = optimized(body)
    (first, *_) = answer.alternatives
    fields = {"objective": first.objective * 0.999, "total_mass_kg": first.total_mass_kg * 0.99}
    fields |= {"pieces": first.pieces - 1, "sizes": first.sizes + 1, "lower_bound": first.lower_bound * 2.0}
    fields |= {"allowance": 0.01}
    for name, figure in fields.items():
        false = answer.model_dump(mode="json")
        false["alternatives"][0][name] = figure
        assert verdict(body, false) == "broken", name
