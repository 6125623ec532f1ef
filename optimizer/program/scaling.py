"""From physical units to a program of order one, and back.

What each step repairs (docs/mathematics.md section 4): terms divided by their size without
counterweights (lopsided weights, nearly balanced machines), columns in units of each web's reach
(limits of all sizes side by side), reaches clipped where they cannot matter (limits of 1e12),
sectors as cuts in sine and cosine (half-angles near 90 degrees and near 0).
"""

import math
from dataclasses import replace
from functools import cache
from types import ModuleType

import numpy as np

from optimizer.numerics.arrays import Complex, Real, in_order
from optimizer.numerics.records import record
from optimizer.program.certificate import Multipliers
from optimizer.program.norms import Norms
from optimizer.program.scaled_program import ScaledData, ScaledSolution, Shape, Stage
from optimizer.program.statement import Statement


@record(frozen=True)
class Scaling:
    """Units of one program: u_k = reach_k e^{j c_k} (x_k + j sine_k y_k)."""

    objective: float  # unit of the objective
    reach: Real  # (K,) unit of each web, kg m
    value: float  # unit of what is minimised: the objective's, or kg in stage "mass"

    def unbalance(self, statement: Statement, solution: ScaledSolution) -> Complex:
        """Unbalance of a scaled solution, kg m (K,)."""
        limits = statement.limits
        if limits.alike is None:
            return self.reach * limits.centre * (solution.x + 1j * limits.half_angle_sin * solution.y)
        first = limits.alike.first
        place = solution.x + 1j * limits.half_angle_sin[first] * solution.y
        return limits.alike.carried(self.reach[first] * limits.centre[first] * place)

    def multipliers(self, statement: Statement, solution: ScaledSolution) -> Multipliers:
        """Multipliers in units of what is minimised per unit of objective or response."""
        per_objective = self.value / self.objective
        return Multipliers(
            term=solution.term * per_objective,
            row=solution.row * per_objective,
            ceiling=solution.ceiling * self.value / statement.ceilings.size,
        )


def natural_reach(statement: Statement) -> Real:
    """Size of the unbalance that cancels every term by the least change, kg m (...).

    Far larger counterweights are useless; limits beyond a multiple of it are as good as none.
    """
    return np.maximum(np.maximum.reduce(np.abs(cancelling(statement)), axis=-1, initial=0.0), statement.single_reach)


def cancelling(statement: Statement, passes: int = 1) -> Complex:
    """The least unbalance that cancels the terms and what the ceilings limit, as far as they allow it together.

    Parameters
    ----------
    passes : three are exact to rounding also where webs have almost equal influence.

    Returns
    -------
    (..., K) kg m, whatever the limits.
    """
    return least_change(statement.every_influence, statement.every_constant, passes)


def least_change(influence: Real | Complex, constant: Real | Complex, passes: int) -> Complex:
    """The least u (..., K) for which constant (..., J) + influence (..., J, K) u is 0, as far as it can be.

    One row after the other, each by the least change that leaves those before it alone.

    Parameters
    ----------
    passes : three are exact to rounding also where rows hardly differ.
    """
    *leading, terms, webs = influence.shape
    shape = (math.prod(leading), terms, webs)
    constants = in_order(np.asarray(constant, complex)).reshape(shape[:-1])
    changes = np.zeros((shape[0], webs), complex)
    loops, is_complex = _cancelling(), influence.dtype.kind == "c"
    loop, kind = (loops.least_changes, complex) if is_complex else (loops.least_changes_of_real, float)
    row, basis = np.empty(webs, kind), np.empty((terms, webs), kind)
    loop(in_order(influence).reshape(shape), constants, passes, row, basis, changes)
    return changes.reshape(*leading, webs)


def scale(
    statement: Statement,
    stage: Stage,
    clip: float,
    margin: float = 0.0,
    target: float = 0.0,
    mass_unit: float = 1.0,
    unit: float | None = None,
) -> tuple[ScaledData, Scaling]:
    """The scaled program of a statement.

    Parameters
    ----------
    clip : largest reach worth considering, kg m.
    margin : ceilings are lowered by this share of their size, so that the answer keeps them.
    target : stage "mass": largest objective allowed, in units of the objective.
    mass_unit : stage "mass": a mass of the size of the answer, kg.
    unit : of the objective; by default the sum of its terms without counterweights.
    """
    limits, norms, ceilings = statement.limits, statement.norms, statement.ceilings
    reach = np.minimum(limits.reach, clip)
    unit = unit or float(np.sum(np.abs(norms.constant)))
    if unit == 0.0:
        unit = float(np.sum(np.abs(norms.influence) * reach)) or 1.0
    budget = bool(np.sum(reach / limits.radius) > limits.max_total_mass)
    sectors = not bool(limits.free.all())
    count, cap, highest = len(ceilings.names), ceilings.cap / ceilings.size, statement.largest(statement.floor)
    of_terms = replace(norms, influence=norms.influence / unit)
    of_ceilings = replace(ceilings.norms, influence=ceilings.norms.influence / ceilings.size[:, None])
    # of alike webs the unknowns are those of the first
    every = np.arange(reach.size) if limits.alike is None else limits.alike.first
    mass = limits.together(reach / limits.radius)
    data = ScaledData(
        shape=Shape(
            stage, every.size, tuple(statement.row.tolist()), tuple(statement.group.tolist()), count, sectors, budget
        ),
        constant=_parts(norms.counting(norms.constant / unit)),
        matrix=_matrix(of_terms, statement, reach),
        floor=(statement.floor - highest[statement.group]) / unit,
        ceiling_constant=_parts(ceilings.norms.counting(ceilings.norms.constant / ceilings.size)),
        ceiling_matrix=_matrix(of_ceilings, statement, reach),
        ceiling_cap=cap - np.clip(cap, 0.0, margin),
        sine=limits.half_angle_sin[every],
        cosine=limits.half_angle_cos[every],
        slack=np.where(limits.free[every], 2.0, 0.0),
        mass=mass / mass_unit,
        budget=mass / limits.max_total_mass if budget else np.zeros_like(mass),
        target=np.array([(target - np.sum(highest)) / unit]),
        spread=limits.together(norms.scatter * np.abs(norms.influence) / unit * reach),
        ceiling_spread=limits.together(ceilings.norms.scatter * np.abs(of_ceilings.influence) * reach),
    )
    return data, Scaling(unit, reach, unit if stage == "objective" else mass_unit)


def _parts(vectors: Complex) -> Real:
    return np.array([vectors.real, vectors.imag])


def _matrix(norms: Norms, statement: Statement, reach: Real) -> Real:
    """(2 J, 2 K) matrix from (x, y) to the real and then the imaginary parts of H u, which scalars have none of.

    Of alike webs (x, y) are those of the first.
    """
    limits = statement.limits
    if limits.alike is None:
        along = norms.influence * reach * limits.centre
        across = 1j * along * limits.half_angle_sin
    else:
        of_first = (reach * limits.centre)[limits.alike.first]
        sine = limits.half_angle_sin[limits.alike.first]
        carried = (limits.alike.carried(of_first), limits.alike.carried(1j * of_first * sine))
        along, across = (limits.alike.summed(norms.influence * load) for load in carried)
    counts = ~np.array(norms.scalar, dtype=bool)[:, None] if any(norms.scalar) else 1.0
    return np.block([[along.real, across.real], [along.imag * counts, across.imag * counts]])


# loads the compiler, a tenth of a second, and so at the first call; an import at each takes as long as a short loop
@cache
def _cancelling() -> ModuleType:
    from optimizer.program.kernel import cancelling

    return cancelling
