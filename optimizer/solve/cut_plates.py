"""What unbalances come to where they are cut from plates: a machine with the radii of the centres of mass."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from optimizer.formulation.counterweights import masses_and_angles
from optimizer.formulation.goals import Goals
from optimizer.formulation.limits import limits
from optimizer.formulation.simulation import Prepared
from optimizer.formulation.task import Task
from optimizer.mechanics.plates import Plates
from optimizer.mechanics.shapes import closed, every_plate, fitted_everywhere, plates
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.equal_castings import Alike
from optimizer.program.limits import Limits
from optimizer.program.methods.plate_sizes import SAME_SIZE
from optimizer.solve.proof import implied_max_mass
from schemas.machine.machine import Machine

#: masses of plates in answers leave room for their rounding
_CUT = 1.0 + 1e-9


class CutPlates(NamedTuple):
    """A task and its problem with the radii of what is cut, and counterweights as they are cut."""

    task: Task
    scene: Prepared
    goals: Goals
    mass: Real  # (K,) kg
    angle: Real  # (K,) degrees


def cut_plates(task: Task, scene: Prepared, goals: Goals, u: Complex, reached: Limits) -> CutPlates:
    """Unbalances (K,) kg m as they are fitted, with the radii that plates come to; all as it was where there are none.

    Parameters
    ----------
    reached : limits that the proofs count with.
    """
    of_machine, machine = every_plate(task.machine), task.space.machine
    if of_machine is None:
        return CutPlates(task, scene, goals, *masses_and_angles(machine, u, reached))
    angle = openings(of_machine, u, reached.alike)
    # plates that differ by what rounding leaves are the same to the last digit
    near = (np.abs(angle[:, None] - angle) <= SAME_SIZE * angle) & (of_machine.kinds[:, None] == of_machine.kinds)
    first, same = np.argmax(near, axis=1), np.arange(u.size)
    angle, same[of_machine.webs] = angle[first], of_machine.webs[first]
    task = replace(task, machine=fitted_everywhere(task.machine, angle))
    # the price of a budget is that of its pieces: a plate has a price of its own where it is full
    machine = task.space.machine
    within = limits_of_cut(limits(machine), reached, of_machine, of_machine.most)
    mass, towards = masses_and_angles(machine, u, within)
    goals = replace(goals, program=goals.program.changed(limits=within))
    return CutPlates(task, replace(scene, machine=task.machine), goals, mass[same], towards)


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


def implied_masses(machine: Machine, limits: Limits) -> dict[str, float]:
    """Masses of limits that proofs count with where those of the machine are larger, kg by web.

    Of a plate it is what is cut for its unbalance.
    """
    smallest = closed(machine)
    implied, cut = implied_max_mass(smallest, limits.max_mass[None])[0], plates(machine)
    if cut is None or not implied:
        return implied
    # within rounding of what is cut
    mass = cut.mass_of(limits.reach[cut.webs]) * _CUT
    of_plates = {machine.webs[k].name: float(value) for k, value in zip(cut.webs, mass, strict=True)}
    return {name: of_plates.get(name, value) for name, value in implied.items()}
