"""The ten tables of the 2D12-90/2-20, every figure that stands; and those that do not.

The design calculation of the 2D12 prints tables 1 to 10 in steps of 10 degrees. The columns of one table differ from
ours by no more than their printing, where the source does not err.
"""

from collections.abc import Iterator

import numpy as np

from optimizer.analyze import analyze
from optimizer.rating.rate import rate
from schemas.request.requests import AnalyzeRequest
from tests.rating.design import request as request_of_rating
from tests.reference import compressor
from tests.reference.columns import ROTATING, ROUNDED, figures, rounding
from tests.validation.comparison import Comparison, Misprint

MACHINE = "2D12-90/2-20"
SOURCE = "Design calculation of the 2D12-90/2-20 compressor"
#: number of the printed table, and its columns by the names of tests/reference/tables
TABLES = {
    "1": ("x_mm", "x_crank_mm", "c_series", "a_series"),
    "2": ("I_head_MPa", "I_head_kN"),
    "3": ("I_crank_MPa", "I_crank_kN"),
    "4": ("II_head_MPa", "II_head_kN"),
    "5": ("II_crank_MPa", "II_crank_kN"),
    "6": ("I_gas_kN", "II_gas_kN"),
    "7": ("I_inertia_kN", "II_inertia_kN"),
    "8": ("I_sum_kN", "I_tangential_kN", "factor"),
    "9": ("II_sum_kN", "II_tangential_kN"),
    "10": ("tangential_kN",),
}
_UNITS = {"mm": "mm", "MPa": "MPa", "kN": "kN", "factor": "-", "c_series": "m/s", "a_series": "m/s2"}


def comparisons() -> Iterator[Comparison]:
    """One for each column: the largest difference to the printed figures that stand, as ours less theirs."""
    printed, numbers = compressor.table("printed"), figures(ROUNDED)
    moving = printed["angle_deg"] % 180.0 != 0.0
    for number, columns in TABLES.items():
        for name in columns:
            # where the piston stands still the source gives friction a sign, and we none
            stands = np.isfinite(printed[name]) & (moving if name.endswith("sum_kN") else True)
            off = np.where(stands, numbers[name] - printed[name], 0.0)
            worst = int(np.argmax(np.abs(off)))
            quantity = f"table {number}, {name}: worst of {int(np.sum(stands))} figures"
            unit = _UNITS.get(name, _UNITS.get(name.rsplit("_", 1)[-1], "-"))
            theirs, ours = float(printed[name][worst]), float(numbers[name][worst])
            yield Comparison(MACHINE, quantity, "published", theirs, ours, rounding(name), unit)


def misprints() -> Iterator[Misprint]:
    """Printed figures that are wrong, with the corrected ones, recomputed apart from the mechanics."""
    numbers, right = figures(ROTATING), compressor.table("corrected")

    def at(place: str, name: str, angle: int, printed: float, reason: str) -> Misprint:
        k = angle // 10
        expected, ours = float(right[name][k]), float(numbers[name][k])
        compared = Comparison(MACHINE, f"{name} at {angle} deg", "analytic", expected, ours, 6e-5, "kN")
        return Misprint(SOURCE, place, printed, compared, reason)

    yield at("table 2, 40 deg", "I_head_kN", 40, -105.774, "expansion is carried on below the suction pressure")
    yield at("table 2, 280 deg", "I_head_kN", 280, -321.982, "compression from 0.288 MPa and a clearance of 18 mm")
    yield at("table 6, 290 deg", "I_gas_kN", 290, -199.62, "suction pressure of stage II in place of 0.852 MPa")
    yield at("table 8, 290 deg", "I_tangential_kN", 290, 184.41, "follows from table 6")
    yield at("table 10, 290 deg", "tangential_kN", 290, 398.29, "follows from tables 8 and 9")
    yield from _over_the_turn()


def _over_the_turn() -> Iterator[Misprint]:
    request = {"machine": compressor.machine(), "outputs": ["torque", "flywheel"], "angles": {"step_deg": 10}}
    answer = analyze(AnalyzeRequest.model_validate(request))
    assert answer.torque is not None
    assert answer.flywheel is not None
    mean = Comparison(
        MACHINE, "mean tangential force", "analytic", 176.10, answer.torque.mean_torque_Nm / 140.0, 0.35, "kN"
    )
    reason = "mean of 37 rows, in which 0 and 360 degrees are the same; and tables 8 and 9"
    yield Misprint(SOURCE, "2-24, T_m", 164.40, mean, reason)
    work = Comparison(
        MACHINE, "fluctuation of energy", "analytic", 28.73, answer.flywheel.fluctuation_energy_J / 1e3, 0.02, "kJ"
    )
    yield Misprint(SOURCE, "2-27, L", 18.55, work, "F4 + F5 is no range of the running sum, whose areas do not close")
    inertia = Comparison(MACHINE, "MD2 for 1/100", "analytic", 4192.0, answer.flywheel.inertia_MD2_kg_m2, 3.0, "kg m2")
    yield Misprint(SOURCE, "2-28, MD2", 2700.0, inertia, "follows from 2-27")
    power = rate(request_of_rating(mean_piston_speed_m_s=4.0)).shaft_power_W / 1e3
    shaft = Comparison(MACHINE, "shaft power N_z", "analytic", 1191.3 / 0.94, power, 0.5, "kW")
    yield Misprint(SOURCE, "table 2-1, shaft power", 1191.3, shaft, "that is the indicated power")
