"""The outputs of an answer that look at the rows over a revolution, each by its own file."""

from __future__ import annotations

from typing import Optional

from verify_answer import Fitted
from verify_claims import Claims, covered
from verify_dynamics import gas, kinematics, piston_force
from verify_inside import internal_moment
from verify_machine import Machine
from verify_numbers import NotCovered, Place
from verify_parts import designer_loads
from verify_pistons import Pistons, rows_of
from verify_rods import flywheel, overturning, rod_loads, torque

OUTPUTS = {
    "kinematics": kinematics,
    "gas": gas,
    "piston_force": piston_force,
    "rod_loads": rod_loads,
    "torque": torque,
    "flywheel": flywheel,
    "overturning": overturning,
}


def dynamics(request: Place, machine: Machine, answer: Place, there: Optional[Fitted]) -> Claims:
    """All that an answer holds of the rows over a revolution, and of the moment inside the shaft."""
    if answer / "internal_moment":
        yield from internal_moment(machine, answer / "internal_moment", there)
    names = [name for name in OUTPUTS if answer / name]
    if not names and not answer / "loads":
        return
    fidelity = request / "fidelity" / "kinematics"
    if fidelity.text(default="exact") != "exact":
        raise NotCovered(fidelity)
    pistons = Pistons(request / "machine", machine, list(rows_of(request / "machine")))
    for name in names:
        yield from covered(OUTPUTS[name](request, pistons, answer / name))
    if answer / "loads":
        yield from covered(designer_loads(request, machine, pistons, answer))
