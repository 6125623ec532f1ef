"""What a request with balance shafts chooses: counterweights on the crankshaft and, behind them, those on the shafts.

The program gets one machine with all these webs. It is affine in the unbalance of a shaft that turns backwards only
beside its mirror image at the x axis (:class:`optimizer.responses.response.Response`). So there the web of such a shaft
stands for the mirror image. Over all orders nothing is mirrored (:class:`optimizer.responses.curve.TurnResponse`).
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from optimizer.formulation.counterweights import counterweights, unbalance, unbalances_of_shaft
from optimizer.formulation.formulate import with_weights_of
from optimizer.mechanics.fixed_weights import any_fixed, beside
from optimizer.mechanics.layout import stacked
from optimizer.numerics.arrays import Complex, Real
from schemas.answer.counterweights import Counterweight, FittedShaft, every_counterweight
from schemas.answer.limits import MachineLimit, WebLimit
from schemas.base.rules import Path
from schemas.base.variation import with_fields
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import BalanceShaft, balance_shafts
from schemas.machine.webs import Web
from schemas.request.objective import Objective

_TURNS = {1: "at its speed", 2: "at twice its speed"}


class DesignSpace(NamedTuple):
    """All that a program chooses: a machine with the webs of its balance shafts behind its own, and its objective."""

    machine: Machine
    objective: Objective


def design_space(machine: Machine, objective: Objective) -> DesignSpace:
    """What a program chooses of a machine."""
    shafts = balance_shafts(machine)
    if not shafts:
        return DesignSpace(machine, objective)
    mirrored = objective.orders == "first"
    webs = (_mirrored(web) if mirrored and shaft.speed_ratio == -1 else web for shaft in shafts for web in shaft.webs)
    # default weights count throws and webs of the crankshaft alone
    return DesignSpace(with_fields(machine, {("webs",): (*machine.webs, *webs)}), with_weights_of(machine, objective))


def _mirrored(web: Web) -> Web:
    return web if web.sector is None else with_fields(web, {("sector", "centre_deg"): -web.sector.centre_deg})


def with_shaft_webs(machine: Machine) -> Machine:
    """A machine with the webs of its balance shafts behind its own, none of them mirrored."""
    return with_fields(machine, {("webs",): machine.every_web}) if balance_shafts(machine) else machine


def web_paths(machine: Machine) -> list[Path]:
    """Where all webs stand in a machine, those of its balance shafts behind those of the crankshaft."""
    return [(*path, k) for path, webs in machine.web_lists() for k in range(len(webs))]


class Fitted(NamedTuple):
    """Counterweights of the crankshaft, and unbalances of the balance shafts, as they are drawn."""

    counterweights: tuple[Counterweight, ...]
    total_mass_kg: float
    balance_shafts: tuple[FittedShaft, ...]
    on_crank: Complex  # (K,) kg m
    on_shafts: Complex | None  # (S,) kg m; None without balance shafts

    @property
    def unbalance(self) -> Complex:
        """Of all of them (K + S,) kg m."""
        return self.on_crank if self.on_shafts is None else np.concatenate([self.on_crank, self.on_shafts])

    @property
    def mass_kg(self) -> float:
        """Of all of them."""
        return self.total_mass_kg + sum(shaft.total_mass_kg for shaft in self.balance_shafts)

    @property
    def every_weight(self) -> tuple[Counterweight, ...]:
        """Those on the balance shafts behind those of the crankshaft."""
        return every_counterweight(self)

    def active_limits(
        self, of_machine: tuple[MachineLimit, ...]
    ) -> dict[str | None, tuple[WebLimit | MachineLimit, ...]]:
        """Limits that are touched on each web, and by None those of the machine."""
        return {None: of_machine} | {weight.web: weight.active_limits for weight in self.every_weight}

    @property
    def fields(self) -> dict[str, object]:
        """Of an answer that has them."""
        of_shafts = float(sum(shaft.total_mass_kg for shaft in self.balance_shafts)) if self.balance_shafts else None
        return {
            "counterweights": self.counterweights,
            "total_mass_kg": self.total_mass_kg,
            "balance_shafts": self.balance_shafts,
            "balance_shafts_mass_kg": of_shafts,
        }


def placement_of(
    machine: Machine, objective: Objective, mass_kg: Real, angle_deg: Real, vectors: Complex | None = None
) -> Fitted:
    """Counterweights from the variables of a program, shaft by shaft, beside the weights that are fixed.

    Parameters
    ----------
    mass_kg, angle_deg : (K + S,) of the webs of :func:`design_space`.
    vectors : (K + S,) kg m, their unbalances, if at hand.
    """
    if not balance_shafts(machine) and not any_fixed(machine):
        return fitted(machine, mass_kg, angle_deg, vectors)
    return fitted(machine, *in_drawing(machine, objective, mass_kg, angle_deg))


def in_drawing(machine: Machine, objective: Objective, mass_kg: Real, angle_deg: Real) -> tuple[Real, Real]:
    """Masses [kg] and angles [deg] of all webs (..., K + S) as they are drawn, with the fixed weights in their places.

    Parameters
    ----------
    mass_kg, angle_deg : (..., K + S) of a program's solution, of the webs of :func:`design_space`.
    """
    mass_kg, angle_deg = beside(machine, mass_kg, angle_deg)
    if not balance_shafts(machine):
        return mass_kg, angle_deg
    angle = np.where(mirror_images(machine, objective), np.mod(-angle_deg, 360.0), angle_deg)
    return mass_kg, np.mod(angle, 360.0)


def in_program(machine: Machine, objective: Objective, unbalance: Complex) -> Complex:
    """What a program has for unbalances of all webs (..., K + S) kg m as they are drawn."""
    if not balance_shafts(machine):
        return unbalance
    return np.where(mirror_images(machine, objective), np.conj(unbalance), unbalance)


def mirror_images(machine: Machine, objective: Objective) -> np.ndarray:
    """Whether a web stands for the mirror image of what is drawn (K + S,) bool."""
    ratio = [shaft.speed_ratio for shaft in balance_shafts(machine) for _ in shaft.webs]
    # over all orders nothing is mirrored
    mirrored = -1 if objective.orders == "first" else 0
    return np.array([1] * len(machine.webs) + ratio) == mirrored


def fitted(machine: Machine, mass_kg: Real, angle_deg: Real, vectors: Complex | None = None) -> Fitted:
    """Masses and angles (K + S,), as drawn, of all webs of a machine and of its balance shafts.

    Parameters
    ----------
    vectors : (K + S,) kg m, their unbalances, if at hand.
    """
    own, shafts = len(machine.webs), balance_shafts(machine)
    if vectors is None:
        vectors = unbalance(mass_kg, angle_deg, stacked([web.radius_m for web in machine.every_web]))
    results, first = [], own
    for shaft in shafts:
        there = slice(first, first + len(shaft.webs))
        first = there.stop
        on_shaft = unbalances_of_shaft(machine, shaft, mass_kg[there], angle_deg[there])
        results.append(
            FittedShaft(
                name=shaft.name,
                speed_ratio=shaft.speed_ratio,
                gearing=_gearing(shaft, on_shaft),
                total_mass_kg=float(np.sum(mass_kg[there])),
                counterweights=on_shaft,
            )
        )
    crank = counterweights(machine, mass_kg[:own], angle_deg[:own], vectors[:own])
    return Fitted(
        crank, float(np.add.reduce(mass_kg[:own])), tuple(results), vectors[:own], vectors[own:] if shafts else None
    )


def _gearing(shaft: BalanceShaft, fitted_there: Sequence[Counterweight]) -> str:
    """Which way a shaft turns, how fast, and how its unbalances stand when the crankshaft is as drawn."""
    way = "with" if shaft.speed_ratio > 0 else "against"
    there = [weight for weight in fitted_there if weight.mass_kg > 0]
    stand = ", ".join(f"{weight.web} at {weight.angle_deg:.2f} deg" for weight in there) or "it carries nothing"
    return f"Turns {way} the crankshaft {_TURNS[abs(shaft.speed_ratio)]}; at shaft angle 0 {stand}."
