"""Programs of alike webs as programs of one unknown for each unit, and back: none is mirrored."""

from dataclasses import replace

import numpy as np

from optimizer.numerics.arrays import Complex
from optimizer.program.equal_castings import Alike
from optimizer.program.limits import Limits
from optimizer.program.norms import Norms
from optimizer.program.statement import Statement


def united(statement: Statement, alike: Alike) -> Statement:
    """The program whose unknowns are n times what the first of each n alike webs carries; none is mirrored.

    A term sees the mean of the turned influences, and an unknown weighs what all its webs weigh together.
    """

    def mean(norms: Norms) -> Norms:
        influence = alike.summed(norms.influence * alike.turn[..., None, :]) / alike.count
        # cranks in one plane leave it real
        return replace(norms, influence=influence.real.copy() if not np.any(influence.imag) else influence)

    ceilings = replace(statement.ceilings, norms=mean(statement.ceilings.norms))
    limits = of_units(statement.limits, alike)
    return replace(statement, norms=mean(statement.norms), ceilings=ceilings, limits=limits)


def of_units(limits: Limits, alike: Alike) -> Limits:
    """Limits of the first webs, each with the largest mass of its whole unit."""
    names = ("radius", "free", "centre", "half_angle_cos", "half_angle_sin")
    first = {name: getattr(limits, name)[..., alike.first] for name in names}
    return replace(limits, **first, max_mass=limits.max_mass[..., alike.first] * alike.count, alike=None)


def apart(of_units: Complex, alike: Alike) -> Complex:
    """Unbalances of the webs (..., K) of unknowns of :func:`united` (..., U)."""
    return alike.carried(of_units / alike.count)
