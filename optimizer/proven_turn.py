"""Counterweights over the turn with what is proven of them, for answers and for rows of sweeps."""

from dataclasses import dataclass

from optimizer.arrays import Complex
from optimizer.figures.proof import named, physical
from optimizer.program.cuts import Found
from schemas.proof import BoundMultipliers


@dataclass(frozen=True)
class CertifiedTurn:
    """Counterweights as they are fitted, and the fields of the answer that tell what is proven of them."""

    status: str
    reason: str
    unbalance: Complex | None  # (K,) kg m; None where the ceilings are out of reach
    chosen: Complex | None  # (K + S,) kg m, without the weights that are fixed
    shafts: Complex | None  # (S,) kg m, of the balance shafts; None where there are none to show
    certify_s: float  # time spent on bounds
    fields: dict[str, object]


def multipliers_of(found: Found, omega_squared: float) -> BoundMultipliers:
    """Multipliers of the objective, of a program over omega^2, by their names and in their units."""
    proof = found.proof
    return named(proof.statement, physical(proof.statement, proof.multipliers, "objective", omega_squared))
