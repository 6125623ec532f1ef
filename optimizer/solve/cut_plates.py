"""What unbalances come to where they are cut from plates: a machine with the radii of the centres of mass."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from optimizer.formulation.goals import Goals
from optimizer.formulation.limits import limits
from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.plates import Plates
from optimizer.mechanics.shapes import fitted, plates
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.equal_castings import Alike
from optimizer.program.limits import Limits
from schemas.request.requests import OptimizeRequest


class CutPlates(NamedTuple):
    """A request and its problem with the radii of what is cut."""

    request: OptimizeRequest
    scene: Prepared
    asked: Goals


def cut_plates(request: OptimizeRequest, scene: Prepared, asked: Goals, u: Complex, reached: Limits) -> CutPlates:
    """The same with the radii that unbalances (K,) kg m come to; all as it was where no web has a plate.

    Parameters
    ----------
    reached : limits that the proofs count with.
    """
    of_machine = plates(request.machine)
    if of_machine is None:
        return CutPlates(request, scene, asked)
    angle = openings(of_machine, u, reached.alike)
    request = request.model_copy(update={"machine": fitted(request.machine, angle)})
    # the price of a budget is that of its pieces: what a plate is worth is told where it is full
    within = limits_of_cut(limits(request.machine), reached, of_machine, of_machine.most)
    return CutPlates(
        request, replace(scene, request=request), replace(asked, program=asked.program.changed(limits=within))
    )


def openings(of_machine: Plates, u: Complex, alike: Alike | None) -> Real:
    """Half-angles (P,) of what is cut for unbalances (K,), of alike webs alike, rad."""
    angle = of_machine.opened(np.abs(u[of_machine.webs]))
    if alike is None:
        return angle
    return angle[np.searchsorted(of_machine.webs, np.array(alike.leader)[of_machine.webs])]


def limits_of_cut(stated: Limits, reached: Limits, of_machine: Plates, edge: Real) -> Limits:
    """Limits of webs with the radii of what is cut; what the others may reach at most is as it was proven.

    Parameters
    ----------
    edge : (P,) half-angles at which one more kilogram is added, rad.
    """
    most, margin = reached.max_mass.copy(), stated.radius.copy()
    most[..., of_machine.webs] = stated.max_mass[..., of_machine.webs]
    margin[..., of_machine.webs] = of_machine.lever(edge)
    return replace(stated, max_mass=most, marginal_radius=margin)
