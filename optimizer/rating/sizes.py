"""Swept volumes, areas and bores."""

import math
from typing import Literal

from optimizer.numerics.records import record
from schemas.rating.answer import CylinderSize

Acting = Literal["double", "head", "crank"]

#: ISO 3, a decade of the series R80; every second of them is R40, every fourth R20
# fmt: off
_R80 = (
    100, 103, 106, 109, 112, 115, 118, 122, 125, 128, 132, 136, 140, 145, 150, 155, 160, 165, 170, 175,
    180, 185, 190, 195, 200, 206, 212, 218, 224, 230, 236, 243, 250, 258, 265, 272, 280, 290, 300, 307,
    315, 325, 335, 345, 355, 365, 375, 387, 400, 412, 425, 437, 450, 462, 475, 487, 500, 515, 530, 545,
    560, 580, 600, 615, 630, 650, 670, 690, 710, 730, 750, 775, 800, 825, 850, 875, 900, 925, 950, 975,
)
# fmt: on
_STRIDES = {"R80": 1, "R40": 2, "R20": 4}


def swept_volume(flow: float, speed_rpm: float, delivery: float) -> float:
    """V_h = V_d / (n lam_d) [m^3] that takes in ``flow`` [m^3/min] at the stage's own suction state, (1-8)."""
    return flow / (speed_rpm * delivery)


def stage_flow(flow: float, p_first: float, p: float, T_first: float, T: float, share: float) -> float:
    """Flow [m^3/min] at the suction state of a later stage, (1-9): V_d (p1I/p1)(T1/T1I) mu_d mu_0."""
    return flow * (p_first / p) * (T / T_first) * share


def rod_area(rod: float) -> float:
    """Cross-section [m^2] of a piston rod of this diameter [m]."""
    return math.pi / 4.0 * rod**2


@record(frozen=True)
class Piston:
    """How the pistons of a stage work: number, sides, diameter of the rod [m], stroke [m]."""

    count: int
    acting: Acting
    rod: float
    stroke: float

    def working_area(self, bore: float) -> float:
        """Area [m^2] of the working sides of one cylinder."""
        head = math.pi / 4.0 * bore**2
        crank = head - rod_area(self.rod)
        return {"double": head + crank, "head": head, "crank": crank}[self.acting]

    def size(self, bore: float) -> CylinderSize:
        """Areas, and V_h' = (pi/4)(2 D^2 - d^2) S Z for double-acting cylinders, (1-18)."""
        head = math.pi / 4.0 * bore**2
        return CylinderSize(
            bore_m=bore,
            head_area_m2=head,
            crank_area_m2=head - rod_area(self.rod),
            swept_volume_m3=self.working_area(bore) * self.stroke * self.count,
        )

    def bore(self, swept_volume: float) -> float:
        """Bore [m] that sweeps a volume [m^3] in one turn, (1-10) and (1-17).

        Each cylinder has the working area F/Z = V_h/(S Z). For double-acting ones the head side is
        F_g = (F/Z + f)/2, (1-11), and D = sqrt(2 F/(pi Z) + d^2/2).
        """
        working = swept_volume / (self.stroke * self.count)
        rod = rod_area(self.rod)
        head = {"double": (working + rod) / 2.0, "head": working, "crank": working + rod}[self.acting]
        return math.sqrt(4.0 * head / math.pi)


def nominal_bore(bore: float, series: str) -> float:
    """The bore [m] of a series of preferred numbers in millimetres that is nearest to ``bore`` [m].

    The design calculation of the 2D12 rounds to 730 and 450 mm without naming a series; of ISO 3 only R80 holds both.
    """
    if series == "none":
        return bore
    decade = math.floor(math.log10(bore))
    numbers = [*_R80[:: _STRIDES[series]], 1000]
    scale = 10.0 ** (2 - decade)
    nearest = min(numbers, key=lambda number: abs(number - bore * scale))
    return float(f"{nearest}e{decade - 2}")


def pressure_correction(calculated_first: float, actual_first: float, calculated: float, actual: float) -> float:
    """beta = (V'_hI / V_hI)(V_h / V'_h), (1-19) and (1-20): a stage built too large draws down its suction pressure."""
    return (actual_first / calculated_first) * (calculated / actual)
