"""The first-order moment inside the shaft: the couple of all forces on one side of a plane, about that plane.

It is linear between the planes of the masses, so it is largest in one of them. Of both sides the larger counts.
"""

from __future__ import annotations

from typing import List, Optional, Sequence, Tuple

from verify_answer import Fitted
from verify_bearings import SAMPLE, within
from verify_claims import Claims, same
from verify_machine import Machine, Mass
from verify_numbers import Place

Force = Tuple[float, complex, complex]  # plane [m], phasors with and against the shaft [N]


def internal_moment(machine: Machine, place: Place, there: Optional[Fitted]) -> Claims:
    """Without and with counterweights."""
    square = machine.square.middle().real
    own = _forces(machine.masses, square)
    sides: List[Tuple[str, Sequence[Force]]] = [("before_Nm", own)]
    if there is None:
        yield same("internal_moment", place / "after_Nm", None)
    else:
        sides.append(("after_Nm", [*own, *_forces(there.turning, square)]))
    for field, forces in sides:
        planes = sorted({force[0] for force in forces})
        value = max((max(_couple(forces, plane, way) for way in (1, -1)) for plane in planes), default=0.0)
        size = sum(abs(co) + abs(counter) for _, co, counter in forces) * (planes[-1] - planes[0]) if planes else 0.0
        yield within("internal_moment", place / field, value, value, SAMPLE * size)


def _forces(masses: Sequence[Mass], square: float) -> List[Force]:
    return [
        (
            mass.position.middle().real,
            mass.product.middle().real * square * mass.co.middle(),
            mass.product.middle().real * square * mass.counter.middle(),
        )
        for mass in masses
    ]


def _couple(forces: Sequence[Force], plane: float, way: int) -> float:
    """Of what is on one side of a plane, at most over the revolution."""
    arms = [(max(way * (plane - where), 0.0), co, counter) for where, co, counter in forces]
    return abs(sum(arm * co for arm, co, _ in arms)) + abs(sum(arm * counter for arm, _, counter in arms))
