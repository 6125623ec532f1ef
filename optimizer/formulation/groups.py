"""Identical castings: webs that get the same counterweight, in the same place on their own cranks or mirrored there."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from optimizer.errors import refuse
from optimizer.mechanics.angles import direction
from optimizer.mechanics.crank_of_web import crank_angles
from optimizer.numerics.arrays import Real
from optimizer.numerics.memoization import remembered
from optimizer.program.equal_castings import Alike
from schemas.base.model import FieldProblem
from schemas.machine.choices import KINDS as CHOICES
from schemas.machine.choices import Option
from schemas.machine.machine import Machine

#: what webs of a group have in common, beside their sectors and holes as seen from their own cranks
_ALIKE = (
    "counterweight_radius_m",
    "max_mass_kg",
    "max_centrifugal_force_N",
    "envelope",
    "min_fitted_mass_kg",
)


@remembered
def alike_webs(machine: Machine) -> Alike | None:
    """Which webs of one machine are alike, None where none are.

    Raises
    ------
    OutOfRange
        where webs of a group are unlike, or one belongs to no crank.
    """
    if not machine.web_groups:
        return None
    places = {web.name: k for k, web in enumerate(machine.webs)}
    groups = [[places[name] for name in group.webs] for group in machine.web_groups]
    cranks = crank_angles(machine)
    refuse(problem for i, group in enumerate(groups) for problem in _problems(machine, cranks, i, group))
    count = len(machine.webs)
    ahead, leader, mirrored = np.zeros(count), list(range(count)), [False] * count
    for group, web_group in zip(groups, machine.web_groups, strict=True):
        first = cranks[group[0]] or 0.0
        for n, k in enumerate(group):
            leader[k], mirrored[k] = group[0], web_group.mirrors(n)
            # d_k w with w = u conj(d) of the first at d, or d_k conj(w)
            own = cranks[k] or 0.0
            ahead[k] = (own + first if mirrored[k] else own - first) % 360.0
    return Alike(direction(ahead), ahead, tuple(leader), tuple(mirrored))


def _problems(machine: Machine, cranks: Sequence[float | None], i: int, group: Sequence[int]) -> Iterator[FieldProblem]:
    first, at = machine.webs[group[0]], cranks[group[0]]
    for j, k in enumerate(group):
        web, path = machine.webs[k], ("machine", "web_groups", i, "webs", j)
        if cranks[k] is None:
            yield FieldProblem(path, "this web belongs to no crank: name its throw")
            continue
        unlike = [name for name in _ALIKE if getattr(web, name) != getattr(first, name)]
        mirrored = machine.web_groups[i].mirrors(j)
        if not _same_sector(first.sector, at or 0.0, web.sector, cranks[k] or 0.0, mirrored):
            unlike.append("sector, counted from the own crank,")
        for name, kind in CHOICES.items():
            options, other = (
                [] if own is None else kind.options(own) for own in (getattr(first, name), getattr(web, name))
            )
            if not _same_options(options, at or 0.0, other, cranks[k] or 0.0, mirrored):
                from_crank = any(angle is not None for _, angle in (*options, *other))
                unlike.append(f"{name}, counted from the own crank," if from_crank else name)
        if unlike:
            words = " and ".join(unlike)
            yield FieldProblem(path, f"webs of a group are equal castings: its {words} must equal that of {first.name}")


def _same_options(first: Sequence[Option], at: float, other: Sequence[Option], there: float, mirrored: bool) -> bool:
    """Whether options are the same, in the same places or each other's mirror images as seen from the own cranks."""
    sign, image, two = -1.0 if mirrored else 1.0, _at_angles(first, at), _at_angles(other, there)
    image[:, 1] *= sign
    alike = len(image) == len(two) and _masses(first) == _masses(other)
    # a hair below a whole turn is 0
    return alike and all(
        bool(np.any((image[:, 0] == mass) & (np.abs((image[:, 1] - angle + 180.0) % 360.0 - 180.0) <= 1e-9)))
        for mass, angle in two.tolist()
    )


def _masses(options: Sequence[Option]) -> list[float]:
    """Masses of options that leave the angle open."""
    return sorted(mass for mass, angle in options if mass is not None and angle is None)


def _at_angles(options: Sequence[Option], crank: float) -> Real:
    """Masses [kg], 0 where they are left open, and angles from a crank [deg] of options that have angles (N, 2)."""
    return np.array([(mass or 0.0, at - crank) for mass, at in options if at is not None]).reshape(-1, 2)


def _same_sector(first: Any, at: float, other: Any, there: float, mirrored: bool) -> bool:
    """Whether two sectors are the same, or each other's mirror image, as seen from the own cranks."""
    if first is None or other is None:
        return first is other
    from_crank = first.centre_deg - at
    off = other.centre_deg - there - (-from_crank if mirrored else from_crank)
    return abs((off + 180.0) % 360.0 - 180.0) <= 1e-9 and bool(first.half_angle_deg == other.half_angle_deg)
