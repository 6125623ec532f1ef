"""Reciprocating masses that scatter: which of them are heavy and which light where a peak is largest.

A peak is convex in the masses, so that it is largest at a corner of what they may be. Along a direction across the
shaft, at one angle of the shaft, a row adds m r cos(direction - axis) cos(shaft - phase): the worst signs are those of
of one of two factors, times those of the other. The direction and the shaft each pass finitely many places where signs
change. So of 2^n corners a few n^2 are left, and the largest peak is at one of them: exact.
"""

from dataclasses import replace

import numpy as np

from optimizer.mechanics.inertia import Wrench, reciprocating
from optimizer.mechanics.layout import Layout
from optimizer.numerics.arrays import Real
from optimizer.responses.response import Phasors


def row_parts(layout: Layout) -> Wrench:
    """First-order force and moment of every row of one machine by itself, over omega^2 (rows,)."""
    rows = layout.reciprocating
    return reciprocating(replace(layout, reciprocating=replace(rows, mass=np.diag(rows.mass))), 1)


def worst_signs(parts: Phasors, weight_x: float, weight_y: float) -> Real:
    """Signs of the changes of all masses (corners, rows), among which every peak has its largest.

    Parameters
    ----------
    parts : (rows,) what each row adds, its two phasors of one length.
    weight_x, weight_y : of the components of the vector whose peak it is.
    """
    axis = np.exp(0.5j * (np.angle(parts.co) + np.angle(parts.counter)))
    phase = 0.5 * (np.angle(parts.co) - np.angle(parts.counter))
    towards = np.angle(weight_x * axis.real + 1j * weight_y * axis.imag)
    along, across = _signs(towards), _signs(phase)
    signs = (along[:, None, :] * across[None, :, :]).reshape(-1, towards.size)
    return np.unique(np.concatenate([signs, -signs]), axis=0)


def weighted(vector: Phasors, weight_x: float, weight_y: float) -> Phasors:
    """A vector with its components across the shaft weighed."""
    p, q = 0.5 * (weight_x + weight_y), 0.5 * (weight_x - weight_y)
    return Phasors(p * vector.co + q * np.conj(vector.counter), p * vector.counter + q * np.conj(vector.co))


def changed(parts: Phasors, signs: Real, share: float) -> Phasors:
    """What changes of all masses by a share, of these signs (..., rows), add (...)."""
    return Phasors(share * (signs @ parts.co), share * (signs @ parts.counter))


def _signs(angle: Real) -> Real:
    """Signs of cos(x - angle) between the places of x, over half a turn, where one of them changes (m, n)."""
    edges = np.unique(np.mod(angle + 0.5 * np.pi, np.pi))
    middle = 0.5 * (edges + np.append(edges[1:], edges[:1] + np.pi))
    return np.where(np.cos(middle[:, None] - angle) >= 0.0, 1.0, -1.0)
