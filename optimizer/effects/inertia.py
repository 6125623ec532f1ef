"""Inertia forces by order: phasors, without any angle."""

from collections.abc import Callable, Iterator

from optimizer.effects.effect import Effect
from optimizer.mechanics.inertia import reciprocating, rotating
from optimizer.mechanics.slider_crank import acceleration_harmonic, acceleration_harmonic_order_2
from optimizer.numerics.arrays import Real
from schemas.base.model import FieldProblem
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.scene import Fidelity

#: orders above the second that are reported; odd ones vanish for a slider-crank
HIGHER_ORDERS = (4, 6)
RODS = ("machine.throws.rows.connecting_rod",)


def rod_problems(machine: Machine) -> Iterator[FieldProblem]:
    """Rows without a connecting rod."""
    if isinstance(machine, ReciprocatingMachine):
        for t, throw in enumerate(machine.throws):
            for i, row in enumerate(throw.rows):
                if row.connecting_rod is None:
                    yield FieldProblem(("throws", t, "rows", i, "connecting_rod"), "the motion needs the rod")


def harmonic(fidelity: Fidelity) -> Callable[[int, Real], Real]:
    """Harmonics of the acceleration, by order and rod ratio."""
    return acceleration_harmonic if fidelity.kinematics == "exact" else acceleration_harmonic_order_2


INERTIA = (
    Effect("rotating_inertia", "centrifugal forces of the rotating masses", lambda context: rotating(context.layout)),
    Effect(
        "reciprocating_inertia",
        "first-order forces of the reciprocating masses",
        lambda context: reciprocating(context.layout, 1),
    ),
    Effect(
        "second_order",
        "second-order forces of the reciprocating masses",
        lambda context: reciprocating(context.layout, 2, harmonic(context.fidelity)),
        inputs=RODS,
        problems=rod_problems,
    ),
    Effect(
        "higher_orders",
        "fourth- and sixth-order forces of the reciprocating masses",
        lambda context: {
            order: reciprocating(context.layout, order, harmonic(context.fidelity)) for order in HIGHER_ORDERS
        },
        inputs=RODS,
        problems=rod_problems,
    ),
)
