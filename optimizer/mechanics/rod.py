"""From piston force to the forces on rod, guide and crank pin, and to the torque of a row."""

import numpy as np

from optimizer.mechanics.angles import shaft_vectors
from optimizer.mechanics.kinematics import Motion
from optimizer.mechanics.layout import Layout
from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record


@record(frozen=True)
class RodForces:
    """Forces that a piston force sends into the mechanism, over shaft angles (..., rows, T): properties.

    Source: lecture slides on compressors; design calculation of the 2D12, 2-21 and 2-22.
    """

    piston: Real  # P, N, tension positive
    motion: Motion
    crank_radius: Real  # (..., rows, 1) m

    @property
    def rod(self) -> Real:
        """P / cos beta, tension positive, N."""
        return self.piston / self.motion.rod_angle_cosine

    @property
    def side(self) -> Real:
        """P tan beta, on the crosshead guide, N."""
        return self.piston * self.motion.rod_angle_tangent

    @property
    def tangential(self) -> Real:
        """P sin(phi + beta) / cos beta, positive against rotation, N."""
        return self.piston * self.motion.tangential_factor

    @property
    def radial(self) -> Real:
        """P cos(phi + beta) / cos beta, positive outward along the crank, N."""
        return self.piston * self.motion.radial_factor

    @property
    def torque(self) -> Real:
        """Tangential force times crank radius, positive against rotation, N m."""
        return self.tangential * self.crank_radius

    @property
    def overturning(self) -> Real:
        """Side force times the distance from pin to shaft, N m; equals the torque."""
        moving = self.motion
        # l sin beta = r sin phi, which stands for the infinite rod as well: N h = P (l sin beta + r cos phi tan beta)
        return self.piston * (self.crank_radius * (moving.sine + moving.cosine * self.motion.rod_angle_tangent))


def rod_forces(piston_force: Real, motion: Motion, layout: Layout) -> RodForces:
    """Forces that a piston force (..., rows, T) N, tension positive, sends into the mechanism."""
    return RodForces(piston_force, motion, layout.reciprocating.crank_radius[..., None])


def shaft_loads(piston_force: Real, motion: Motion, layout: Layout, shaft_angle: Real) -> tuple[Real, Complex]:
    """Forces of rows and rotating masses on the shaft, which its main bearings carry.

    A rod in tension pulls its pin towards the piston: P e^{jg} (1 - j s tan beta). With the side forces
    on the guides, the gas on the covers and the friction on the cylinders they add up to the shaking force.

    Parameters
    ----------
    piston_force : (..., rows, T) N, tension positive.
    shaft_angle : (..., T) rad.

    Returns
    -------
    planes (..., rows + masses) m, forces (..., rows + masses, T) N as x + jy.
    """
    rows, masses, sense = layout.reciprocating, layout.rotating, layout.sense[..., None, None]
    pulled = piston_force * rows.axis[..., None] * (1.0 - 1j * sense * motion.rod_angle_tangent)
    outward = masses.mass * masses.radius * masses.direction * layout.omega[..., None] ** 2
    whirling = outward[..., None] * shaft_vectors(layout.sense, shaft_angle)[..., None, :]
    planes = np.concatenate([rows.position, masses.position], axis=-1)
    return planes, np.concatenate([pulled, whirling], axis=-2)
