"""Counterweights that were chosen with what is proven of them, whatever was asked: for answers and rows of sweeps."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from optimizer.formulation.simulation import Prepared
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.cuts.proof import Proof
from optimizer.solve.proof import Bounded, Speeds, implied_max_mass, named, physical
from schemas.answer.answers import Certificate, GoalReached
from schemas.answer.proof import BoundMultipliers, Multipliers
from schemas.machine.machine import Machine


@dataclass(frozen=True)
class Outcome:
    """Counterweights as they are fitted, and the fields of the answer that tell what is proven of them."""

    status: str
    reason: str
    unbalance: Complex | None  # (K,) kg m; None where the ceilings are out of reach
    chosen: Complex | None  # (K + S,) kg m, without the weights that are fixed
    shafts: Complex | None  # (S,) kg m, of the balance shafts; None where there are none to show
    certify_s: float  # time spent on bounds
    method: str  # by which that was found and proven
    nodes: int  # of the tree behind it; 0 where there is none
    fields: dict[str, object]
    cut: Prepared | None = None  # the scene with the radii of what is cut from plates; None where nothing is
    report_s: float = 0.0  # of the time, that spent on the fields


def multipliers_of(
    proof: Proof, omega_squared: float, speeds: Speeds, bounded: Bounded = "objective"
) -> BoundMultipliers:
    """Multipliers of a bound, of a program over omega^2, by their names and in their units.

    Parameters
    ----------
    speeds : omega^2 by scenario, that ceilings are over.
    """
    scaled = physical(proof.with_pieces, proof.multipliers, bounded, omega_squared, speeds)
    return named(proof.statement, scaled.of_groups(proof.statement, proof.scale))


def certificate(
    figures: Mapping[str, Real | float | str | None],
    machine: Machine,
    most: Real,
    multipliers: Multipliers,
    goals: tuple[GoalReached, ...] = (),
) -> Certificate:
    """What an answer prints of proofs.

    Parameters
    ----------
    figures : of one design, by the fields of a certificate; what is not finite is null.
    most : (K,) kg, largest masses that the proofs count with.
    """
    return Certificate.model_validate(
        {name: value if isinstance(value, str) else finite_or_null(value) for name, value in figures.items()}
        | {
            "implied_max_mass_kg": implied_max_mass(machine, most[None])[0],
            "multipliers": multipliers,
            "goals": goals,
        }
    )


def finite_or_null(value: Real | float | None) -> float | None:
    """A figure, null where nothing is proven."""
    return float(value) if value is not None and math.isfinite(value) else None
