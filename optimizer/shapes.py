"""Counterweights that are cut from a plate: the webs of a machine that say from which, and what is fitted to them.

A fitted counterweight has a radius of its own, so what is fitted stands on a machine of plain webs.
"""

from collections.abc import Mapping

import numpy as np

from optimizer.arrays import Real
from optimizer.mechanics.envelope import AnnularSector, Envelope, Segment, opened_for
from optimizer.remembered import remembered
from schemas.machine import Machine
from schemas.webs import Web

_SHAPES: Mapping[str, type[AnnularSector | Segment]] = {"sector": AnnularSector, "segment": Segment}


@remembered
def envelopes(machine: Machine) -> dict[int, Envelope]:
    """The plates of the webs that have one, by number of the web."""
    return {
        k: _SHAPES[plate.shape](
            np.asarray(plate.inner_radius_m),
            np.asarray(plate.outer_radius_m),
            np.asarray(plate.thickness_m * plate.density_kg_m3),
            np.deg2rad(plate.max_half_angle_deg),
        )
        for k, plate in enumerate(web.envelope for web in machine.webs)
        if plate is not None
    }


def fitted(machine: Machine, half_angles: Mapping[int, float]) -> Machine:
    """The machine with the radius of the counterweight that every plate comes to.

    Parameters
    ----------
    half_angles : rad, by number of the web; 0 has the radius that a first gram would have.
    """
    plates = envelopes(machine)
    if not plates:
        return machine
    webs = [_fitted(web, plates[k], half_angles[k]) if k in plates else web for k, web in enumerate(machine.webs)]
    return machine.model_copy(update={"webs": tuple(webs)})


def fitted_masses(machine: Machine, mass_kg: Real) -> Machine:
    """The same for masses (K,) that are on the machine."""
    return fitted(machine, {k: float(opened_for(plate, mass_kg[k])) for k, plate in envelopes(machine).items()})


def _fitted(web: Web, plate: Envelope, half_angle: float) -> Web:
    mass = float(plate.mass(half_angle))
    radius = float(plate.unbalance(half_angle)) / mass if mass > 0.0 else float(plate.lever(0.0))
    return web.model_copy(update={"counterweight_radius_m": radius})
