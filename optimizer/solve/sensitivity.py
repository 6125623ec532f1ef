"""What one degree, or one per cent, on all counterweights together may cost."""

from dataclasses import replace

import numpy as np

from optimizer.formulation.goals import Goals
from optimizer.numerics.arrays import Complex
from optimizer.program.cuts.cut import EXACT
from optimizer.program.cuts.misplacement import largest_last_goals
from optimizer.program.cuts.semi_infinite import Values
from optimizer.program.misplacement import worst_objectives
from schemas.answer.robust import Sensitivity

_DEGREE, _PERCENT = float(np.deg2rad(1.0)), 0.01
#: width of the brackets of what counterweights come to as they should be
_CLOSE = 1e-10


def sensitivity(goals: Goals, u: Complex, values: Values, omega_squared: float) -> Sensitivity:
    """Of the last goal of a problem.

    Parameters
    ----------
    values : what its program comes to with counterweights (K,) kg m.
    """
    program = goals.anywhere
    if program.finite is not None:
        nominal, by_angle, by_mass = worst_objectives(program.finite, u, _DEGREE, _PERCENT).reshape(3).tolist()
        return _rises(nominal, by_angle, by_mass, omega_squared)
    if program.scatter != EXACT or program is not goals.program:
        # of the counterweights as they should be, whatever they are allowed to be off by
        program = replace(program, scatter=EXACT)
        values = program.values(u, _CLOSE)
    by_angle, by_mass = largest_last_goals(program, u, values.reached, _DEGREE, _PERCENT)
    return _rises(float(values.goals[-1]), by_angle, by_mass, omega_squared)


def _rises(objective: float, by_angle: float, by_mass: float, omega_squared: float) -> Sensitivity:
    # what is above is so but for rounding: there are no errors among the errors
    return Sensitivity.of_figures(
        {
            "objective_rise_per_deg": max(by_angle - objective, 0.0) * omega_squared,
            "objective_rise_per_percent": max(by_mass - objective, 0.0) * omega_squared,
        }
    )
