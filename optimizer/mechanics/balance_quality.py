"""Permissible residual unbalance after ISO 21940-11, and what unbalances come to in two planes."""

import numpy as np

from optimizer.numerics.arrays import Complex, Reals

#: of the permissible unbalance, what a plane between the bearings has at least and at most (ISO 21940-11)
_LEAST, _MOST = 0.3, 0.7


def permissible_unbalance(grade: Reals, mass: Reals, omega: Reals) -> Reals:
    """U_per = G m / Omega (...), kg m.

    Parameters
    ----------
    grade : m/s, the speed of the centre of mass about the axis.
    """
    return grade * mass / omega


def plane_shares(centre: Reals, plane_a: Reals, plane_b: Reals) -> tuple[Reals, Reals]:
    """Shares of the permissible unbalance (...) of two planes on both sides of the centre of mass.

    U_A : U_B = (z_B - z_G) : (z_G - z_A), each within 0.3 and 0.7.
    """
    share = np.clip((plane_b - centre) / (plane_b - plane_a), _LEAST, _MOST)
    return share, 1.0 - share


def in_planes(unbalance: Complex, couple: Complex, plane_a: Reals, plane_b: Reals) -> tuple[Complex, Complex]:
    """Unbalances (...) in two planes that come to the same, kg m.

    Parameters
    ----------
    unbalance, couple : (...) kg m, and kg m^2 about the origin that the planes are measured from.
    """
    in_b = (couple - plane_a * unbalance) / (plane_b - plane_a)
    return unbalance - in_b, in_b
