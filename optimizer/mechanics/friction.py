"""Friction: constant along every row, against its motion, and constant on the shaft, against its rotation."""

import numpy as np

from optimizer.mechanics.kinematics import Motion
from optimizer.numerics.arrays import Real


def reciprocating_friction(motion: Motion, magnitude: Real) -> Real:
    """Friction force of the rows, N, positive in rod tension (..., rows, T).

    Positive over the stroke to the shaft (0..pi), negative over the return (the 2D12's calculation, 2-17), zero at
    the dead centres, where the piston stands still.

    Parameters
    ----------
    magnitude : (..., rows) N.
    """
    still = np.abs(motion.sine) < 1e-12
    return np.where(still, 0.0, np.sign(motion.sine)) * magnitude[..., None]


def share_of_losses(
    indicated_power: Real, efficiency: Real, reciprocating_share: Real, stroke: Real, omega: Real
) -> tuple[Real, Real]:
    """Friction force of each row [N] and rotating friction torque [N m] from the mechanical efficiency.

    N_m = N_i (1/eta - 1); a row's share does its work over two strokes a turn, the rest turns with
    the shaft: R_s = share N_m 60 / (2 S n), M_r = (1 - share) N_m / omega (design calculation of the 2D12, 2-17..2-19).
    Of a row whose gas gives power the losses are its share 1 - eta.

    Parameters
    ----------
    indicated_power : (..., rows) W.
    efficiency, reciprocating_share, omega : (...).
    stroke : (..., rows) m.
    """
    # 1/eta - 1 would cancel for small losses
    lost = (1.0 - efficiency)[..., None]
    losses = np.where(indicated_power < 0.0, -indicated_power * lost, indicated_power * (lost / efficiency[..., None]))
    per_turn = losses * 2.0 * np.pi / omega[..., None]
    force = reciprocating_share[..., None] * per_turn / (2.0 * stroke)
    torque = (1.0 - reciprocating_share) * np.add.reduce(losses, axis=-1) / omega
    return force, torque
