"""Inertia forces by order: phasors, without any angle."""

from collections.abc import Callable, Iterator

import numpy as np

from optimizer.effects.effect import Context, Effect
from optimizer.mechanics.inertia import Wrench, reciprocating, reciprocating_orders, rotating
from optimizer.mechanics.layout import Layout
from optimizer.mechanics.slider_crank import acceleration_harmonic, acceleration_harmonic_order_2
from optimizer.numerics.arrays import Real, any_true
from optimizer.numerics.memoization import remembered
from schemas.base.model import FieldProblem
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.scene import Fidelity

#: orders above the second that are reported; odd ones vanish for a slider-crank
HIGHER_ORDERS = (4, 6)
#: names of the effects of the rotating and of the reciprocating masses in the first order
FIRST_ORDER_EFFECTS = ("rotating_inertia", "reciprocating_inertia")
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


def second_order(layout: Layout, fidelity: Fidelity) -> Wrench:
    """Second order of the reciprocating masses over omega^2, of rows that have rods."""
    orders = _first_two(layout) if fidelity.kinematics == "exact" else None
    return reciprocating(layout, 2, harmonic(fidelity)) if orders is None else orders[1]


def _first_order(context: Context) -> Wrench:
    """The first order: of one machine with rods together with the second, which an answer shows beside it."""
    orders = _first_two(context.layout) if context.fidelity.kinematics == "exact" else None
    return reciprocating(context.layout, 1) if orders is None else orders[0]


def _higher_orders(context: Context) -> dict[int, Wrench]:
    every = reciprocating_orders(context.layout, HIGHER_ORDERS, harmonic(context.fidelity))
    return dict(zip(HIGHER_ORDERS, every, strict=True))


@remembered
def _first_two(layout: Layout) -> list[Wrench] | None:
    """Both orders of one machine, all rows of which have a rod; None of others."""
    ratio = layout.reciprocating.rod_ratio
    if ratio.ndim > 1 or any_true(np.isnan(ratio)):
        return None
    return reciprocating_orders(layout, (1, 2))


INERTIA = (
    Effect("rotating_inertia", "centrifugal forces of the rotating masses", lambda context: rotating(context.layout)),
    Effect(
        "reciprocating_inertia",
        "first-order forces of the reciprocating masses",
        _first_order,
    ),
    Effect(
        "second_order",
        "second-order forces of the reciprocating masses",
        lambda context: second_order(context.layout, context.fidelity),
        inputs=RODS,
        problems=rod_problems,
    ),
    Effect(
        "higher_orders",
        "fourth- and sixth-order forces of the reciprocating masses",
        _higher_orders,
        inputs=RODS,
        problems=rod_problems,
    ),
)
