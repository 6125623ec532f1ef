"""Identical castings: webs that get the same counterweight, in the same place on their own cranks.

A group is one unknown of the program. With n webs k whose cranks stand at the angles d_k, the unknown w is n times the
counterweight of the first of them: web k carries u_k = d_k conj(d_1) w / n, so that a term sees the mean of the turned
influences, and w weighs what all of them weigh together.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.errors import refuse
from optimizer.figures.balance_rate import crank_angles
from optimizer.mechanics.angles import direction
from optimizer.program.limits import Limits
from optimizer.program.norms import Norms
from optimizer.program.statement import Statement
from schemas.base import FieldProblem
from schemas.machine import Machine

#: what webs of a group have in common, beside their sectors as seen from their own cranks
_ALIKE = ("counterweight_radius_m", "max_mass_kg", "max_centrifugal_force_N")


@dataclass(frozen=True)
class Units:
    """The unknowns of a program with groups: each the webs of one group, or a web by itself."""

    first: np.ndarray  # (U,) first web of each
    owner: np.ndarray  # (K,) unit of each web
    ahead_deg: Real  # (K,) by which the crank of a web is ahead of that of the first of its unit

    @property
    def count(self) -> np.ndarray:
        """Webs of each unit (U,)."""
        return np.bincount(self.owner, minlength=self.first.size)

    @property
    def turn(self) -> Complex:
        """Unit vectors by which a web is turned from the first of its unit (K,)."""
        return direction(self.ahead_deg)

    def united(self, statement: Statement) -> Statement:
        """The program (..., K) in these unknowns (..., U)."""
        limits, first, count = statement.limits, self.first, self.count
        alike = {
            name: getattr(limits, name)[..., first]
            for name in ("radius", "free", "centre", "half_angle_cos", "half_angle_sin")
        }
        ceilings = replace(statement.ceilings, norms=self._mean(statement.ceilings.norms))
        return replace(
            statement,
            norms=self._mean(statement.norms),
            ceilings=ceilings,
            limits=Limits(**alike, max_mass=limits.max_mass[..., first] * count, max_total_mass=limits.max_total_mass),
        )

    def _mean(self, norms: Norms) -> Norms:
        belongs = (self.owner[:, None] == np.arange(self.first.size)) / self.count
        turned: Any = (norms.influence * self.turn) @ belongs
        # cranks in one plane leave it real
        return replace(norms, influence=turned.real.copy() if not np.any(turned.imag) else turned)

    def apart(self, unbalance: Complex) -> Complex:
        """Unbalances of the webs (..., K) of those of the units (..., U), kg m."""
        return self.turn * (unbalance / self.count)[..., self.owner]

    def limits_apart(self, reached: Limits, stated: Limits) -> Limits:
        """Limits of the webs (..., K), with the largest masses that the units (..., U) were proven with."""
        return replace(stated, max_mass=(reached.max_mass / self.count)[..., self.owner])

    def alike(self, mass_kg: Real, angle_deg: Real) -> tuple[Real, Real]:
        """Masses and angles (..., K), to the last digit those of the first of every unit."""
        of_first = self.first[self.owner]
        mass = mass_kg[..., of_first]
        angle = np.mod(angle_deg[..., of_first] + self.ahead_deg, 360.0)
        return mass, np.where(mass > 0, np.where(self.ahead_deg == 0.0, angle_deg[..., of_first], angle), 0.0)


def units(machine: Machine) -> Units:
    """The unknowns of one machine.

    Raises
    ------
    OutOfRange
        where webs of a group are not alike, or one belongs to no crank.
    """
    places = {web.name: k for k, web in enumerate(machine.webs)}
    groups = [[places[name] for name in group.webs] for group in machine.web_groups]
    cranks = crank_angles(machine)
    refuse(problem for i, group in enumerate(groups) for problem in _problems(machine, cranks, i, group))
    grouped = {k for group in groups for k in group}
    every = sorted([*groups, *([k] for k in range(len(machine.webs)) if k not in grouped)], key=lambda webs: webs[0])
    owner, ahead = np.zeros(len(machine.webs), int), np.zeros(len(machine.webs))
    for unit, webs in enumerate(every):
        owner[webs] = unit
        if len(webs) > 1:
            ahead[webs] = [((cranks[k] or 0.0) - (cranks[webs[0]] or 0.0)) % 360.0 for k in webs]
    return Units(np.array([webs[0] for webs in every], int), owner, ahead)


def _problems(machine: Machine, cranks: Sequence[float | None], i: int, group: Sequence[int]) -> Iterator[FieldProblem]:
    first, at = machine.webs[group[0]], cranks[group[0]]
    for j, k in enumerate(group):
        web, path = machine.webs[k], ("machine", "web_groups", i, "webs", j)
        if cranks[k] is None:
            yield FieldProblem(path, "this web belongs to no crank: name its throw")
            continue
        unlike = [name for name in _ALIKE if getattr(web, name) != getattr(first, name)]
        if not _same_sector(web.sector, first.sector, (cranks[k] or 0.0) - (at or 0.0)):
            unlike.append("sector, counted from the own crank,")
        if unlike:
            words = " and ".join(unlike)
            yield FieldProblem(
                path, f"only webs that are alike get the same casting: its {words} is not that of {first.name}"
            )


def _same_sector(one: Any, other: Any, ahead_deg: float) -> bool:
    if one is None or other is None:
        return one is other
    off = (one.centre_deg - other.centre_deg - ahead_deg + 180.0) % 360.0 - 180.0
    return abs(off) <= 1e-9 and one.half_angle_deg == other.half_angle_deg
