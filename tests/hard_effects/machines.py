"""Machines that are hard on the effects over the turn, as clients post them, each with the reason."""

from typing import Any, NamedTuple


class Hard(NamedTuple):
    """A machine and why its effects are hard to evaluate."""

    name: str
    why: str
    body: dict[str, Any]
    #: what one unit in the last place of the data does to the result, in such units
    condition: float = 1.0


def cylinder(**rest: Any) -> dict[str, Any]:
    return {
        "bore_m": 0.3,
        "piston_rod_diameter_m": 0.06,
        "suction_pressure_Pa": 1e5,
        "discharge_pressure_Pa": 3.3e5,
        "relative_clearance": 0.1,
        "expansion_exponent": 1.2,
        "compression_exponent": 1.35,
        **rest,
    }


def row(axis_deg: float, length_m: float | None, mass_kg: float = 20.0, **gas: Any) -> dict[str, Any]:
    return {
        "axis_deg": axis_deg,
        "reciprocating_mass_kg": mass_kg,
        "connecting_rod": {"length_m": length_m, "mass_kg": 0.0},
        "cylinder": cylinder(**gas),
    }


def single_throw(*rows: dict[str, Any], radius_m: float = 0.1, crank_deg: float = 17.0, **rest: Any) -> dict[str, Any]:
    """Rows on one throw."""
    throw = {
        "position_m": 0.0,
        "crank_radius_m": radius_m,
        "crank_angle_deg": crank_deg,
        "rotating_mass_kg": 8.0,
        "rows": list(rows),
    }
    return {"kind": "reciprocating", "speed_rpm": 600.0, "throws": [throw], **rest}


def two(first: dict[str, Any], second: dict[str, Any], cranks_deg: tuple[float, float], **rest: Any) -> dict[str, Any]:
    """Two throws with a row each."""
    machine = single_throw(first, crank_deg=cranks_deg[0], **rest)
    throw = single_throw(second, crank_deg=cranks_deg[1])["throws"][0]
    return {**machine, "throws": [*machine["throws"], {**throw, "position_m": 0.4}]}


_LIGHT = {"bore_m": 1e-6, "piston_rod_diameter_m": 0.0, "discharge_pressure_Pa": 1e5}
_VACUUM = {"acting": "head", "ambient_pressure_Pa": 0.0}
_FRICTION = {"reciprocating_force_N": [1e6], "rotating_torque_Nm": 123.0}
_STEEP = "rod hardly longer than its crank: the piston stops and starts within {0} rad of 90 and 270 degrees"

MACHINES = (
    Hard("ordinary V", "none: what every other one is compared with", single_throw(row(45, 0.5), row(135, 0.5))),
    Hard("rod 1.1 r", _STEEP.format("0.4"), single_throw(row(0, 0.11))),
    Hard("rod 1.001 r", _STEEP.format("0.045"), single_throw(row(0, 0.1001))),
    Hard("rod 1.00001 r", _STEEP.format("0.0045"), single_throw(row(0, 0.100001))),
    Hard("rod 1.0000001 r", _STEEP.format("0.00045"), single_throw(row(0, 0.10000001)), 4.0),
    Hard(
        "rod 1.0000001 r, turning clockwise beside an ordinary row",
        _STEEP.format("0.00045") + "; breaks of two rows interleave",
        single_throw(row(30, 0.10000001, 3.0), row(77, 0.45), rotation="cw"),
        4.0,
    ),
    Hard("rod 1e10 r", "obliquity is 1e-10 of the motion: l - sqrt(l^2 - ...) cancels", single_throw(row(0, 1e9))),
    Hard("infinite rod", "every quotient by the rod's length must vanish", single_throw(row(0, None), row(90, None))),
    Hard(
        "clearance of 1e-6",
        "pressure falls within 1e-3 rad of the dead centre; stroke - travel cancels on the crank side",
        single_throw(row(10, 0.4, relative_clearance=1e-6)),
    ),
    Hard(
        "clearance of 1e-6, pressure ratio 100",
        "as before, and re-expansion over two decades of pressure",
        single_throw(row(10, 0.4, relative_clearance=1e-6, discharge_pressure_Pa=1e7)),
    ),
    Hard(
        "pressure ratio 100",
        "large part of the stroke is re-expansion; singular at a negative volume near the dead centre",
        single_throw(row(10, 0.4, relative_clearance=0.005, discharge_pressure_Pa=1e7, expansion_exponent=1.3)),
    ),
    Hard(
        "pressure ratio 1000, re-expansion over half the stroke",
        "volumes from 1 to 1000 in one process, whose singularity is 1/30 of its length away",
        single_throw(row(10, 0.4, relative_clearance=5e-4, discharge_pressure_Pa=1e8, expansion_exponent=1.001)),
    ),
    Hard(
        "pressure ratio 1 + 1e-10",
        "valves open at the dead centres, where angles cost half the digits; indicated work cancels to 1e-10",
        single_throw(row(10, 0.4, discharge_pressure_Pa=1e5 * (1 + 1e-10))),
    ),
    Hard(
        "pressures two doubles apart",
        "switching angles of 1e-9 rad beside the dead centres; work of 1e-16 of its parts",
        single_throw(row(10, 0.4, suction_pressure_Pa=1e5, discharge_pressure_Pa=1e5 + 3e-11)),
    ),
    Hard(
        "rod 1.0000001 r and clearance of 1e-6",
        "the piston dwells at its inner dead centre for a third of the turn while the crank side is almost empty",
        single_throw(row(10, 0.10000001, 1.0, relative_clearance=1e-6)),
        4.0,
    ),
    Hard(
        "pressure ratio 1",
        "no compression at all: work is exactly 0",
        single_throw(row(10, 0.4, discharge_pressure_Pa=1e5)),
    ),
    Hard(
        "clearance of 100, just delivering",
        "delivery is the last 2e-4 of the stroke; work is a small difference of two polytropes",
        single_throw(
            row(
                10,
                0.4,
                relative_clearance=100.0,
                discharge_pressure_Pa=1.0129e5,
                expansion_exponent=1.3,
                compression_exponent=1.3,
            )
        ),
    ),
    Hard(
        "exponents 1 + 2e-16 and 10",
        "x^(1-n)/(1-n) is 0/0 at n = 1; 10 multiplies relative errors of the volume",
        single_throw(row(10, 0.4, expansion_exponent=1.0 + 2.3e-16, compression_exponent=10.0)),
    ),
    Hard(
        "friction alone",
        "torque jumps by itself at the dead centres; gas and inertia are nothing",
        single_throw(row(0, 0.4, 0.0, **_LIGHT), friction=_FRICTION),
    ),
    Hard(
        "open to a vacuum",
        "ambient pressure of 0: quotients of pressures are 0/0 on that side",
        single_throw(row(200, 0.3, **_VACUUM)),
    ),
    Hard(
        "kinetic energies that cancel",
        "infinite rods a quarter apart: kinetic energy is constant and 1e7 times what is left",
        single_throw(row(0, None, 50.0, **_LIGHT), row(90, None, 50.0, **_LIGHT), speed_rpm=6000.0),
    ),
    Hard(
        "gas against gas",
        "equal rows opposed on cranks half a turn apart: torques are equal, extremes come in ties",
        two(row(0, 0.4), row(180, 0.4), (0.0, 180.0)),
    ),
    Hard("0.01 rpm", "inertia is 1e-9 of the gas", single_throw(row(10, 0.4), row(100, 0.4), speed_rpm=0.01)),
    Hard("1e6 rpm", "gas is 1e-9 of the inertia", single_throw(row(10, 0.4), row(100, 0.4), speed_rpm=1e6)),
    Hard(
        "crank radius 1e-6 m",
        "lengths of 1e-6 m, masses of 1e-9 kg",
        single_throw(row(10, 4e-6, 1e-9, bore_m=1e-6, piston_rod_diameter_m=1e-7), radius_m=1e-6),
    ),
    Hard(
        "efficiency of 1 - 1e-9",
        "1/eta - 1 cancels",
        single_throw(row(10, 0.4), friction={"mechanical_efficiency": 1 - 1e-9, "reciprocating_share": 0.7}),
    ),
    Hard(
        "three rows of every kind",
        "steep rod, tiny clearance and an open side together, on two throws, clockwise",
        two(
            row(0, 0.1001, 1.0, relative_clearance=1e-6),
            row(120, 0.7, 300.0, acting="crank", ambient_pressure_Pa=3e5),
            (12.0, 251.0),
            rotation="cw",
            friction={"mechanical_efficiency": 0.9, "reciprocating_share": 0.4},
        ),
    ),
)
