"""Counterweights that are cut from a plate: the webs of a machine that say from which, and what is fitted to them.

A fitted counterweight has a radius of its own, so what is fitted stands on a machine of plain webs.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache

import numpy as np

from optimizer.mechanics.envelope import AnnularSector, Segment
from optimizer.mechanics.plates import Plates
from optimizer.numerics.arrays import Real
from optimizer.numerics.memoization import remembered
from schemas.base.rules import Path
from schemas.base.variation import with_fields
from schemas.machine.machine import Machine
from schemas.machine.webs import Envelope

#: from half-angles of plates, rad
_CutMachine = Callable[[tuple[float, ...]], Machine]
_SHAPES: Mapping[str, type[AnnularSector | Segment]] = {"sector": AnnularSector, "segment": Segment}


@remembered
def plates(machine: Machine) -> Plates | None:
    """The plates of the webs that have one; None where no web has."""
    envelopes = tuple(web.envelope for web in machine.webs)
    return _side_by_side(envelopes) if any(envelopes) else None


def every_plate(machine: Machine) -> Plates | None:
    """The same of all webs of a machine, those of its balance shafts behind those of the crankshaft."""
    envelopes = tuple(web.envelope for web in machine.every_web)
    return _side_by_side(envelopes) if any(envelopes) else None


@lru_cache(maxsize=8)
def _side_by_side(envelopes: tuple[Envelope | None, ...]) -> Plates:
    """The plates of the webs, which machines have in common whose counterweights differ."""
    cut = [(k, envelope) for k, envelope in enumerate(envelopes) if envelope is not None]
    parts = []
    for shape, plates_of in _SHAPES.items():
        places = np.array([n for n, (_, plate) in enumerate(cut) if plate.shape == shape], dtype=int)
        if places.size:
            of_shape = [cut[n][1] for n in places]
            figures = [
                (plate.inner_radius_m, plate.outer_radius_m, plate.thickness_m * plate.density_kg_m3)
                for plate in of_shape
            ]
            inner, outer, areal = np.array(figures).T
            parts.append(
                (places, plates_of(inner, outer, areal, np.deg2rad([plate.max_half_angle_deg for plate in of_shape])))
            )
    kinds = [envelopes.index(plate) for _, plate in cut]
    return Plates(np.array([k for k, _ in cut]), np.array(kinds), parts)


def fitted(machine: Machine, half_angle: Real) -> Machine:
    """The machine with the radius of the counterweight that every plate comes to.

    Parameters
    ----------
    half_angle : (P,) rad, of its plates; 0 has the radius that a first gram would have.
    """
    cut = plates(machine)
    return machine if cut is None else _of_webs(machine)(tuple(half_angle.tolist()))


def fitted_everywhere(machine: Machine, half_angle: Real) -> Machine:
    """The same of all plates (P,), those of balance shafts behind those of the crankshaft."""
    cut = every_plate(machine)
    return machine if cut is None else _of_every_web(machine)(tuple(half_angle.tolist()))


@remembered
def _of_webs(machine: Machine) -> _CutMachine:
    """Fits the plates of a machine; the machine of the last verdict is also that of the answer, with its properties."""
    return _cut_machine(machine, plates(machine), [("webs", k) for k in range(len(machine.webs))])


@remembered
def _of_every_web(machine: Machine) -> _CutMachine:
    paths = [(*path, k) for path, webs in machine.web_lists() for k in range(len(webs))]
    return _cut_machine(machine, every_plate(machine), paths)


def _cut_machine(machine: Machine, cut: Plates | None, paths: Sequence[Path]) -> _CutMachine:
    """From half-angles of plates to the machine with their radii; webs by their paths."""
    assert cut is not None  # else nothing is to be cut

    @lru_cache(maxsize=4)
    def with_radii(half_angle: tuple[float, ...]) -> Machine:
        angle = np.array(half_angle)
        mass = cut.mass(angle)
        fits = mass > 0.0
        radius = np.where(fits, cut.unbalance(angle) / np.where(fits, mass, 1.0), cut.lever(np.zeros(mass.shape)))
        at = zip(cut.webs.tolist(), radius.tolist(), strict=True)
        return with_fields(machine, {(*paths[k], "counterweight_radius_m"): value for k, value in at})

    return with_radii


def closed(machine: Machine) -> Machine:
    """The machine with the radius of a first gram of every plate."""
    cut = plates(machine)
    return machine if cut is None else fitted(machine, np.zeros(cut.webs.size))


def closed_everywhere(machine: Machine) -> Machine:
    """The same with the plates of its balance shafts."""
    cut = every_plate(machine)
    return machine if cut is None else fitted_everywhere(machine, np.zeros(cut.webs.size))


def fitted_masses(machine: Machine, mass_kg: Real) -> Machine:
    """The same for masses (K + S,) that are on the machine and its balance shafts."""
    cut = every_plate(machine)
    return machine if cut is None else fitted_everywhere(machine, cut.opened_for(mass_kg[cut.webs]))
