"""What castings and choices cost, and the most that goals before leave of it."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from optimizer.choices.castings_beside import CastingsBeside
from optimizer.choices.catalogue import Catalogue
from optimizer.choices.catalogue_options import part_numbers
from optimizer.choices.feasible_set import Choice, FeasibleSet
from optimizer.program.limits import Limits
from schemas.request.objective import Cost

#: by which sums of masses are rounded, relative
_ROUNDING = 1e-12


class Caps(NamedTuple):
    """The most that goals before leave."""

    mass: float = np.inf  # kg
    pieces: float = np.inf
    sizes: float = np.inf

    def lower(self, kind: Cost, most: float) -> "Caps":
        """With a smaller one of a kind."""
        return self._replace(**{kind: min(getattr(self, kind), most)})

    def of(self, choices: FeasibleSet) -> FeasibleSet:
        """The choices that are so few and of so few sizes."""
        if self.pieces == self.sizes == np.inf and self.mass > 0.0:
            return choices
        assert isinstance(choices, Catalogue | CastingsBeside)  # nothing else is counted
        options = choices.stock.options
        fitted, parts = _least(options.most_fitted, self.pieces), _least(options.most_parts, self.sizes)
        if parts == 0 or self.mass == 0.0:
            # no size, or no mass, is nothing at all
            fitted, parts = 0, options.most_parts
        capped = replace(options, most_fitted=fitted, most_parts=parts)
        stock = choices.stock._replace(options=capped)
        if isinstance(choices, CastingsBeside) and self.mass == 0.0:
            # nor on other webs
            nothing = replace(choices.limits, max_mass=np.zeros(choices.limits.max_mass.shape))
            return replace(choices, stock=stock, limits=nothing)
        return replace(choices, stock=stock)

    def within(self, limits: Limits) -> Limits:
        """The same of the total mass."""
        if self.mass in (0.0, np.inf):
            return limits
        return replace(limits, max_total_mass=np.minimum(limits.max_total_mass, self.mass * (1.0 + _ROUNDING)))


NO_CAPS = Caps()


def _least(most: int | None, cap: float) -> int | None:
    return most if cap == np.inf else int(cap) if most is None else min(most, int(cap))


def cost(choice: Choice, kind: Cost) -> float:
    """What a choice costs: kg, or a number of castings."""
    if kind == "mass":
        return float(np.sum(choice.mass))
    mass = choice.mass if choice.castings is None else choice.mass[choice.castings]
    return float(np.sum(mass > 0) if kind == "pieces" else part_numbers(mass))
