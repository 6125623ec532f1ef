"""Counterweights that are cut from a plate: the webs of a machine that say from which, and what is fitted to them.

A fitted counterweight has a radius of its own, so what is fitted stands on a machine of plain webs.
"""

from collections.abc import Mapping

import numpy as np

from optimizer.arrays import Real
from optimizer.mechanics.envelope import AnnularSector, Segment
from optimizer.mechanics.plates import Plates
from optimizer.remembered import remembered
from schemas.machine import Machine

_SHAPES: Mapping[str, type[AnnularSector | Segment]] = {"sector": AnnularSector, "segment": Segment}


@remembered
def plates(machine: Machine) -> Plates | None:
    """The plates of the webs that have one; None where no web has."""
    webs = [k for k, web in enumerate(machine.webs) if web.envelope is not None]
    if not webs:
        return None
    given = [machine.webs[k].envelope for k in webs]
    figures = [
        (
            each.shape,
            each.inner_radius_m,
            each.outer_radius_m,
            each.thickness_m * each.density_kg_m3,
            each.max_half_angle_deg,
        )
        for each in given
        if each is not None
    ]
    parts = []
    for shape, made in _SHAPES.items():
        places = np.array([n for n, each in enumerate(figures) if each[0] == shape], dtype=int)
        if places.size:
            inner, outer, areal, most = np.array([figures[n][1:] for n in places]).T
            parts.append((places, made(inner, outer, areal, np.deg2rad(most))))
    return Plates(np.array(webs), np.array([figures.index(each) for each in figures]), parts)


def fitted(machine: Machine, half_angle: Real) -> Machine:
    """The machine with the radius of the counterweight that every plate comes to.

    Parameters
    ----------
    half_angle : (P,) rad, of its plates; 0 has the radius that a first gram would have.
    """
    cut = plates(machine)
    if cut is None:
        return machine
    mass, webs = cut.mass(half_angle), list(machine.webs)
    fits = mass > 0.0
    radius = np.where(fits, cut.unbalance(half_angle) / np.where(fits, mass, 1.0), cut.lever(np.zeros(mass.shape)))
    for k, each in zip(cut.webs.tolist(), radius.tolist(), strict=True):
        webs[k] = webs[k].model_copy(update={"counterweight_radius_m": each})
    return machine.model_copy(update={"webs": tuple(webs)})


def fitted_masses(machine: Machine, mass_kg: Real) -> Machine:
    """The same for masses (K,) that are on the machine."""
    cut = plates(machine)
    return machine if cut is None else fitted(machine, cut.opened_for(mass_kg[cut.webs]))
