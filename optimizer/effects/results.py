"""What the effects over the turn come to, with the leading axes (...) of the layout."""

import numpy as np

from optimizer.mechanics.gas import Chambers, GasForces, indicated_work, switching_angles
from optimizer.mechanics.indicated import Trace
from optimizer.mechanics.layout import Layout
from optimizer.numerics.arrays import Real
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record


@record(frozen=True)
class GasCycle:
    """Gas of all rows: forces over the samples, and what the chambers do whatever the samples."""

    chambers: Chambers
    layout: Layout
    forces: GasForces
    exact: bool  # kinematics, or cut off after the second order
    traces: tuple[Trace, ...] = ()  # of the chambers with a table of pressures

    @cached_property
    def opens(self) -> tuple[Real, Real]:
        """Own crank angles at which suction and discharge open, (..., rows, C) rad each."""
        return switching_angles(self.chambers, self.layout, self.exact)

    @cached_property
    def work(self) -> Real:
        """(..., rows, C) J, indicated in one turn, in the mean of a cycle of two."""
        work, rows = indicated_work(self.chambers, self.layout), self.layout.reciprocating
        for trace in self.traces:
            place = (..., trace.row)
            area = self.chambers.area[*place, trace.side]
            work[*place, trace.side] = trace.work(
                area, rows.crank_radius[place], rows.rod_ratio[place], rows.rod_margin[place]
            )
        return work

    @cached_property
    def power(self) -> Real:
        """(..., rows) W, indicated."""
        return np.add.reduce(self.work, axis=-1) * self.layout.omega[..., None] / (2.0 * np.pi)


@record(frozen=True)
class FrictionForces:
    """Friction of all rows over the samples, and of the shaft."""

    magnitude: Real  # (..., rows) N
    force: Real  # (..., rows, T) N
    torque: Real  # (...) N m


@record(frozen=True)
class PistonForces:
    """What acts on the pistons, (..., rows, T) N."""

    gas: Real
    inertia: Real
    friction: Real
    total: Real


@record(frozen=True)
class TorqueSeries:
    """Torque over the samples, N m."""

    rows: Real  # (..., rows, T)
    total: Real  # (..., T)
    rotating_friction: Real  # (...)


@record(frozen=True)
class TorqueIntegrals:
    """Means and ranges over the turn, whatever the samples."""

    row_mean: Real  # (..., rows) N m
    mean: Real  # (...) N m
    fluctuation: Real  # (...) J
    fluctuation_error: Real | None  # (...) J, of a closed form; None where only finer panels could say
    indicated_power: Real  # (...) W
    friction_power: Real  # (...) W


@record(frozen=True)
class TorqueErrors:
    """By how much the integrals differ from those over panels twice as wide (...)."""

    mean: Real  # N m
    fluctuation: Real  # J


@record(frozen=True)
class FlywheelFigures:
    """Irregularity and inertia that belong to each other (...)."""

    irregularity: Real
    inertia: Real  # kg m^2
