"""Points of which some counterweights are elsewhere, while others make up for that: what is to stay as it is, stays."""

import numpy as np

from optimizer.numerics.arrays import Complex, Real, in_order, single_axis
from optimizer.program.compiled_evaluation import settling_work
from optimizer.program.limits import Limits


def near_limits(
    limits: Limits, influence: Real | Complex, u: Complex, dust: float, touched: float
) -> tuple[Complex, np.ndarray]:
    """Points (N, K) with what is near enough to nothing, or to a limit, there, and whether anything was (N,) bool.

    What is between the limits makes up for it.

    Parameters
    ----------
    influence : (N, J, K) on what is to stay as it is.
    dust, touched : shares of the largest mass that is next to nothing, and of a limit that is next to it.
    """
    new = np.empty(u.shape, complex)
    is_new = _rebalance(limits, influence, u, np.array([dust, touched]), np.empty(u.shape), new)
    return new, is_new


def balanced(limits: Limits, influence: Real | Complex, u: Complex, base: Complex, room: Real) -> Complex:
    """What is put (N, K) in place of points, with others that make up for it, within all limits.

    Parameters
    ----------
    influence : (N, J, K) on what is to stay as it is.
    room : (N, K) relative to which the change of the others is the least; of alike webs they change alike.
    """
    new = np.array(base, complex, order="C")
    _rebalance(limits, influence, u, np.array([-1.0, 0.0]), in_order(room), new)
    return new


def _rebalance(
    limits: Limits, influence: Real | Complex, u: Complex, near: Real, room: Real, new: Complex
) -> np.ndarray:
    """As :func:`optimizer.program.kernel.settling.rebalance`: which points are others (N,) bool."""
    from optimizer.program.kernel.settling import rebalance

    many, terms, webs = influence.shape
    own, is_new = limits.region((many,)), np.empty(many, bool)
    rebalance(in_order(u), near, *_parts(influence, (many,)), own, room, *settling_work(own, terms, webs), new, is_new)
    return is_new


def _parts(influence: Real | Complex, leading: tuple[int, ...]) -> tuple[Real, Real]:
    """Real and imaginary parts (N, J, K), the latter (N, J, 0) where all are real."""
    across = influence[..., :0] if influence.dtype == float else influence.imag
    return single_axis(leading, influence.real, 2), single_axis(leading, across, 2)
