"""What ran is told, with its time, and what was not called for does not run: for every kind of request."""

from collections import Counter
from dataclasses import replace
from typing import Any

import pytest

from optimizer import analyze, optimize, pareto
from optimizer.effects import registry
from optimizer.effects.effect import Context, Effect
from schemas.front.pareto import ParetoRequest
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from service.documents.examples import bodies
from tests.pairs.asking import body_of

EXAMPLES = bodies("")
INERTIA = {"rotating_inertia", "reciprocating_inertia", "second_order"}


@pytest.fixture
def ran(monkeypatch: pytest.MonkeyPatch) -> Counter[str]:
    """How often each effect was simulated, whoever asked."""
    counts: Counter[str] = Counter()

    def counted(effect: Effect) -> Effect:
        def simulate(context: Context) -> Any:
            counts[effect.name] += 1
            return effect.simulate(context)

        return replace(effect, simulate=simulate)

    for name, effect in registry.EFFECTS.items():
        monkeypatch.setitem(registry.EFFECTS, name, counted(effect))
    return counts


def _with(example: str = "2d12", **more: Any) -> dict[str, Any]:
    body = EXAMPLES[example]
    machine = {**body["machine"], **more.pop("machine", {})}
    return {**body, "outputs": ["residual"], **more, "machine": machine}


BEARINGS = {"bearings": [{"name": "A", "position_m": -0.5}, {"name": "B", "position_m": 0.5}]}
SCENARIOS = [
    {"name": "a", "weight": 1, "changes": []},
    {"name": "b", "weight": 1, "changes": [{"path": "/machine/throws/0/rows/0/reciprocating_mass_kg", "value": 250}]},
]
#: request, and effects beyond inertia that it calls for
REQUESTS: dict[str, tuple[dict[str, Any], set[str]]] = {
    "first order": (_with(), set()),
    "no outputs": (_with(outputs=[]), set()),
    "catalogue": (_with(machine={"catalogue": {"masses_kg": [20, 60], "angle_step_deg": 90}}), set()),
    "tolerances": (_with(tolerances={"mass_relative": 0.02}), set()),
    "scenarios": (_with(scenarios=SCENARIOS), set()),
    "all orders": (_with(objective={"orders": "all"}), {"frame_forces"}),
    "all orders, scenarios": (_with(objective={"orders": "all"}, scenarios=SCENARIOS), {"frame_forces"}),
    "roll": (_with("single-balance-shaft", objective={"roll_weight": 1}), {"whole_turn"}),
    "priorities": (_with(objective={"priorities": [{"goal": "external", "allowance": 0.01}]}), set()),
    "bearings": (_with(objective={"bearing_weight": 1}, machine=BEARINGS), {"whole_turn"}),
    "kinematics": (_with(outputs=["kinematics"]), {"kinematics"}),
    "scroll": (_with("scroll-oldham"), set()),
}


@pytest.mark.parametrize("name", REQUESTS)
def test_an_optimum_tells_what_ran(ran: Counter[str], name: str) -> None:
    body, beyond = REQUESTS[name]
    request = OptimizeRequest.model_validate(body)
    ran.clear()
    answer = optimize(request)
    effects = {effect for effect, use in answer.effects.items() if use.simulated}
    assert effects == set(ran)
    assert beyond <= effects
    assert beyond or effects <= INERTIA
    for effect, use in answer.effects.items():
        assert (use.time_ms > 0) == bool(use.needed_by) == (effect in ran), effect
    for effect in ("whole_turn", "frame_forces"):
        turn = answer.effects[effect]
        assert turn.simulated == (effect in beyond)
        if turn.simulated:
            assert set(turn.needed_by) & {"objective", "scenarios"}
    if not request.scenarios:
        # of one machine nothing runs twice
        assert set(ran.values()) == {1}
    else:
        assert "scenarios" in answer.effects["rotating_inertia"].needed_by


def test_peaks_on_the_frame_ask_for_no_gas(ran: Counter[str]) -> None:
    """Gas and friction are internal forces: with them all orders are as without, and they are not simulated."""
    body = body_of("twin", ("gas", "orders all"))
    bare = body_of("twin", ("orders all",))
    assert body is not None
    assert bare is not None
    ran.clear()
    with_gas = optimize(OptimizeRequest.model_validate(body))
    assert not {"gas", "friction", "whole_turn"} & set(ran)
    without = optimize(OptimizeRequest.model_validate(bare))
    assert with_gas.certificate == without.certificate


def test_an_analysis_and_a_front_tell_what_ran(ran: Counter[str]) -> None:
    for outputs in ([], ["residual"], ["orders"], ["kinematics"], ["torque"], ["main_bearings"]):
        ran.clear()
        body = {**_with(machine=BEARINGS), "outputs": outputs}
        body.pop("objective", None)
        answer = analyze(AnalyzeRequest.model_validate(body))
        assert {effect for effect, use in answer.effects.items() if use.simulated} == set(ran)
        assert set(ran.values()) == {1}
    ran.clear()
    front = pareto(ParetoRequest.model_validate({**_with(), "points": 3}))
    assert {effect for effect, use in front.effects.items() if use.simulated} == set(ran)
    assert "whole_turn" not in ran


def test_no_outputs_are_the_residual() -> None:
    body = _with(outputs=[])
    assert optimize(OptimizeRequest.model_validate(body)).residual is not None
    body.pop("objective", None)
    answer = analyze(AnalyzeRequest.model_validate(body))
    assert answer.residual is not None
    assert answer.orders is None


def test_what_is_called_for_later_is_simulated_once(ran: Counter[str]) -> None:
    from optimizer.outputs.registry import prepare

    request = OptimizeRequest.model_validate(_with())
    scene = prepare(request, request.outputs)
    ran.clear()
    first = scene.simulated.result("whole_turn", "objective")
    assert scene.simulated.result("whole_turn", "scenarios") is first
    assert ran["whole_turn"] == 1
    assert scene.simulated.uses["whole_turn"]["needed_by"] == ("objective", "scenarios")
