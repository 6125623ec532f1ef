"""All effects and outputs, and the simulation of just those that a scene calls for."""

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from optimizer.arrays import Real
from optimizer.effects.dynamics import DYNAMICS
from optimizer.effects.effect import Context, Effect
from optimizer.effects.inertia import INERTIA
from optimizer.effects.scroll import SCROLL
from optimizer.errors import MissingInput
from optimizer.mechanics.inertia import Wrench
from optimizer.mechanics.layout import Layout
from schemas.answers import EffectUse
from schemas.base import FieldProblem
from schemas.machine import Machine, ReciprocatingMachine
from schemas.requests import Fidelity

#: every effect; each stands after those that it needs
EFFECTS: dict[str, Effect] = {effect.name: effect for effect in (*INERTIA, *DYNAMICS, *SCROLL)}

#: rows and bearings times shaft angles that one answer may hold
MAX_SAMPLES = 200_000
_FIRST_ORDER = ("rotating_inertia", "reciprocating_inertia")


@dataclass(frozen=True)
class Output:
    """An output: a line about it, and the effects that it needs."""

    meaning: str
    needs: tuple[str, ...]


OUTPUTS: dict[str, Output] = {
    "residual": Output("first-order force and moment, before and after", _FIRST_ORDER),
    "hodograph": Output("first-order force and moment over the turn", _FIRST_ORDER),
    "orders": Output("phasors at orders 1, 2, 4 and 6", (*_FIRST_ORDER, "second_order", "higher_orders")),
    "stages": Output("the eight balancing stages", (*_FIRST_ORDER, "second_order")),
    "kinematics": Output("motion of every row", ("kinematics",)),
    "gas": Output("pressures and gas forces of every row, indicated power", ("gas",)),
    "piston_force": Output("gas, inertia and friction on every piston", ("piston_force",)),
    "rod_loads": Output("forces on rod, guide and crank pin; load cases", ("rod_forces",)),
    "torque": Output("torque over the turn, its mean, powers, fluctuation energy", ("torque_integrals",)),
    "flywheel": Output("irregularity of the speed and inertia", ("flywheel",)),
    "overturning": Output("overturning couple on the frame", ("rod_forces",)),
    "main_bearings": Output("main-bearing loads and bending of the shaft", ("shaft_loads",)),
    "pin_loads": Output("loads of the anti-rotation pins of a scroll", ("pin_loads",)),
}


def closure(machine: Machine, needs: Sequence[str]) -> list[str]:
    """Effects that have to run for these, in the order in which they can; those that do not apply left out."""
    return [name for name in effects_of(needs) if EFFECTS[name].applies(machine)]


def effects_of(needs: Sequence[str]) -> list[str]:
    """These effects and all that they need, in the order in which they can run, whatever the machine."""
    wanted = set(needs)
    for name in reversed(EFFECTS):
        if name in wanted:
            wanted.update(EFFECTS[name].needs)
    return [name for name in EFFECTS if name in wanted]


def require_inputs(machine: Machine, outputs: Sequence[str], samples: int = 1) -> None:
    """Check that the machine gives what the outputs need, and that not too much is asked for.

    Parameters
    ----------
    samples : number of shaft angles asked for.

    Raises
    ------
    MissingInput
        naming every missing field and an output that needs it.
    """
    problems: dict[tuple[str | int, ...], FieldProblem] = {}
    for output in outputs:
        for name in closure(machine, OUTPUTS[output].needs):
            for path, message in EFFECTS[name].problems(machine):
                full = ("machine", *path)
                problems.setdefault(full, FieldProblem(full, f"{message}; asked for by output '{output}'"))
        if "kinematics" in closure(machine, OUTPUTS[output].needs) and _series(machine) * samples > MAX_SAMPLES:
            path = ("angles", "step_deg")
            message = f"rows and bearings times samples must be at most {MAX_SAMPLES}"
            problems[path] = FieldProblem(path, message)
    if problems:
        raise MissingInput(problems.values())


def _series(machine: Machine) -> int:
    """Rows and bearings of a machine: so many series does an output hold."""
    if not isinstance(machine, ReciprocatingMachine):
        return 0
    return sum(len(throw.rows) for throw in machine.throws) + len(machine.bearings)


@dataclass
class Simulated:
    """Results of the effects that ran, by name, and the use made of every effect."""

    results: dict[str, Any] = field(default_factory=dict)
    uses: dict[str, EffectUse] = field(default_factory=dict)

    @property
    def first_order(self) -> Wrench:
        """First-order force and moment without counterweights, over omega^2."""
        rotating: Wrench = self.results["rotating_inertia"]
        return rotating.plus(self.results["reciprocating_inertia"])


def simulate(
    machine: Machine, layout: Layout, outputs: Sequence[str], fidelity: Fidelity, angle: Real | None = None
) -> Simulated:
    """Run the effects that the outputs call for, each once, and no others.

    Parameters
    ----------
    angle : (T,) rad, shaft angles of the samples; needed only by sampled effects.
    """
    samples = np.zeros(0) if angle is None else angle
    asked = {output: closure(machine, OUTPUTS[output].needs) for output in outputs}
    simulated = Simulated()
    for name in EFFECTS:
        needed_by = tuple(output for output, names in asked.items() if name in names)
        start = time.perf_counter()
        if needed_by:
            context = _context(machine, layout, fidelity, samples, name, simulated.results)
            simulated.results[name] = EFFECTS[name].simulate(context)
        elapsed = (time.perf_counter() - start) * 1e3 if needed_by else 0.0
        simulated.uses[name] = EffectUse(simulated=bool(needed_by), needed_by=needed_by, time_ms=elapsed)
    return simulated


def _context(
    machine: Machine, layout: Layout, fidelity: Fidelity, angle: Real, name: str, results: Mapping[str, Any]
) -> Context:
    """Context of one effect: it sees the results of the effects that it declares, and no others."""
    needs = EFFECTS[name].needs

    def elsewhere(other: Real) -> Mapping[str, Any]:
        found: dict[str, Any] = {}
        for each in closure(machine, needs):
            found[each] = EFFECTS[each].simulate(_context(machine, layout, fidelity, other, each, found))
        return found

    given = {need: results[need] for need in needs if need in results}
    return Context(machine, layout, fidelity, angle, given, elsewhere)


def inputs_of(output: str) -> tuple[str, ...]:
    """Fields that an output reads beyond masses and geometry, each once."""
    names = effects_of(OUTPUTS[output].needs)
    return tuple(dict.fromkeys(each for name in names for each in EFFECTS[name].inputs))
