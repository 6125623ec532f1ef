"""Requests of several features together, and random ones, by name: to what no feature alone leads in the checker."""

import copy
from typing import Any

from tests.hard.bodies import drawn
from tests.pairs.asking import body_of
from tests.verification.genuine import with_masses_off
from tests.verification.kinds import SINGLE

Body = dict[str, Any]

_OFF = "tolerances of masses and angles"
#: machine, and features of tests/pairs
_PAIRS: dict[str, tuple[str, ...]] = {
    "roll with gas and friction": ("vee", "gas", "friction", "balance shaft of order 2", "roll weight"),
    "ceilings along axes, orders all": ("vee", "orders all", "force_ceiling_x_N near", "moment_ceiling_y_Nm near"),
    "ceilings, masses off": ("twin", _OFF, "force_ceiling_N near", "moment_ceiling_Nm near"),
    "ceilings along axes, masses off": ("twin", _OFF, "force_ceiling_x_N near", "moment_ceiling_y_Nm near"),
    "ceilings, masses off, orders all": ("vee", _OFF, "orders all", "force_ceiling_y_N near"),
    "plates, budget, bearings": ("twin", "plates, sectors", "budget", "bearing weight"),
    "plates, segments, masses off": ("twin", "plates, segments", _OFF, "bearing weight"),
    "budget, masses off": ("twin", "budget", _OFF, "scenario of masses"),
    "catalogue, masses off": ("twin", "masses of a catalogue", "steps", _OFF),
    "cheaper choices, ceiling": ("twin", "cheaper choices", "force_ceiling_N near"),
    "specific ceilings": ("vee", "specific_load_ceiling_Pa near", "bending_ceiling_Nm slack"),
    "ceilings of all kinds": ("vee", "bearing_ceiling_N slack", "bending_ceiling_Nm near", "bending weight"),
    "balance shafts, sectors": ("vee", "balance shaft backwards", "sectors"),
    "balance shafts, ceilings": ("vee", "balance shaft backwards", "orders all", "moment_ceiling_y_Nm near"),
    "continuous shaft, bearing weight": ("twin", "three bearings", "continuous shaft", "bearing weight"),
    "scenarios, masses off, rows off": ("vee", "scenario of masses", "tolerances of rows", "combine max"),
    "groups, budget": ("twin", "mirrored group", "budget", _OFF),
    "groups, bearings": ("twin", "group", "bearing weight"),
    "own masses, orders all": ("vee", "own masses", "orders all"),
    "no largest mass, bearings": ("twin", "no largest mass", "bearing weight"),
    "no largest mass, sectors, masses off": ("twin", "no largest mass", "sectors", _OFF),
    "priorities, masses off": ("twin", "priorities", _OFF),
    "conflict of ceilings": ("vee", "force ceiling of 0", "moment_ceiling_Nm near", "budget"),
    "fixed, budget, bearings": ("twin", "fixed", "budget", "bearing rms", "unbalances"),
}
#: random machines of tests/hard that lead to what is rare, such as responses that are nothing but rounding
_SEED = 5
_DRAWN = (
    ("balance shafts", 51), ("balance shafts", 44), ("balance shafts", 198), ("parts", 90), ("parts", 76),
    ("catalogue", 161), ("plates", 253), ("plates", 22), ("scenarios", 32), ("scenarios", 67), ("axis ceilings", 73),
)  # fmt: skip
_DRAWN_OFF = (("catalogue", 245), ("axis ceilings", 185), ("plates", 260), ("tolerances", 5))


def _pair(base: str, *features: str) -> Body:
    body = body_of(base, features, 2.0)
    assert body is not None
    # what is checked at every angle is the same
    return {**body, "angles": {"step_deg": 45.0}}


def _with(body: Body, of_machine: Body, **more: Any) -> Body:
    return {**body, "machine": {**body["machine"], **of_machine}, **more}


def _combinations() -> dict[str, Body]:
    """What features of pairs do not make: outputs, fronts, sweeps and matches of several kinds."""
    rods, twin, vee = _pair("twin", "gas"), _pair("twin"), _pair("vee", "balance shaft of order 2")
    rubbed = {"friction": {"reciprocating_force_N": [80.0, 60.0], "rotating_torque_Nm": 3.0}}
    parts = [{"name": "wheel", "position_m": 0.3, "mass_kg": 40.0}]
    heavy = {"shaft_parts": parts, "flywheel": {"irregularity": 0.02}}
    weighed = heavy | {"gravity_deg": 270.0, "stationary_mass_kg": 300.0}
    turning = ["loads", "flywheel", "torque", "internal_moment"]
    on_shaft = {"web": "on the shaft", "mass_kg": 1.5, "angle_deg": 20.0}
    on_web = {"web": "b", "mass_kg": 2.0, "angle_deg": 75.0}
    cut = _pair("twin", "plates, segments")
    front, sweep = {**SINGLE["sum"], "points": 3, "multipliers": True}, {"multipliers": True}
    speeds = {"path": "/machine/speed_rpm", "start": 400.0, "stop": 700.0, "count": 3}
    mirrored = _pair("twin", "mirrored group", "parts", "unbalances")
    return {
        "friction given, irregularity": _with(rods, rubbed | heavy, outputs=turning),
        "weight with gravity": _with(twin, weighed, outputs=turning),
        "as built on a balance shaft": {**vee, "outputs": ["foundation_loads"], "fitted": [on_shaft, on_web]},
        "as built of plates": {**cut, "outputs": ["foundation_loads"], "fitted": [{**on_web, "web": "1b"}]},
        "areas of pistons": _with(_of_areas(rods), rubbed, outputs=["gas", "piston_force", "torque"]),
        "matching, fitted": _matched(twin, counterweights=[on_web | {"web": "1a"}], objective={"moment_weight": 2.0}),
        "matching, chosen": _matched(twin, choose_counterweights=True, objective={"combine": "max"}),
        "front of budgets": {**front, **SINGLE["ceilings"], "total_mass_budgets_kg": [0.5, 5.0, 20.0]},
        "front without limits": {**SINGLE["no limits, max, sector"], "points": 4, "multipliers": True},
        "front of a balance shaft": {
            **_pair("vee", "balance shaft backwards", "clockwise", "moment_ceiling_x_Nm near"),
            "points": 3,
            "multipliers": True,
        },
        "sweep between ends": sweep | {"base": SINGLE["budget and ceiling"], "axes": [speeds]},
        "sweep of what is infeasible": sweep | {"base": SINGLE["infeasible"], "axes": [speeds]},
        "sweep over the turn": {"base": _pair("twin", "bearing weight"), "axes": [speeds]},
        "sweep of all": sweep | {"base": mirrored, "axes": [speeds]},
    }


def _of_areas(body: Body) -> Body:
    """Cylinders of other areas than those of a bore and a rod."""
    variant = copy.deepcopy(body)
    for throw in variant["machine"]["throws"]:
        cylinder = throw["rows"][0]["cylinder"]
        del cylinder["bore_m"], cylinder["piston_rod_diameter_m"]
        cylinder |= {"head_area_m2": 0.03, "crank_area_m2": 0.025}
    return variant


def _matched(body: Body, **more: Any) -> Body:
    """Pistons for all rows, rods that go on the second alone, and nuts."""
    parts = [
        {"class": "piston", "names": ["P1", "P2"], "masses_kg": [2.1, 1.8]},
        {"class": "rod", "names": ["R1"], "masses_kg": [0.7], "rows": [{"throw": 1, "row": 0}]},
    ]
    return {"machine": body["machine"], "parts": parts, "balance_nuts_kg": [0.2, 0.4], **more}


def _drawn(mode: str, number: int, off: bool = False) -> Body:
    body = drawn(number, _SEED, mode)
    assert body is not None
    return with_masses_off(body, number) if off else body


def bodies() -> dict[str, Body]:
    """All of them."""
    pairs = {name: _pair(*features) for name, features in _PAIRS.items()}
    random = {f"{mode} {number} of seed {_SEED}": _drawn(mode, number) for mode, number in _DRAWN}
    off = {f"{mode} {number} of seed {_SEED}, masses off": _drawn(mode, number, True) for mode, number in _DRAWN_OFF}
    return pairs | _combinations() | random | off
