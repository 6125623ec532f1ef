"""Which output needs which effect needs which input: only what a scene calls for is simulated."""

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from optimizer.errors import MissingInput
from optimizer.mechanics.inertia import Wrench, reciprocating, rotating
from optimizer.mechanics.layout import Layout
from optimizer.mechanics.slider_crank import acceleration_harmonic, acceleration_harmonic_order_2
from optimizer.response import Real
from schemas.answers import EffectUse
from schemas.base import FieldProblem
from schemas.machine import Machine, ReciprocatingMachine
from schemas.requests import Fidelity

#: orders above the second that are reported; odd ones vanish for a slider-crank
HIGHER_ORDERS = (4, 6)


def _harmonic(fidelity: Fidelity) -> Callable[[int, Real], Real]:
    """Harmonics of the slider-crank at the fidelity asked for."""
    return acceleration_harmonic if fidelity.kinematics == "exact" else acceleration_harmonic_order_2


def _nothing(_machine: Machine) -> Iterator[tuple[str | int, ...]]:
    return iter(())


def _rods(machine: Machine) -> Iterator[tuple[str | int, ...]]:
    if isinstance(machine, ReciprocatingMachine):
        for t, throw in enumerate(machine.throws):
            for i, row in enumerate(throw.rows):
                if row.connecting_rod is None:
                    yield ("machine", "throws", t, "rows", i, "connecting_rod")


@dataclass(frozen=True)
class Effect:
    """A physical effect: what it means, which inputs it misses in a machine, how it is simulated."""

    name: str
    meaning: str
    simulate: Callable[[Layout, Fidelity], Any]
    missing: Callable[[Machine], Iterator[tuple[str | int, ...]]] = _nothing


def _rotating(layout: Layout, _fidelity: Fidelity) -> Wrench:
    return rotating(layout)


def _first_order(layout: Layout, _fidelity: Fidelity) -> Wrench:
    return reciprocating(layout, 1)


def _second_order(layout: Layout, fidelity: Fidelity) -> Wrench:
    return reciprocating(layout, 2, _harmonic(fidelity))


def _higher_orders(layout: Layout, fidelity: Fidelity) -> dict[int, Wrench]:
    return {order: reciprocating(layout, order, _harmonic(fidelity)) for order in HIGHER_ORDERS}


EFFECTS: Mapping[str, Effect] = {
    effect.name: effect
    for effect in (
        Effect("rotating_inertia", "centrifugal forces of the rotating masses", _rotating),
        Effect("reciprocating_inertia", "first-order forces of the reciprocating masses", _first_order),
        Effect("second_order", "second-order forces of the reciprocating masses", _second_order, missing=_rods),
        Effect(
            "higher_orders",
            "fourth- and sixth-order forces of the reciprocating masses",
            _higher_orders,
            missing=_rods,
        ),
    )
}

_FIRST_ORDER = ("rotating_inertia", "reciprocating_inertia")

#: output -> effects that it needs, in the order in which they run
OUTPUTS: Mapping[str, Sequence[str]] = {
    "residual": _FIRST_ORDER,
    "hodograph": _FIRST_ORDER,
    "orders": (*_FIRST_ORDER, "second_order", "higher_orders"),
    "stages": (*_FIRST_ORDER, "second_order"),
}


@dataclass
class Simulated:
    """Results of the effects that ran, by name, and the use made of every effect."""

    results: dict[str, Any] = field(default_factory=dict)
    uses: dict[str, EffectUse] = field(default_factory=dict)

    @property
    def first_order(self) -> Wrench:
        """First-order force and moment without counterweights, over omega^2."""
        rotating_part: Wrench = self.results["rotating_inertia"]
        return rotating_part.plus(self.results["reciprocating_inertia"])


def require_inputs(machine: Machine, outputs: Sequence[str]) -> None:
    """Check that the machine gives what the outputs need.

    Raises
    ------
    MissingInput
        naming every missing field and an output that needs it.
    """
    problems: dict[tuple[str | int, ...], FieldProblem] = {}
    for output in outputs:
        for name in OUTPUTS[output]:
            for path in EFFECTS[name].missing(machine):
                message = f"output '{output}' needs this field (effect '{name}')"
                problems.setdefault(path, FieldProblem(path, message))
    if problems:
        raise MissingInput(problems.values())


def simulate(layout: Layout, outputs: Sequence[str], fidelity: Fidelity) -> Simulated:
    """Run the effects that the outputs call for, each once, and no others."""
    simulated = Simulated()
    for name, effect in EFFECTS.items():
        needed_by = tuple(output for output in outputs if name in OUTPUTS[output])
        start = time.perf_counter()
        if needed_by:
            simulated.results[name] = effect.simulate(layout, fidelity)
        elapsed = (time.perf_counter() - start) * 1e3 if needed_by else 0.0
        simulated.uses[name] = EffectUse(simulated=bool(needed_by), needed_by=needed_by, time_ms=elapsed)
    return simulated
