"""What turns with the shaft in the two outermost planes of the webs: mass times radius that removes it.

u1 + u2 = -f and z1 u1 + z2 u2 = -c of a force f and its couple c about the middle of the machine, over the square of
the speed, so that u1 = (c - z2 f) / (z2 - z1) and u2 = (z1 f - c) / (z2 - z1). In one plane it is -f alone.
"""

from __future__ import annotations

from typing import List, Sequence

from verify_claims import Claims, figure, same
from verify_machine import Machine, Mass
from verify_numbers import ABOUT_ONE, ONE, ZERO, Number, Place, real, total

#: m: planes closer than this are one
SAME_PLANE = 1e-12


def ends(machine: Machine) -> List[float]:
    """The outermost planes of the webs [m]; none without webs."""
    planes = [web.position.middle().real for web in machine.webs]
    if not planes:
        return []
    low, high = min(planes), max(planes)
    return [low, high] if high - low > SAME_PLANE else [low]


def opposed(machine: Machine, masses: Sequence[Mass], planes: Sequence[float]) -> List[Number]:
    """What removes these masses, as vectors at shaft angle 0 [kg m]; of no plane as of one."""
    turning = [(mass, mass.product * machine.wide * (mass.co + machine.blur)) for mass in masses if mass.co is not ZERO]
    force = total(size for _, size in turning)
    if len(planes) < 2:
        return [-force]
    # about the middle, as the service takes it: where that is far away, digits are lost there too
    middle = machine.centre * machine.wide
    couple = total(size * (mass.position * machine.wide - middle) for mass, size in turning)
    low, high = (real(plane) * machine.wide - middle for plane in planes)
    apart = (real(planes[1]) - real(planes[0])) * ABOUT_ONE
    return [(couple - high * force) / apart, (low * force - couple) / apart]


def missing(machine: Machine, masses: Sequence[Mass], planes: Sequence[float]) -> Number:
    """Mass times radius of all of it [kg m]."""
    return total(map(abs, opposed(machine, masses, planes)))


def iron(claim: str, machine: Machine, place: Place, planes: Sequence[float]) -> Claims:
    """Plane by plane: against the rotating masses, and against all that rows bring to turn."""
    entries = list(place)
    yield claim, place, ONE if len(entries) == len(planes) else -ONE, ONE
    against = {
        "rotating": [mass for mass in machine.masses if mass.counter is ZERO],
        "reciprocating": [mass for mass in machine.masses if mass.counter is not ZERO],
    }
    vectors = {name: opposed(machine, masses, planes) for name, masses in against.items()}
    for k, (entry, plane) in enumerate(zip(entries, planes)):
        yield same(claim, entry / "position_m", plane)
        # half of what moves along a row turns with the shaft: iron against all of it is twice as much
        for name, times in (("rotating", ONE), ("reciprocating", real(2))):
            vector = vectors[name][k] * times
            for axis, part in zip("xy", vector.parts()):
                yield figure(claim, entry / f"{name}_{axis}_kg_m", part, abs(vector))
