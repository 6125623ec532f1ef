"""All outputs: what they need, and what they come to in an answer and in a sweep."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from types import MappingProxyType
from typing import Any

from optimizer.effects.inertia import FIRST_ORDER_EFFECTS
from optimizer.effects.registry import EFFECTS, absent_effects, effects_of, rules_of
from optimizer.errors import MissingInput
from optimizer.formulation.simulation import Prepared, simulated, turns_over
from optimizer.numerics.arrays import Complex, Real
from optimizer.outputs.balance_quality import balance_quality
from optimizer.outputs.balance_rate import BALANCE_RATE, balance_rate
from optimizer.outputs.bearings import MAIN_BEARINGS
from optimizer.outputs.cautions import cautions
from optimizer.outputs.details import DETAILED
from optimizer.outputs.dynamics import OVER_THE_TURN
from optimizer.outputs.first_order import HODOGRAPH, RESIDUAL, floor
from optimizer.outputs.foundation import FOUNDATION_LOADS
from optimizer.outputs.internal_moment import INTERNAL_MOMENT
from optimizer.outputs.loads import LOADS
from optimizer.outputs.orders import ORDERS
from optimizer.outputs.output import Columns, Output
from optimizer.outputs.peaks import search
from optimizer.outputs.pins import PIN_LOADS
from optimizer.outputs.roll import ROLL
from optimizer.outputs.stages import STAGES
from schemas.base.model import FieldProblem
from schemas.base.rules import Path, Rule
from schemas.machine.machine import Machine
from schemas.request.scene import Scene
from schemas.sweep.details import usual_keys

#: every output, in the order of the answer
OUTPUTS: dict[str, Output] = {
    output.name: output
    for output in (
        RESIDUAL,
        BALANCE_RATE,
        HODOGRAPH,
        ORDERS,
        FOUNDATION_LOADS,
        STAGES,
        INTERNAL_MOMENT,
        *OVER_THE_TURN,
        ROLL,
        LOADS,
        MAIN_BEARINGS,
        PIN_LOADS,
    )
}

#: rows and bearings times shaft angles that one answer may hold
MAX_SAMPLES = 200_000


def prepare(
    request: Scene,
    outputs: Sequence[str],
    objective: tuple[str, ...] = (),
    machine: Machine | None = None,
) -> Prepared:
    """Simulate what outputs of a request call for.

    Parameters
    ----------
    objective : effects that the objective needs, which the machine gives.
    machine : another in place of that of the request.

    Raises
    ------
    MissingInput
        if the machine lacks what an output needs.
    """
    every = dict.fromkeys(outputs)
    require_inputs(request.machine if machine is None else machine, tuple(every), request.angles.count)
    needs = {name: OUTPUTS[name].needs for name in every}
    if objective:
        needs["objective"] = objective
    return simulated(request, needs, request.angles.count, machine=machine)


def fields(
    scene: Prepared,
    unbalance: Complex | None,
    outputs: Sequence[str],
    proven: Mapping[str, Any] = MappingProxyType({}),
) -> dict[str, Any]:
    """Fields of the answer for outputs of a scene without and with counterweights.

    Parameters
    ----------
    unbalance : (K,) kg m, the counterweights; None where there are none to show (infeasible).
    proven : fields of the answer with the proof of an optimum.
    """
    outputs = tuple(dict.fromkeys(outputs))
    scene.peaks.clear()
    search(scene, (entry for name in outputs for entry in OUTPUTS[name].searches(scene, unbalance)))
    results = {name: OUTPUTS[name].figure(scene, unbalance) for name in outputs}
    if all(effect in scene.results for effect in FIRST_ORDER_EFFECTS):
        results["balance_quality"] = balance_quality(scene, unbalance)
        results["floor"] = floor(scene.layout, scene.first_order())
    if BALANCE_RATE.name not in results:
        results[BALANCE_RATE.name] = balance_rate(scene.machine, unbalance)
    results["warnings"] = cautions(scene, unbalance, results, proven)
    return results


def columns(request: Scene, unbalance: Complex, always: tuple[str, ...], selection: frozenset[str]) -> dict[str, Real]:
    """Columns (n,) of the outputs of many designs, as many as have any.

    Parameters
    ----------
    request : of columns (n,), valid and complete.
    unbalance : (n, places) kg m, the counterweights, those on balance shafts behind those on the crankshaft; nan where
        there are none.
    always : outputs with columns in every row, whether the request names them or not.
    selection : keys of the columns that are (:func:`schemas.sweep.details.key`); what comes along beside them costs
        little.
    """
    groups = column_groups(request, always, selection)
    samples = request.angles.count if any(group.sampled for group in groups) else 1
    needs = {str(k): group.needs or () for k, group in enumerate(groups)}
    readings = tuple(dict.fromkeys(reading for group in groups for reading in group.readings))
    scene = simulated(request, needs, samples, unbalance.shape[:1], readings=readings)
    own = len(request.machine.webs)
    if unbalance.shape[-1] > own:
        unbalance, scene = unbalance[:, :own], scene.beside(unbalance[:, own:])
    results: dict[str, Real] = {}
    for group in groups:
        results |= group.values(scene, unbalance)
    return results


def column_groups(request: Scene, always: tuple[str, ...], selection: frozenset[str]) -> tuple[Columns, ...]:
    """The columns of a request's outputs that the sweep shows, in groups that are computed together."""
    return _groups((*always, *request.outputs), selection)


@lru_cache(maxsize=64)
def _groups(names: tuple[str, ...], selection: frozenset[str]) -> tuple[Columns, ...]:
    results = list[Columns]()
    for name in dict.fromkeys(names):
        output = OUTPUTS[name]
        keys = usual_keys(name)
        if output.columns is not None and (not keys or not selection.isdisjoint(keys)):
            results.append(replace(output.columns, needs=output.column_needs))
        results += [group for group in DETAILED.get(name, ()) if not selection.isdisjoint(group.keys)]
    return tuple(results)


def require_inputs(machine: Machine, outputs: Sequence[str], samples: int = 1) -> None:
    """Check that the machine has the inputs of the outputs, and that the answer is not too large.

    Parameters
    ----------
    samples : number of shaft angles in one turn.

    Raises
    ------
    MissingInput
        naming every missing field and an output that needs it.
    """
    problems: dict[Path, FieldProblem] = {}
    for output, effect in _demands(machine, outputs):
        for rule in rules_of(machine, effect):
            # of all that is kept nothing is worded
            if rule.broken:
                _, path, message = _of_output(rule, output)
                problems.setdefault(path, FieldProblem(path, message))
    needs = _needs(tuple(outputs))
    if "kinematics" in effects_of(needs) and _series(machine) * samples * turns_over(machine, needs) > MAX_SAMPLES:
        path = ("angles", "step_deg")
        message = f"rows and bearings times samples must be at most {MAX_SAMPLES}"
        problems[path] = FieldProblem(path, message)
    if problems:
        raise MissingInput(problems.values())


def input_rules(machine: Machine, outputs: Sequence[str]) -> Iterator[Rule]:
    """What the outputs ask of a machine, whose fields may hold columns (n,); paths from the root of the request."""
    for output, effect in _demands(machine, outputs):
        for rule in rules_of(machine, effect):
            yield _of_output(rule, output)


def _of_output(rule: Rule, output: str) -> Rule:
    """A rule of a machine as one of a request, in the name of an output."""
    broken, path, message = rule
    return Rule(broken, ("machine", *path), f"{message}; needed by output '{output}'")


def missing_inputs(machine: Machine, outputs: Sequence[str]) -> Iterator[FieldProblem]:
    """Fields that the outputs need and the machine does not give, whatever the numbers in the others."""
    for output, effect in _demands(machine, outputs):
        for path, message in EFFECTS[effect].problems(machine):
            yield FieldProblem(("machine", *path), f"{message}; needed by output '{output}'")


def _demands(machine: Machine, outputs: Sequence[str]) -> tuple[tuple[str, str], ...]:
    """Every effect that the outputs need and that asks anything of a machine, once, after the first that needs it."""
    names = tuple(outputs)
    return _first_users(names, absent_effects(machine, _needs(names)))


@lru_cache(maxsize=256)
def _first_users(outputs: tuple[str, ...], absent: frozenset[str]) -> tuple[tuple[str, str], ...]:
    first: dict[str, str] = {}
    for output in outputs:
        for effect in effects_of(OUTPUTS[output].needs):
            first.setdefault(effect, output)
    return tuple(
        (output, effect) for effect, output in first.items() if effect not in absent and EFFECTS[effect].demanding
    )


@lru_cache(maxsize=256)
def _needs(outputs: tuple[str, ...]) -> tuple[str, ...]:
    """Effects whose results the outputs read."""
    return tuple(need for output in outputs for need in OUTPUTS[output].needs)


def _series(machine: Machine) -> int:
    """Rows and bearings of a machine: so many series does an output hold."""
    return sum(len(throw.rows) for throw in machine.throws) + len(machine.bearings)
