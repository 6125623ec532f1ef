"""Requests of every kind that the checker covers, by name."""

from typing import Any

from service.documents.examples import bodies
from tests.optimize.machines import machine, row, throw, web

Body = dict[str, Any]

_EXAMPLES = bodies("")
_THROWS = [
    throw(-0.3, 10.0, [row(45.0, 12.0, connecting_rod={"length_m": 0.5, "mass_kg": 4.0})], rotating=5.0),
    throw(0.4, 130.0, [row(45.0, 7.0, offset_m=0.02), row(115.0, 11.0)], rotating=3.0),
]
_SECTOR = {"centre_deg": 190.0, "half_angle_deg": 40.0}
_WEBS = [web("a", -0.45, 4.0), web("b", -0.1, 6.0, sector=_SECTOR), web("c", 0.55, 3.0, 0.15)]


#: webs without a limit of their mass
_FREE = [{**plane, "max_mass_kg": None} for plane in _WEBS]


def _body(changes: Body | None = None, **objective: Any) -> Body:
    return {"machine": {**machine(_THROWS, _WEBS), **(changes or {})}, "objective": objective}


def _with_texts(body: Body) -> Body:
    """The same machine, its numbers as texts with units."""
    units = {
        "m": ("mm", 1e3),
        "kg": ("lb", 1 / 0.45359237),
        "deg": ("rad", 0.017453292519943295),
        "rpm": ("Hz", 1 / 60),
    }

    def text_of(name: str, value: Any) -> Any:
        if isinstance(value, dict):
            return {key: text_of(key, value) for key, value in value.items()}
        if isinstance(value, list):
            return [text_of("", value) for value in value]
        unit, factor = units.get(name.rpartition("_")[2], ("", 0.0))
        return f"{value * factor!r} {unit}" if unit and isinstance(value, float) else value

    texts: Body = text_of("", body)
    return texts


SINGLE: dict[str, Body] = {
    "sum": _body(),
    "max": _body(combine="max"),
    "direction weights": _body(direction_weights={"x": 1, "y": 0.3}),
    "one direction, max": _body(direction_weights={"x": 0, "y": 1}, combine="max"),
    "weights": _body(force_weight=0.2, moment_weight=3.0),
    "force alone": _body(moment_weight=0),
    "moment alone, not the least mass": _body(force_weight=0, least_mass=False),
    "budget": _body({"max_total_mass_kg": 2.5}),
    "ceilings": _body(force_ceiling_N=5000.0, moment_ceiling_Nm=2500.0),
    "budget and ceiling": _body({"max_total_mass_kg": 5.0}, moment_ceiling_Nm=3000.0),
    "clockwise, other plane": _body({"rotation": "cw", "reference_plane_m": 0.7}),
    "ceilings along axes": _body(force_ceiling_x_N=4600.0, force_ceiling_y_N=3800.0, moment_ceiling_x_Nm=2450.0),
    "ceiling along an axis, direction weights": _body(moment_ceiling_y_Nm=1300.0, direction_weights={"x": 1, "y": 0.3}),
    "infeasible": _body(force_ceiling_N=100.0),
    "infeasible along an axis": _body(force_ceiling_y_N=100.0, force_ceiling_N=9000.0),
    "infeasible between axes": _body(force_ceiling_x_N=3500.0, force_ceiling_y_N=3500.0),
    "infeasible together": _body(force_ceiling_N=4100.0, moment_ceiling_Nm=1700.0),
    "infeasible by budget": _body({"max_total_mass_kg": 0.5}, force_ceiling_N=4500.0),
    "texts with units": _with_texts(_body({"max_total_mass_kg": 2.5}, force_ceiling_N=8500.0)),
    "no limits": _body({"webs": [_FREE[0], _FREE[2]]}, direction_weights={"x": 1, "y": 0.3}),
    "no limits, max, sector": _body({"webs": _FREE}, combine="max"),
    "no limits on one plane": _body({"webs": [_FREE[0], _WEBS[1]]}),
    "no limits, budget, ceiling": _body({"webs": _FREE, "max_total_mass_kg": 1e15}, force_ceiling_N=5000.0),
    "infeasible without limits": _body({"webs": _FREE}, force_ceiling_N=100.0),
    "limits beyond any need": _body({"webs": [{**plane, "max_mass_kg": 1e300} for plane in _WEBS]}),
    "a hair of mass": {
        "machine": machine([throw(0.0, 0.0, [], rotating=10.0)], [web("a", -0.1), web("b", 0.1)], speed_rpm=600.0),
        # 10 kg at 0.1 m and 20 pi/s, less a ten millionth of it
        "objective": {"force_weight": 0, "force_ceiling_N": 400 * 9.869604401089358 * (1 - 1e-7)},
    },
    "no webs": {"machine": machine(_THROWS, [])},
    "nothing fits": {"machine": machine(_THROWS, [web("a", 0.0, 0.0)])},
    "balances itself": {"machine": machine([throw(0.0, 0.0, [])], [web("a", 0.1)])},
    **{name: _EXAMPLES[name] for name in ("2d12", "v90-equal", "scroll-oldham", "scroll-three-pins", "inline-six")},
}
