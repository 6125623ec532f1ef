"""All effects, and the simulation of just those that a scene calls for."""

import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from types import MappingProxyType
from typing import Any

import numpy as np

from optimizer.effects.dynamics import DYNAMICS
from optimizer.effects.effect import Context, Effect
from optimizer.effects.inertia import INERTIA
from optimizer.effects.scroll import SCROLL
from optimizer.mechanics.inertia import Wrench
from optimizer.mechanics.layout import Layout
from optimizer.mechanics.reading import Reading
from optimizer.numerics.arrays import Real
from optimizer.numerics.memoization import cached_property, remembered
from schemas.base.model import FieldProblem
from schemas.base.rules import Rule
from schemas.machine.machine import Machine
from schemas.request.scene import Fidelity

#: every effect; each stands after those that it needs
EFFECTS: dict[str, Effect] = {effect.name: effect for effect in (*INERTIA, *DYNAMICS, *SCROLL)}

#: fields of the use of an effect (:class:`schemas.answer.answers.EffectUse`) that did not run
_UNUSED = {"simulated": False, "needed_by": (), "time_ms": 0.0}


def closure(machine: Machine, needs: Sequence[str]) -> list[str]:
    """Effects that have to run for these, in the order in which they can; those that do not apply left out."""
    return [*_present(effects_of(needs), absent_effects(machine, needs))]


def absent_effects(machine: Machine, needs: Sequence[str]) -> frozenset[str]:
    """Effects that a machine does not have; none where every machine has these and all that they need."""
    return frozenset() if _universal(effects_of(needs)) else _every_absent(machine)


def effects_of(needs: Sequence[str]) -> tuple[str, ...]:
    """These effects and all that they need, in the order in which they can run, whatever the machine."""
    return _effects_of(tuple(needs))


@lru_cache(maxsize=256)
def _effects_of(needs: tuple[str, ...]) -> tuple[str, ...]:
    names = set(needs)
    for name in reversed(EFFECTS):
        if name in names:
            names.update(EFFECTS[name].needs)
    return tuple(name for name in EFFECTS if name in names)


@remembered
def _every_absent(machine: Machine) -> frozenset[str]:
    """Effects that a machine does not have."""
    return frozenset(name for name, effect in EFFECTS.items() if not effect.applies(machine))


@lru_cache(maxsize=256)
def _present(names: tuple[str, ...], absent: frozenset[str]) -> tuple[str, ...]:
    """These effects without those that a machine does not have."""
    return tuple(name for name in names if name not in absent)


@lru_cache(maxsize=256)
def _universal(names: tuple[str, ...]) -> bool:
    """Whether every machine has these effects."""
    return all(EFFECTS[name].universal for name in names)


def problems_of(machine: Machine, needs: Sequence[str]) -> Iterator[FieldProblem]:
    """Fields that these effects need, and all that they need, and the machine does not give."""
    problems = _problems(machine)
    for name in closure(machine, needs):
        yield from problems[name]


class _Problems(dict[str, tuple[FieldProblem, ...]]):
    """Fields that each effect by itself needs and a machine lacks, computed at the first look."""

    def __init__(self, machine: Machine) -> None:
        super().__init__()
        self._machine = machine

    def __missing__(self, name: str) -> tuple[FieldProblem, ...]:
        self[name] = tuple(EFFECTS[name].problems(self._machine))
        return self[name]


_problems = remembered(_Problems)


def rules_of(machine: Machine, name: str) -> Iterator[Rule]:
    """What one effect asks of a machine: its fields are there, and it can be simulated.

    Parameters
    ----------
    machine : its fields may hold columns (n,); a verdict is then one for all, or one for each.
    """
    if not EFFECTS[name].demanding:
        return
    for path, message in _problems(machine)[name]:
        yield Rule(True, path, message)
    if EFFECTS[name].ruled and not any(problems_of(machine, (name,))):
        yield from EFFECTS[name].rules(machine)


def inputs_of(needs: Sequence[str]) -> tuple[str, ...]:
    """Fields that these effects, and all that they need, read beyond masses and geometry, each once."""
    return tuple(dict.fromkeys(field for name in effects_of(needs) for field in EFFECTS[name].inputs))


@dataclass
class Simulated:
    """Results of effects and the use made of every effect; what is called for later is simulated then, once."""

    machine: Machine
    layout: Layout
    fidelity: Fidelity
    results: dict[str, Any]
    #: of every effect that ran
    times_ms: dict[str, float]
    needed_by: dict[str, tuple[str, ...]]

    @cached_property
    def first_order(self) -> Wrench:
        """First-order force and moment without counterweights, over omega^2."""
        rotating: Wrench = self.results["rotating_inertia"]
        return rotating.plus(self.results["reciprocating_inertia"])

    def result(self, name: str, purpose: str) -> Any:
        """Result of an effect that no sampled angle changes, for an output or another purpose."""
        if name not in self.results:
            results, times = _run(self.machine, self.layout, (name,), self.fidelity, np.zeros(1))
            self.results |= results
            self._add(times)
        self._need(closure(self.machine, (name,)), purpose)
        return self.results[name]

    def join(self, other: "Simulated", purpose: str) -> None:
        """Count the effects of another machine, such as that of a scenario, among those that ran."""
        self._add(other.times_ms)
        self._need([*other.times_ms], purpose)

    @property
    def uses(self) -> dict[str, dict[str, Any]]:
        """Every effect: whether it was simulated, for what, and how long it took, as fields."""
        return dict.fromkeys(EFFECTS, _UNUSED) | {
            name: {"simulated": True, "needed_by": self.needed_by[name], "time_ms": time_ms}
            for name, time_ms in self.times_ms.items()
        }

    def _add(self, times: Mapping[str, float]) -> None:
        for name, time_ms in times.items():
            self.times_ms[name] = self.times_ms.get(name, 0.0) + time_ms

    def _need(self, names: Sequence[str], purpose: str) -> None:
        for name in names:
            purposes = self.needed_by.get(name, ())
            self.needed_by[name] = purposes if purpose in purposes else (*purposes, purpose)


def simulate(
    machine: Machine,
    layout: Layout,
    demands: Mapping[str, Sequence[str]],
    fidelity: Fidelity,
    angle: Real | None = None,
    results: Mapping[str, Any] = MappingProxyType({}),
    readings: tuple[Reading, ...] = (),
) -> Simulated:
    """Run the effects that the outputs call for, each once, and no others.

    Parameters
    ----------
    layout : of the machine; its leading axes (...) are those of all results.
    demands : outputs and other purposes by name, with the effects that each needs.
    angle : (T,) rad, shaft angles of the samples; needed only by sampled effects.
    results : of effects that need not run, by name.
    readings : of the forces of many designs over the turn, that columns will need.
    """
    samples = np.zeros(0) if angle is None else angle
    effects = tuple(need for needs in demands.values() for need in needs)
    figures, times = _run(machine, layout, effects, fidelity, samples, results, readings)
    purposes = tuple((purpose, tuple(needs)) for purpose, needs in demands.items())
    users = _users(purposes, absent_effects(machine, effects))
    return Simulated(machine, layout, fidelity, figures, times, users.copy())


@lru_cache(maxsize=256)
def _users(purposes: tuple[tuple[str, tuple[str, ...]], ...], absent: frozenset[str]) -> dict[str, tuple[str, ...]]:
    """Effects that run for outputs and other purposes, each with those of these for which it does."""
    users: dict[str, tuple[str, ...]] = {}
    for purpose, needs in purposes:
        for name in _present(effects_of(needs), absent):
            users[name] = (*users.get(name, ()), purpose)
    return users


def run(machine: Machine, layout: Layout, needs: Sequence[str], fidelity: Fidelity, angle: Real) -> dict[str, Any]:
    """Results of these effects, by name, at shaft angles (..., T) rad."""
    return _run(machine, layout, needs, fidelity, angle)[0]


def _run(
    machine: Machine,
    layout: Layout,
    needs: Sequence[str],
    fidelity: Fidelity,
    angle: Real,
    results: Mapping[str, Any] = MappingProxyType({}),
    readings: tuple[Reading, ...] = (),
) -> tuple[dict[str, Any], dict[str, float]]:
    """Results of these effects, and the milliseconds of each that ran; what only others need is let go after its use.

    A result over the turn of many designs is large, and memory that is used again is quicker than new memory.
    """
    figures: dict[str, Any] = {}
    times: dict[str, float] = {}
    for name, releases in _plan(tuple(closure(machine, needs)), tuple(needs)):
        effect, start = EFFECTS[name], time.perf_counter()
        # an effect sees the results of those that it declares, and no others
        visible = {need: figures[need] for need in effect.needs if need in figures} if effect.needs else {}
        context = Context(machine, layout, fidelity, angle, visible, needs, readings)
        figures[name] = results[name] if name in results else effect.simulate(context)
        times[name] = (time.perf_counter() - start) * 1e3
        for need in releases:
            # what does not apply was never there
            figures.pop(need, None)
    return figures, times


@lru_cache(maxsize=256)
def _plan(names: tuple[str, ...], needs: tuple[str, ...]) -> tuple[tuple[str, tuple[str, ...]], ...]:
    """Effects in the order in which they run, each with those whose results are let go after it."""
    last = {need: name for name in names for need in (*EFFECTS[name].needs, name)}
    return tuple(
        (name, tuple(need for need, user in last.items() if user == name and need not in needs)) for name in names
    )
