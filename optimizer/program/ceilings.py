"""Hard limits on peaks."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

from optimizer.numerics.arrays import SMALLEST, Complex, Real, Reals
from optimizer.numerics.records import record
from optimizer.program.norms import Norms, join
from optimizer.responses.response import Response

#: a ceiling counts as kept up to this share of its size (``Ceilings.size``)
CEILING_TOLERANCE = 1e-9


@record(frozen=True)
class Ceilings:
    """Hard limits |c_i + H_i u| <= cap_i; a cap below 0 cannot be met."""

    names: tuple[str, ...]
    norms: Norms
    cap: Real  # (..., I)
    size: Real  # (..., I) > 0, what an excess is measured by
    tolerance: float = CEILING_TOLERANCE  # up to which they count as kept, as a share of the size
    angles_deg: tuple[float | None, ...] | None = None  # (I,) at which a response is limited; None is over the turn
    scenarios: tuple[str | None, ...] | None = None  # (I,) whose response is limited; None is the unchanged machine

    def excess(self, u: Complex) -> Real:
        """How far each response is above its ceiling, relative to its size; <= 0 if met."""
        if not self.names:
            return self.cap + np.zeros((*u.shape[:-1], 1))
        return (self.norms.sizes(u) - self.cap) / self.size

    @property
    def tolerant_cap(self) -> Real:
        """Caps up to which they count as kept (..., I)."""
        return self.cap + self.tolerance * self.size

    def raised(self, share: float) -> "Ceilings":
        """Every ceiling higher by a share of its size, which is taken from the tolerance."""
        return replace(self, cap=self.cap + share * self.size, tolerance=self.tolerance - share)

    def mapped(self, function: Callable[[Any], Any]) -> "Ceilings":
        """A function of every array."""
        norms, cap, size = self.norms.mapped(function), function(self.cap), function(self.size)
        return Ceilings(self.names, norms, cap, size, self.tolerance, self.angles_deg, self.scenarios)

    def only(self, webs: np.ndarray) -> "Ceilings":
        return replace(self, norms=self.norms.only(webs))


def limited(ceilings: Sequence[tuple[Response, Reals]], objective: Norms, webs: int) -> Ceilings:
    """Ceilings on responses beside an objective."""
    leading = objective.constant.shape[:-1]
    if not ceilings:
        return no_ceilings(leading, webs)
    terms = [Norms(response.baseline.co[..., None], response.influence[..., None, :]) for response, _ in ceilings]
    if any(term.constant.shape[:-1] != leading or term.influence.shape[:-2] != leading for term in terms):
        terms = [no_ceilings(leading, webs).norms, *terms]
    norms = join(terms)
    # Peak = |f| + |b| <= ceiling is |f| <= ceiling - |b|
    cap = np.zeros((*leading, len(ceilings)))
    for index, (response, ceiling) in enumerate(ceilings):
        cap[..., index] = ceiling - np.abs(response.baseline.counter)
    size = np.maximum(np.abs(norms.constant), np.abs(cap))
    if not (size > SMALLEST).all():
        size = _where_nothing(size, norms, objective, [response for response, _ in ceilings])
    names, scenarios = zip(*((response.name, response.scenario) for response, _ in ceilings), strict=True)
    return Ceilings(names, norms, cap, size, scenarios=scenarios)


def _where_nothing(size: Real, norms: Norms, objective: Norms, responses: Sequence[Response]) -> Real:
    """What an excess is measured by where cap and vector vanish too, (..., I)."""
    # what the same response has with other masses
    same = np.array([[a.name == b.name and a.scenario == b.scenario for a in responses] for b in responses])
    size = np.where(size > SMALLEST, size, np.maximum.reduce(same * size[..., None, :], axis=-1))
    # else: what the unbalance that the objective calls for does to the response
    called_for = np.maximum.reduce(np.abs(objective.constant) / objective.largest_influence, axis=-1, initial=0.0)
    size = np.where(size > SMALLEST, size, norms.largest_influence * called_for[..., None])
    return np.where(size > SMALLEST, size, 1.0)


# of no numbers, so that nobody can write to any
@lru_cache(maxsize=128)
def no_ceilings(leading: tuple[int, ...], webs: int) -> Ceilings:
    """None on programs of these axes."""
    norms = Norms(np.zeros((*leading, 0), complex), np.zeros((*leading, 0, webs)))
    return Ceilings((), norms, np.zeros((*leading, 0)), np.zeros((*leading, 0)), scenarios=())
