"""Programs as compiled loops take them, and what those loops are asked.

An answer asks for a handful of numbers many times: a loop of simple operations takes a tenth of the time of arrays.
"""

import math
from dataclasses import dataclass

import numpy as np

from optimizer.numerics.arrays import Complex, Real, in_order
from optimizer.numerics.records import record
from optimizer.program.ceilings import Ceilings
from optimizer.program.limits import Limits
from optimizer.program.norms import Norms


@record
@dataclass(frozen=True)
class Flat:
    """N programs in the usual order in memory: one group, real influences, webs that carry what they like."""

    leading: tuple[int, ...]  # axes of the programs, of which one is made here
    owner: np.ndarray  # (J,) row of a term
    constant: Complex  # (N, J + I) of the terms, then of what is under ceilings
    influence: Real  # (N, J + I, K)
    floor: Real  # (N, rows)
    cap: Real  # (N, I)
    counted: Real  # (N, I) cap up to which a ceiling counts as kept
    size: Real  # (N, I)
    radius: Real  # (N, K)
    max_mass: Real  # (N, K)
    budget: Real  # (N,)
    free: np.ndarray  # (N, K) bool
    centre: Complex  # (N, K)
    cosine: Real  # (N, K)
    sine: Real  # (N, K)

    def suits(self, leading: tuple[int, ...]) -> bool:
        """Whether what has these axes is a number of points, or of proofs, for each of the programs."""
        return leading[len(leading) - len(self.leading) :] == self.leading

    def values(self, u: Complex) -> Real:
        """What points (..., *leading, K) come to (4, ..., *leading).

        Objective, mass, largest relative excess over a ceiling (-inf without ceilings), rounding of the objective.
        """
        # the compiler is loaded when it is first needed
        from optimizer.program.kernel.values import values

        *leading, webs = u.shape
        found = np.empty((4, math.prod(leading)))
        values(
            in_order(u).reshape(-1, webs),
            self.owner,
            self.constant,
            self.influence,
            self.floor,
            self.cap,
            self.size,
            self.radius,
            np.empty(self.floor.shape[1]),
            found,
        )
        return found.reshape(4, *leading)

    def bounds(self, term: Complex, row: Real, ceiling: Complex, target: Real | None = None) -> tuple[Real, np.ndarray]:
        """Lower bounds (..., *leading) on the objective, or on the mass, and which call for finer numbers.

        Parameters
        ----------
        term, row, ceiling : the multipliers that prove them.
        target : leading axes; largest objective that counts, for a bound on the mass.
        """
        from optimizer.program.kernel.bounds import bounds

        leading = row.shape[:-1]
        many, (rows, terms, webs) = math.prod(leading), (self.floor.shape[1], *self.influence.shape[1:])
        found, dear = np.empty(many), np.empty(many, np.bool_)
        bounds(
            0.0 if target is None else 1.0,
            self.budget if target is None else in_order(target).reshape(-1),
            self.cap if target is None else self.counted,
            in_order(term).reshape(many, -1),
            in_order(row).reshape(many, -1),
            in_order(ceiling).reshape(many, terms - self.owner.size),
            self.owner,
            self.constant,
            self.influence,
            self.floor,
            self.radius,
            self.max_mass,
            self.budget,
            self.free,
            self.centre,
            self.cosine,
            self.sine,
            np.empty(rows),
            np.empty(terms, complex),
            np.empty((2, webs)),
            np.empty((2, webs), np.int64),
            found,
            dear,
        )
        return found.reshape(leading), dear.reshape(leading)

    def into(self, u: Complex) -> Complex:
        """Unbalances (..., *leading, K) within all limits, close to those that are nearly so."""
        from optimizer.program.kernel.settling import bring

        found = np.array(u, order="C")
        bring(
            found.reshape(-1, u.shape[-1]),
            self.radius,
            self.max_mass,
            self.budget,
            self.free,
            self.centre,
            self.cosine,
            self.sine,
        )
        return found

    def settle(self, u: Complex, points: Real, target: Real, heaviest: Real, rounding: float, rungs: Real) -> None:
        """Points (*leading, K) without dust and at the limits that they touch, and what they come to, in place.

        As :func:`optimizer.program.kernel.settling.settle`.
        """
        from optimizer.program.kernel.settling import settle

        many, terms, webs = self.influence.shape
        settle(
            u.reshape(many, webs),
            points.reshape(4, many),
            in_order(target).reshape(many),
            in_order(heaviest).reshape(many),
            rounding,
            rungs,
            self.owner,
            self.constant,
            self.influence,
            self.floor,
            self.cap,
            self.size,
            self.radius,
            self.max_mass,
            self.budget,
            self.free,
            self.centre,
            self.cosine,
            self.sine,
            np.empty(self.floor.shape[1]),
            np.empty(webs),
            np.empty((4, max(terms, webs)), complex),
            np.empty((2, terms, webs), complex),
        )


def flat(
    norms: Norms,
    row: np.ndarray,
    floor: Real,
    ceilings: Ceilings,
    limits: Limits,
    constant: Complex,
    influence: Real | Complex,
) -> Flat | None:
    """Programs of one group as loops take them; None where some are not of the kind that they are for.

    Parameters
    ----------
    constant, influence : (..., J + I) and (..., J + I, K) of the terms of the objective, then of the ceilings.
    """
    leading = floor.shape[:-1]
    if limits.alike is not None or influence.dtype != float or not influence.size:
        return None
    if norms.scatter or ceilings.norms.scatter or any(norms.scalar) or any(ceilings.norms.scalar):
        return None
    if limits.radius.shape[:-1] != leading:
        return None
    many, webs = math.prod(leading), influence.shape[-1]
    kept = ceilings.counted if ceilings.names else ceilings.cap

    def of_programs(array: np.ndarray) -> np.ndarray:
        return in_order(array).reshape(many, -1) if array.size else np.empty((many, 0), array.dtype)

    return Flat(
        leading=leading,
        owner=in_order(row),
        constant=of_programs(constant),
        influence=in_order(influence).reshape(many, -1, webs),
        floor=of_programs(floor),
        cap=of_programs(ceilings.cap),
        counted=of_programs(kept),
        size=of_programs(ceilings.size),
        radius=of_programs(limits.radius),
        max_mass=of_programs(limits.max_mass),
        budget=in_order(limits.max_total_mass).reshape(many),
        free=of_programs(limits.free),
        centre=of_programs(limits.centre),
        cosine=of_programs(limits.half_angle_cos),
        sine=of_programs(limits.half_angle_sin),
    )
