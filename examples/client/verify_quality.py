"""The balance quality of a shaft (ISO 21940-11): the unbalance in two planes, and the grade that it comes to.

A grade G permits G m / Omega, shared by the planes as U_A : U_B = (z_B - z_G) : (z_G - z_A), each within 0.3 and 0.7.
The force f and the moment c about the origin, over Omega^2, are those of U_B = (c - z_A f) / (z_B - z_A) and
U_A = f - U_B.
"""

from __future__ import annotations

from typing import Sequence

from verify_claims import Claims, near
from verify_machine import Machine, Mass
from verify_numbers import ABOUT_ONE, BLUR, ONE, PI, ZERO, Number, Place, direction, largest, real

LEAST, MOST = 0.3, 0.7  # share of the permissible unbalance that a plane has


def quality(design: Place, machine: Machine, entry: Place, turning: Sequence[Mass]) -> Claims:
    """Without counterweights, and with them."""
    demand = design / "balance_quality"
    omega = (design / "speed_rpm").number(least=0) * Number(PI, PI + 1) / Number(30 * 10**80, 30 * 10**80)
    grade = (demand / "grade_mm_s").number()
    permitted = grade * real(1 / 1000) * ABOUT_ONE * (demand / "mass_kg").number() / omega
    yield near("balance_quality", entry / "permissible_kg_m", permitted)
    ends = [(demand / f"plane_{letter}_m").double() for letter in "ab"]
    share = (ends[1] - (demand / "centre_of_mass_m").double()) / (ends[1] - ends[0])
    share = min(max(share, LEAST), MOST)
    most = [permitted * real(part) * ABOUT_ONE for part in (share, 1 - share)]
    for when, weights in (("before", []), ("after", turning)):
        planes = _in_planes(machine, weights, *ends)
        reached = largest(*(abs(vector) / limit for vector, limit in zip(planes, most)))
        yield near("balance_quality", entry / when / "grade_mm_s", grade * reached)
        for name, end, vector, limit in zip("ab", ends, planes, most):
            place = entry / when / f"plane_{name}"
            yield near("balance_quality", place / "position_m", real(end))
            yield near("balance_quality", place / "permissible_kg_m", limit)
            yield near("balance_quality", place / "unbalance_kg_m", abs(vector))
            way = direction((place / "angle_deg").double()) + BLUR
            yield "balance_quality", place / "angle_deg", -abs(vector - way * abs(vector)), abs(vector)


def _in_planes(machine: Machine, weights: Sequence[Mass], first: float, second: float) -> Sequence[Number]:
    in_first = in_second = ZERO
    for mass in (*machine.masses, *weights):
        if mass.co is ZERO:
            continue
        u = (mass.co + machine.blur) * mass.product * machine.wide
        share = (mass.position * machine.wide - real(first)) * _inverse(second - first)
        in_second = in_second + u * share
        in_first = in_first + u * (ONE - share)
    return in_first, in_second


def _inverse(number: float) -> Number:
    inverse = ABOUT_ONE / real(abs(number))
    return inverse if number > 0 else -inverse
