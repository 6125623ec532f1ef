"""Lower bounds from any multipliers, in 100-digit numbers: what proves a reference, whatever found it.

For |y_j| <= lam_{r(j)}, sum_r lam_r floor_r + sum_j Re(conj(y_j) a_j(u)) is an affine function of u below
sum_r lam_r P_r(u), and a ceiling |f_i(u)| <= cap_i adds Re(conj(p_i) f_i(u)) - |p_i| cap_i <= 0. The least value of
such a function within the limits is a knapsack.
"""

from typing import Any

from tests.hard.interior import ONE, ZERO, Number, Vector, mp
from tests.hard.program import Goal, Machine, Web


def objective_bound(data: Machine, goal: Goal, y: list[Any], p: list[Any], lam: Vector) -> Number:
    """No counterweights within the limits and ceilings have a smaller objective than this, per omega^2."""
    total = sum(lam, ZERO)
    y, p, lam = [v / total for v in y], [v / total for v in p], [v / total for v in lam]
    constant, slope = _below(data, goal, y, p, lam)
    return constant + _least(data, slope, ZERO)


def mass_bound(data: Machine, goal: Goal, y: list[Any], p: list[Any], lam: Vector, target: Number) -> Number:
    """None of them with an objective of at most ``target`` weigh less than this; multipliers in kg per objective."""
    constant, slope = _below(data, goal, y, p, lam)
    return constant - sum(lam, ZERO) * target + _least(data, slope, ONE)


def _below(data: Machine, goal: Goal, y: list[Any], p: list[Any], lam: Vector) -> tuple[Number, Vector]:
    """The affine function const + sum_k Re(conj(w_k) u_k)."""
    co = (data.baseline.force[0], data.baseline.moment[0])
    constant = sum((a * b for a, b in zip(lam, goal.floors, strict=True)), ZERO)
    slope = [mp.mpc(0)] * len(data.webs)
    for term, v in zip(goal.terms, y, strict=True):
        v = v if abs(v) <= lam[term.row] else v * lam[term.row] / abs(v)
        constant += mp.re(mp.conj(v) * (term.constant + term.share * co[term.response]))
        slope = [s + term.share * _arm(web, term.response) * v for s, web in zip(slope, data.webs, strict=True)]
    for (response, cap), v in zip(goal.ceilings, p, strict=True):
        constant += mp.re(mp.conj(v) * co[response]) - abs(v) * cap
        slope = [s + _arm(web, response) * v for s, web in zip(slope, data.webs, strict=True)]
    return constant, slope


def _arm(web: Web, response: int) -> Number:
    return web.arm if response else ONE


def _least(data: Machine, slope: Vector, cost: Number) -> Number:
    """Minimum of sum (cost m_k + Re conj(w_k) u_k) over the limits: the best webs first, until the budget is spent."""
    gains = [(web.radius * web.support(-s) - cost, web.max_mass) for web, s in zip(data.webs, slope, strict=True)]
    left, bound = data.budget, ZERO
    for gain, mass in sorted(gains, key=lambda pair: -pair[0]):
        if gain <= 0:
            break
        taken = mass if left is None else min(mass, left)
        bound -= gain * taken
        left = None if left is None else left - taken
    return bound
