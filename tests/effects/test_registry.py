"""The registry holds together, and every effect sees what it declares and no more."""

from dataclasses import replace
from typing import Any, get_args

import numpy as np
import pytest

from optimizer.effects import registry
from optimizer.effects.effect import Context
from optimizer.effects.registry import EFFECTS, closure, inputs_of, simulate
from optimizer.mechanics.layout import layout
from optimizer.outputs.registry import OUTPUTS
from schemas.answer.answers import AnalyzeAnswer, OptimizeAnswer
from schemas.answer.outputs import OutputName
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.requests import AnalyzeRequest
from schemas.request.scene import Fidelity
from tests.effects.machines import EVERY, complete

#: of every output, and of an objective that serves itself
_OF_OBJECTIVES = ("frame_forces",)
_DEMANDS = {name: OUTPUTS[name].needs for name in EVERY} | {"objective": _OF_OBJECTIVES}


def test_every_output_of_the_contract_is_registered_and_answered() -> None:
    assert set(OUTPUTS) == set(get_args(OutputName))
    assert len(EVERY) == len(set(EVERY))
    for answer in (AnalyzeAnswer, OptimizeAnswer):
        assert set(OUTPUTS) <= set(answer.model_fields)


def test_every_effect_stands_after_what_it_needs() -> None:
    order = list(EFFECTS)
    for name, effect in EFFECTS.items():
        assert effect.name == name
        assert effect.meaning
        assert len(set(effect.needs)) == len(effect.needs)
        for need in effect.needs:
            assert order.index(need) < order.index(name)


def test_outputs_need_effects_that_exist_and_every_effect_serves_one() -> None:
    machine = ReciprocatingMachine.model_validate(complete())
    for output in OUTPUTS.values():
        assert output.meaning
        assert set(output.needs) <= set(EFFECTS)
    served = {name for output in OUTPUTS.values() for name in closure(machine, output.needs)}
    assert served | set(closure(machine, _OF_OBJECTIVES)) == set(EFFECTS)


def _fields(model: Any, path: list[str]) -> bool:
    """Whether a dotted path of fields exists in a model."""
    if not path:
        return True
    annotations, models = [model], []
    while annotations:
        remainder = annotations.pop()
        annotations.extend(get_args(remainder))
        if hasattr(remainder, "model_fields"):
            models.append(remainder)
    return any(
        path[0] in scheme.model_fields and _fields(scheme.model_fields[path[0]].annotation, path[1:])
        for scheme in models
    )


@pytest.mark.parametrize("output", EVERY)
def test_inputs_are_fields_of_the_request(output: str) -> None:
    named = inputs_of(OUTPUTS[output].needs)
    assert len(set(named)) == len(named)
    for path in named:
        assert _fields(AnalyzeRequest, path.split(".")), path
    if output in ("residual", "hodograph"):
        assert named == ()


def test_closure_holds_the_needs_of_needs_in_order() -> None:
    machine = ReciprocatingMachine.model_validate(complete())
    # analytic: by hand
    expected = ["kinematics", "gas", "friction", "whole_turn", "torque_integrals", "flywheel"]
    assert closure(machine, OUTPUTS["flywheel"].needs) == expected
    assert closure(machine, ("rotating_inertia",)) == ["rotating_inertia"]
    assert closure(machine, ()) == []
    frictionless = ReciprocatingMachine.model_validate(complete(friction=None))
    assert closure(frictionless, OUTPUTS["flywheel"].needs) == [name for name in expected if name != "friction"]


@pytest.mark.parametrize("friction", [True, False])
def test_the_context_holds_exactly_what_was_declared(monkeypatch: pytest.MonkeyPatch, friction: bool) -> None:
    fields: dict[str, list[set[str]]] = {}

    def watched(name: str) -> Any:
        simulate_it = EFFECTS[name].simulate

        def spy(context: Context) -> Any:
            fields.setdefault(name, []).append(set(context.results))
            return simulate_it(context)

        return replace(EFFECTS[name], simulate=spy)

    body = complete() if friction else complete(friction=None)
    machine = ReciprocatingMachine.model_validate(body)
    monkeypatch.setattr(registry, "EFFECTS", {name: watched(name) for name in EFFECTS})
    simulate(machine, layout(machine), _DEMANDS, Fidelity(), np.linspace(0.0, 6.0, 8))
    for name, effect in EFFECTS.items():
        if name == "pin_loads" or (name == "friction" and not friction):
            assert name not in fields
            continue
        declared = {need for need in effect.needs if friction or need != "friction"}
        assert all(texts == declared for texts in fields[name]), name


def test_every_effect_runs_once_at_the_samples(monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[tuple[str, int]] = []

    def counted(name: str) -> Any:
        simulate_it = EFFECTS[name].simulate

        def count(context: Context) -> Any:
            calls.append((name, context.angle.size))
            return simulate_it(context)

        return replace(EFFECTS[name], simulate=count)

    machine = ReciprocatingMachine.model_validate(complete())
    monkeypatch.setattr(registry, "EFFECTS", {name: counted(name) for name in EFFECTS})
    simulate(machine, layout(machine), _DEMANDS, Fidelity(), np.linspace(0.0, 6.0, 7))
    assert calls == [(name, 7) for name in EFFECTS if name != "pin_loads"]


def test_a_result_is_kept_only_for_the_outputs_that_name_it() -> None:
    machine = ReciprocatingMachine.model_validate(complete())
    actual_needs = {name: OUTPUTS[name].needs for name in ("rod_loads", "flywheel")}
    simulation = simulate(machine, layout(machine), actual_needs, Fidelity(), np.linspace(0.0, 6.0, 7))
    assert set(simulation.results) == {need for needs in actual_needs.values() for need in needs}
    assert {name for name, use in simulation.uses.items() if use["simulated"]} > set(simulation.results)
