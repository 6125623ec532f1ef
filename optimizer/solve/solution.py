"""Counterweights with the proof of every claim about them, for answers and rows of sweeps."""

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, NamedTuple

from optimizer.formulation.balance_shafts import Fitted
from optimizer.formulation.simulation import Prepared
from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record
from optimizer.program.certificate import Multipliers as MultipliersOfProgram
from optimizer.program.certificate import nothing_proven
from optimizer.program.cuts.optimum import CertifiedOptimum
from optimizer.program.cuts.proof import Proof
from optimizer.solve.proof import (
    Bounded,
    PhysicalMultipliers,
    Speeds,
    fields_by_name,
    implied_max_mass,
    physical,
    physical_bounds,
)
from schemas.answer.answers import Certificate, GoalReached
from schemas.answer.infeasibility import Infeasibility
from schemas.answer.proof import BoundMultipliers
from schemas.machine.machine import Machine


@record(frozen=True)
class Solution:
    """Counterweights as they are fitted, and what is proven of them."""

    status: str
    reason: str
    mass: Real  # (K + S,) kg, of the free webs, those of balance shafts behind those of the crankshaft
    angle: Real  # (K + S,) degrees
    unbalance: Complex  # (K + S,) kg m
    placement: Fitted
    certificate: Certificate
    fields: dict[str, object]  # of the answer beside these
    certify_s: float  # time spent on bounds
    method: str  # of the search and of the proof
    nodes: int  # of the tree behind it; 0 where there is none
    report_s: float  # of the time, that spent on the fields
    cut: Prepared | None = None  # the scene with the radii of what is cut from plates; None where nothing is

    @property
    def answer(self) -> dict[str, object]:
        """All fields of the answer."""
        return {**self.placement.fields, "certificate": self.certificate, **self.fields}

    def certain(self) -> "Solution":
        """This one, where there has to be one."""
        return self


@record(frozen=True)
class Infeasible:
    """The proof that no counterweights, or no choices, keep the ceilings."""

    status: str
    reason: str
    infeasibility: Infeasibility
    certify_s: float
    method: str
    nodes: int = 0
    cut: Prepared | None = None

    @property
    def answer(self) -> dict[str, object]:
        """All fields of the answer."""
        nothing = {"counterweights": (), "total_mass_kg": None, "certificate": None}
        return nothing | {"infeasibility": self.infeasibility}

    def certain(self) -> Solution:
        """Nothing, where there has to be a solution.

        Raises
        ------
        ArithmeticError
            whatever it is: the proof contradicts that there is no ceiling.
        """
        raise ArithmeticError(f"{self.reason} There is no ceiling.")


def multipliers_of(proof: Proof, omega_squared: float, speeds: Speeds) -> BoundMultipliers:
    """Multipliers of a bound of the objective, of a program over omega^2, by their names and in their units.

    Parameters
    ----------
    speeds : omega^2 by scenario, that ceilings are over.
    """
    in_units = physical(proof.with_pieces, proof.multipliers, "objective", omega_squared, speeds)
    return BoundMultipliers.model_validate(_fields_of(proof, in_units))


class Proofs(NamedTuple):
    """Multipliers of both bounds of one problem in their units, of the statements by which they were proven."""

    objective: PhysicalMultipliers
    mass: PhysicalMultipliers | None  # None where the least mass was not sought

    @classmethod
    def of(cls, optimum: CertifiedOptimum, omega_squared: float, speeds: Speeds) -> "Proofs":
        """Proofs of an optimum.

        Parameters
        ----------
        speeds : omega^2 by scenario, that ceilings are over.
        """
        proof, of_mass = optimum.proof, optimum.mass_proof
        if of_mass is not None and of_mass.bound <= 0.0:
            # that no mass is below 0 needs no multipliers, and those that were sought may be beyond all numbers
            of_mass = replace(of_mass, multipliers=nothing_proven(of_mass.statement))
        if of_mass is not None and of_mass.statement is proof.statement and of_mass.laid is proof.laid:
            bounds: dict[Bounded, MultipliersOfProgram] = {"objective": proof.multipliers, "mass": of_mass.multipliers}
            return cls(*physical_bounds(proof.with_pieces, bounds, omega_squared, speeds))
        in_units = physical(proof.with_pieces, proof.multipliers, "objective", omega_squared, speeds)
        if of_mass is None:
            return cls(in_units, None)
        return cls(in_units, physical(of_mass.with_pieces, of_mass.multipliers, "mass", omega_squared, speeds))

    def by_name(self, optimum: CertifiedOptimum) -> dict[str, Any]:
        """Fields of :class:`schemas.answer.proof.Multipliers`, as an answer prints them."""
        of_mass = None
        if self.mass is not None and optimum.mass_proof is not None:
            of_mass = _fields_of(optimum.mass_proof, self.mass)
        return {"objective": _fields_of(optimum.proof, self.objective), "mass": of_mass}


def _fields_of(proof: Proof, in_units: PhysicalMultipliers) -> dict[str, Any]:
    return fields_by_name(proof.statement, in_units.of_groups(proof.statement, proof.scale))


def certificate(
    figures: Mapping[str, Real | float | str | None],
    machine: Machine,
    most: Real,
    multipliers: Mapping[str, Any],
    goals: tuple[GoalReached, ...] = (),
) -> Certificate:
    """What an answer prints of proofs.

    Parameters
    ----------
    figures : of one design, by the fields of a certificate; what is not finite is null.
    most : (K,) kg, largest masses that the proofs count with.
    multipliers : as of :meth:`Proofs.by_name`.
    """
    return Certificate.of_figures(
        {name: value if isinstance(value, str) else finite_or_null(value) for name, value in figures.items()}
        | {
            "implied_max_mass_kg": implied_max_mass(machine, most[None])[0],
            "multipliers": multipliers,
            "goals": goals,
        }
    )


def finite_or_null(value: Real | float | None) -> float | None:
    """A figure, null where nothing is proven."""
    return None if value is None or not math.isfinite(value) else float(value)
