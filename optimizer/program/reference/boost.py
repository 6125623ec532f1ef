"""Cones in the plane seen from near their boundary: the coordinates in which what is left of them is not rounding.

On the boundary of |a| <= t the difference t - |a| is all that counts, and in t and a it has lost its digits. With a
unit vector e the cone is p q >= y^2 for p = t + e.a, q = t - e.a and y across; p / f and f q satisfy the same. So a
*boost* by f maps the cone onto itself, and the one that makes p and q of a point alike shows them both in full.
Source: Nesterov and Todd, Self-scaled barriers and interior-point methods for convex programming (1997), section 3.
"""

from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Real

#: q is taken to be no smaller than this share of p: a boost beyond 100 costs more digits than it shows
_NEAREST = 1e-4
#: vectors below this size have no direction
_SMALLEST = 1e-9


def boosts(size: Real, vector: Real) -> Real:
    """Boosts (n, 3, 3) of cones |vector| <= size, rows in the order size, vector.

    Parameters
    ----------
    size, vector : (n,), (n, 2) of a point near an optimum.
    """
    length = np.hypot(*vector.T)
    p = np.maximum(size + length, _SMALLEST)
    factor = np.sqrt(p / np.maximum(size - length, _NEAREST * p))
    factor = np.where(length > _SMALLEST, factor, 1.0)
    along = vector / np.maximum(length, _SMALLEST)[:, None]
    even, odd = 0.5 * (factor + 1.0 / factor), 0.5 * (factor - 1.0 / factor)
    matrices = np.empty((length.size, 3, 3))
    matrices[:, 0, 0] = even
    matrices[:, 0, 1:] = matrices[:, 1:, 0] = -odd[:, None] * along
    matrices[:, 1:, 1:] = np.eye(2) + (even - 1.0)[:, None, None] * along[:, :, None] * along[:, None, :]
    return matrices


class Boost(NamedTuple):
    """Boosts of all cones of some rows, which leave the other rows."""

    place: np.ndarray  # (n, 3) rows of each cone
    boosts: Real  # (n, 3, 3), symmetric

    @staticmethod
    def about(rows: Real, cones: np.ndarray) -> "Boost":
        """From rows (m,) of a point near an optimum and the first row (n,) of each cone."""
        place = cones[:, None] + np.arange(3)
        return Boost(place, boosts(rows[cones], rows[place[:, 1:]]))

    def of(self, rows: Real) -> Real:
        """Rows (m,) or (m, k), boosted."""
        result, shape = rows.copy(), (*self.place.shape, -1)
        result[self.place] = (self.boosts @ rows[self.place].reshape(shape)).reshape(rows[self.place].shape)
        return result
