"""How far plates are opened in the lightest optimum, all but: a guess, about which tangents are laid.

What coarse tangents call for is proven of nothing, but the responses are nearly right. They are kept, and so are webs
without a plate. Every plate is opened up to where one more kilogram metre costs what it is worth at a price of the
responses. Newton's steps on the concave dual give the price at which the plates make up the responses:

    max over p of Re(conj(h) . p) - sum_k m*_k(|s_k|),    s_k = sum_j H_jk p_j,    m*(s) = max_U s U - m(U).
"""

from typing import NamedTuple

import numpy as np

from optimizer.mechanics.plates import Plates
from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record
from optimizer.program.equal_unknowns import united
from optimizer.program.methods.compiled import suits_kernel, unproven
from optimizer.program.plate_pieces import pieces, tangents
from optimizer.program.statement import Statement

#: Newton's steps, and how often one is halved
_STEPS, _HALVES = 10, 6
#: share of the responses that may be left
_ENOUGH = 1e-6
#: prices that are this much apart, relative, tell how openings follow them
_APART = 1e-6
_NEAR = np.array([[1.0], [1.0 - _APART], [1.0 + _APART]])
#: directions that move the responses by a smaller share of the most are left out
_FLAT = 1e-10


def guessed(whole: Statement, plates: Plates, nodes: Real, share: Real, least_mass: bool) -> Real | None:
    """Half-angles (P,) rad of one program that has a leading axis (1,); None where nothing is guessed.

    Parameters
    ----------
    nodes : (n, P) half-angles of the tangents, rad.
    share : (1,) how far above the smallest objective an optimum may be.
    """
    laid, alike = pieces(whole, plates, tangents(plates, nodes)), whole.limits.alike
    if alike is not None and not alike.plain:
        return None
    unit, count = np.arange(len(whole.limits.radius[0])), np.ones(plates.webs.size)
    if alike is not None and laid.program.limits.alike is not None:
        # the unknowns of united programs are what all webs of a unit carry
        of_pieces, unit = laid.program.limits.alike, alike.owner
        laid = laid._replace(
            program=united(laid.program, of_pieces),
            owner=unit[laid.owner[of_pieces.first]],
            machine_webs=alike.first.size,
        )
        whole, count = united(whole, alike), alike.count[unit[plates.webs]].astype(float)
    if not suits_kernel(laid.program) or not laid.program.limits.reach.any():
        return None
    solution, price = unproven(laid.program, share, least_mass)
    u = laid.carried(solution)[0]
    if not np.isfinite(u).all() or not u.any():
        return None
    unit, first = unit[plates.webs], np.unique(unit[plates.webs], return_index=True)[1]
    if not least_mass:
        return plates.opened(np.abs(u[unit]) / count)
    limits, influence = whole.limits, whole.every_influence[0][:, unit[first]]
    size = np.maximum.reduce(np.abs(influence), axis=-1, initial=0.0)
    size = np.where(size > 0, size, 1.0)
    towards = np.where(u != 0, u / np.where(u != 0, np.abs(u), 1.0), limits.centre[0])
    dual = _Dual(
        plates,
        plates.lever(np.zeros(plates.webs.size))[first],
        plates.most[first],
        np.searchsorted(unit[first], unit),
        first,
        count[first],
        influence / size[:, None],
        influence / size[:, None] @ u[unit[first]],
        np.where(limits.free[0], 0.0, towards)[unit[first]],
    )
    return dual.opened(-price[0] * size)


class _At(NamedTuple):
    """A price and what it comes to."""

    price: Complex  # (J,) kg per unit of the responses
    left: Complex  # (J,) of the responses, the gradient of the dual
    size: float  # of the largest of these
    angle: Real  # (P,) rad
    rows: Real  # (2J, 2n) what plates move the responses by, along their unbalances and across
    give: Real  # (2n,) how unbalances follow the price, along and across, kg m per (kg per kg m)


@record(frozen=True)
class _Dual:
    """Plates, of n alike ones the first, and the responses that they are to make up."""

    plates: Plates
    shut: Real  # (n,) levers of what is added first, m
    most: Real  # (n,) largest half-angles, rad
    owner: np.ndarray  # (P,) which of the n
    first: np.ndarray  # (n,) places of these
    count: Real  # (n,) how many are alike
    influence: Real  # (J, n)
    target: Complex  # (J,)
    towards: Complex  # (n,) the direction of one that has a sector; 0 where every direction is free

    def opened(self, price: Complex) -> Real:
        """Half-angles (P,) from the price (J,) of tangents."""
        here, enough = self._at(price), _ENOUGH * float(np.max(np.abs(self.target)))
        for _ in range(_STEPS):
            if here.size <= enough:
                break
            left = np.concatenate([here.left.real, here.left.imag])
            step = np.linalg.lstsq((here.rows * here.give) @ here.rows.T, left, rcond=_FLAT)[0]
            along, across = np.split(step, 2)
            for halves in range(_HALVES):
                there = self._at(here.price + 0.5**halves * (along + 1j * across))
                if there.size < here.size:
                    break
            else:
                break
            here = there
        return here.angle

    def _at(self, price: Complex) -> _At:
        pull = price @ self.influence
        free = self.towards == 0
        worth = np.where(free, np.abs(pull), np.maximum((pull * np.conj(self.towards)).real, 0.0))
        towards = np.where(free & (worth > 0), pull / np.where(worth > 0, worth, 1.0), self.towards)
        # of both shapes the lever falls as the cosine of the opening
        cosine = 1.0 / np.maximum(worth * self.shut * _NEAR, 1.0)
        angle = np.minimum(np.arccos(cosine), self.most)[:, self.owner]
        size = self.plates.unbalance(angle)[:, self.first] * self.count
        worth = np.where(worth > 0, worth, 1.0)
        effect, left = self.influence * towards, self.target - self.influence @ (size[0] * towards)
        (terms, webs), rows = effect.shape, np.empty((2 * effect.shape[0], 2 * effect.shape[1]))
        rows[:terms, :webs], rows[:terms, webs:] = effect.real, -effect.imag
        rows[terms:, :webs], rows[terms:, webs:] = effect.imag, effect.real
        return _At(
            price,
            left,
            float(np.maximum.reduce(np.abs(left))),
            angle[0],
            rows,
            np.concatenate([(size[2] - size[1]) / (2.0 * _APART * worth), np.where(free, size[0], 0.0) / worth]),
        )
