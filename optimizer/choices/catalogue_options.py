"""From a machine's catalogue, holes and steps of angle to the options of its webs."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from optimizer.choices.discrete.options import Options
from optimizer.errors import refuse
from optimizer.formulation.balance_shafts import mirror_images
from optimizer.formulation.groups import alike_webs
from optimizer.formulation.limits import largest_mass, sectors
from optimizer.mechanics.angles import direction
from optimizer.mechanics.crank_of_web import crank_angles
from optimizer.numerics.arrays import Real
from schemas.base.model import FieldProblem
from schemas.base.rules import Path
from schemas.machine.catalogue import Catalogue, in_sector
from schemas.machine.choices import own_options
from schemas.machine.machine import Machine
from schemas.request.objective import Objective

#: masses that agree this closely, relative, are one part number
_SAME = 1e-9


class Stock(NamedTuple):
    """The options of every slot, and what they are on its first web."""

    options: Options
    mass_kg: Real  # (K, O)
    angle_deg: Real  # (K, O), 0 where there is nothing

    def fitted(self, selection: np.ndarray) -> tuple[Real, Real]:
        """Masses [kg] and angles [deg] of all webs (W,) with a selection of options (K,)."""
        mass, angle = self.options.of(self.mass_kg, selection), self.options.of(self.angle_deg, selection)
        alike = self.options.alike
        return (mass, angle) if alike is None else alike.fitted(mass[alike.owner], angle[alike.owner])


class Castings(NamedTuple):
    """Webs that take options, among all that a program chooses."""

    webs: np.ndarray  # (K + S,) bool
    mirrored: np.ndarray  # (K + S,) bool: of those the program has the mirror image of what is drawn
    own: int  # K, those of the crankshaft
    paths: tuple[Path, ...]  # (K + S,) in the request

    @classmethod
    def of(cls, machine: Machine, objective: Objective) -> "Castings":
        """Those of the unchanged machine."""
        paths = {path for path, _ in machine.catalogue_webs()}
        every = [(*place, k) for place, webs in machine.web_lists() for k in range(len(webs))]
        return cls(
            np.array([path in paths for path in every], bool),
            mirror_images(machine, objective),
            len(machine.webs),
            tuple(("machine", *path) for path in every),
        )


def stock(machine: Machine, castings: Castings | None = None) -> Stock:
    """What every web of one machine can take, or some of all that a program chooses; webs of a group are one slot.

    Steps of angle count from the own crank, and on a balance shaft from the x axis.

    Raises
    ------
    OutOfRange
        where steps of angle have no crank to count from, none is in the sector of a web, or webs of a group are unlike.
    """
    alike = alike_webs(machine)
    catalogue = machine.catalogue or Catalogue()
    problems: list[FieldProblem] = []
    entries: list[tuple[Real, Real]] = []
    cranks = crank_angles(machine)
    free, centre, half_angle = sectors(machine)
    limit = largest_mass(machine).tolist()
    webs = np.arange(len(machine.webs))
    if castings is not None:
        webs = np.flatnonzero(castings.webs)
        cranks = [*cranks[: castings.own], *(0.0 for _ in cranks[castings.own :])]
        alike = None if alike is None or not np.any(castings.webs[: castings.own]) else alike.only(castings.webs)
    for k in (webs if alike is None else webs[alike.first]).tolist():
        web, most = machine.webs[k], limit[k]
        own, path = own_options(web), ("machine", "webs", k) if castings is None else castings.paths[k]
        # the mirror image of what is drawn
        sign = -1.0 if castings is not None and castings.mirrored[k] else 1.0
        if web.fixed is not None:
            entries.append((np.zeros(1), np.zeros(1)))
            continue
        least = web.min_fitted_mass_kg or 0.0
        if own.pairs is not None:
            pairs = sorted(
                (weight, sign * at % 360.0) for weight, at in own.pairs if 0.0 < weight <= most and weight >= least
            )
            entries.append(
                (np.array([0.0, *(weight for weight, _ in pairs)]), np.array([0.0, *(at for _, at in pairs)]))
            )
            continue
        angles = np.mod(sign * np.array(own.angles or (), dtype=float), 360.0)
        if own.angles is None:
            crank = cranks[k]
            if crank is None:
                problems.append(FieldProblem((*path, "throw"), "steps of angle count from a crank: name the throw"))
                continue
            steps = np.arange(round(360.0 / (catalogue.angle_step_deg or 360.0)))
            angles = np.mod(crank + steps * (catalogue.angle_step_deg or 360.0), 360.0)
            angles = angles[free[k] | in_sector(angles, centre[k], half_angle[k])]
            if not angles.size:
                problems.append(FieldProblem((*path, "sector"), "no step of the angle falls into the sector"))
                continue
        masses = np.array(
            [mass for mass in _masses(own.masses, catalogue, most) if 0.0 < mass <= most and mass >= least]
        )
        weight, at = np.meshgrid(masses, np.sort(angles), indexing="ij")
        entries.append((np.append(0.0, weight), np.append(0.0, at)))
    refuse(problems)
    most_options = max((mass.size for mass, _ in entries), default=1)
    mass, angle = (np.array([np.pad(entry[n], (0, most_options - entry[n].size)) for entry in entries]) for n in (0, 1))
    mass, angle = mass.reshape(len(entries), most_options), angle.reshape(len(entries), most_options)
    radius = np.array([machine.webs[k].radius_m for k in webs.tolist()]).reshape(-1, 1)
    radius = radius if alike is None else radius[alike.first]
    options = Options(
        unbalance=mass * radius * direction(angle),
        mass=mass if alike is None else mass * alike.count[:, None],
        part=_parts(mass),
        exists=np.arange(most_options) < np.array([entry.size for entry, _ in entries]).reshape(-1, 1),
        most_fitted=machine.max_counterweights,
        most_parts=catalogue.max_part_numbers,
        alike=alike,
    )
    return Stock(options, mass, angle)


def _masses(own: Sequence[float] | None, catalogue: Catalogue, most: float) -> Iterator[float]:
    masses = own if own is not None else catalogue.masses_kg
    if masses is not None:
        yield from sorted(masses)
    elif catalogue.mass_step_kg is not None:
        # a hair more, because a quotient of decimals is no whole number
        for n in range(1, int(most / catalogue.mass_step_kg * (1.0 + 1e-12)) + 1):
            yield min(n * catalogue.mass_step_kg, most)


def part_numbers(mass_kg: Real) -> int:
    """How many different masses (K,) there are, those of nothing left out."""
    return int(np.max(_parts(mass_kg), initial=-1)) + 1


def _parts(mass: Real) -> np.ndarray:
    """Part numbers (K, O) of masses: the place of each among all that differ, -1 of none."""
    order = np.argsort(mass, axis=None, kind="stable")
    sorted_masses = mass.ravel()[order]
    new = np.diff(sorted_masses, prepend=0.0) > _SAME * sorted_masses
    numbers = np.empty(mass.size, int)
    numbers[order] = np.cumsum(new) - 1
    return np.where(mass > 0, numbers.reshape(mass.shape), -1)
