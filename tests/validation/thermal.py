"""Thermal rating of the 2D12-90/2-20: the printed figures of chapter 1 of its design calculation."""

from collections.abc import Iterator

from optimizer.rating.rate import rate
from tests.rating.design import request, rods
from tests.validation.comparison import Comparison


def comparisons() -> Iterator[Comparison]:
    """With the source's own choices: 0.79 MPa between the stages, 4.0 m/s, and rods of 90 mm, then 110 mm."""
    choices = {"mean_piston_speed_m_s": 4.0, "interstage_pressures_Pa": ["0.79 MPa"]}
    built, first = (rate(request(*rods(rod), **choices)) for rod in (0.11, 0.09))
    # the coefficients are of equal ratios
    equal = rate(request(*rods(0.11), mean_piston_speed_m_s=4.0))

    def line(quantity: str, expected: float, ours: float, allowed: float, unit: str) -> Comparison:
        return Comparison("2D12-90/2-20", quantity, "published", expected, ours, allowed, unit)

    printed = zip(
        ("I", "II"),
        built.stages,
        first.stages,
        equal.stages,
        (0.8822, 0.8664),
        (0.7763, 0.7790),
        (0.2319, 0.0864),
        (0.730, 0.450),
        (-206.3831, -211.318),
        (0.286, 0.760),
        (0.852, 2.224),
        (608.3, 583.0),
        strict=True,
    )
    for name, stage, thin, split, volumetric, delivery, swept, bore, load, suction, discharge, power in printed:
        design_coefficients = split.design_coefficients
        yield line(f"1-5, volumetric coefficient {name}", volumetric, design_coefficients.volumetric, 5e-5, "-")
        yield line(f"1-4, delivery coefficient {name}", delivery, design_coefficients.delivery, 3.5e-4, "-")
        yield line(f"1-8, 1-9, swept volume {name}", swept, stage.calculated.swept_volume_m3, 3.5e-4, "m3")
        yield line(f"1-17, bore {name}", bore, stage.calculated.bore_m, 1e-3, "m")
        gas = thin.nominal_loads.outer.gas_force_N / 1e3
        yield line(f"1-13, 1-15, outer gas force {name}", load, gas, 0.45, "kN")
        low, high = stage.in_cylinder.suction_pressure_Pa / 1e6, stage.in_cylinder.discharge_pressure_Pa / 1e6
        yield line(f"1-25, suction pressure in the cylinder {name}", suction, low, 4e-3, "MPa")
        yield line(f"1-25, discharge pressure in the cylinder {name}", discharge, high, 9e-3, "MPa")
        yield line(f"1-29, indicated power {name}", power, stage.indicated_power_W / 1e3, 6.0, "kW")
    temperatures = [stage.nominal.discharge_temperature_K for stage in built.stages]
    yield line("1-3, discharge temperature", 413.0, temperatures[0], 0.5, "K")
    yield line("1-7, condensate coefficient II", 0.9846, equal.stages[1].condensate_coefficient, 1e-4, "-")
