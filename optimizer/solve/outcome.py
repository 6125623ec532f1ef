"""Counterweights that were chosen with what is proven of them, whatever was asked: for answers and rows of sweeps."""

from dataclasses import dataclass

from optimizer.formulation.simulation import Prepared
from optimizer.numerics.arrays import Complex
from optimizer.program.cuts.optimum import Found
from optimizer.solve.proof import named, physical
from schemas.answer.proof import BoundMultipliers


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


def multipliers_of(found: Found, omega_squared: float) -> BoundMultipliers:
    """Multipliers of the objective, of a program over omega^2, by their names and in their units."""
    proof = found.proof
    return named(proof.statement, physical(proof.statement, proof.multipliers, "objective", omega_squared))
