"""Columns in detail, and the figure of a single answer that each of them is."""

from collections.abc import Iterator
from typing import Any

from pydantic import BaseModel

from schemas.answer.answers import AnalyzeAnswer, OptimizeAnswer
from schemas.machine.reciprocating import balance_shafts
from schemas.sweep.details import DETAILS, Of, parts_of
from schemas.sweep.request import SweepRequest

_ELLIPSE = ("minor", "peak_x", "peak_y", "co_rotating")
_OF_ROWS = (
    "reciprocating_mass_kg",
    "rod_rotating_mass_kg",
    "rotating_mass_kg",
    "largest_gas_N",
    "largest_inertia_N",
    "largest_piston_force_N",
    "piston_rod_N",
    "crosshead_pin_N",
    "stop_at_outer_dead_centre_N",
    "stop_at_inner_dead_centre_N",
    "stop_over_the_turn_N",
)
#: figure of an answer -> key of its column; in place of brackets stands every item in turn
FIGURES: dict[str, str] = {
    **{f"residual.after.force.{name}_N": f"force_{name}_N" for name in _ELLIPSE},
    **{f"residual.after.moment.{name}_Nm": f"moment_{name}_Nm" for name in _ELLIPSE},
    # what no counterweights change
    "residual.before.force.counter_rotating_N": "force_counter_rotating_N",
    "residual.before.moment.counter_rotating_Nm": "moment_counter_rotating_Nm",
    "main_bearings.bearings[].before.floor_N": "bearing_floor_N.",
    "gas.rows[].indicated_power_W": "indicated_power_W.",
    **{
        f"gas.rows[].chambers[].{name}": f"{name}."
        for name in ("indicated_work_J", "suction_opens_deg", "discharge_opens_deg")
    },
    "piston_force.rows[].peak_tension_N": "piston_tension_N.",
    "piston_force.rows[].peak_compression_N": "piston_compression_N.",
    "rod_loads.rows[].governing_load_N": "rod_load_N.",
    "rod_loads.rows[].peak_side_N": "peak_side_N.",
    "rod_loads.rows[].cases[].tension_N": "rod_tension_N.",
    "rod_loads.rows[].cases[].compression_N": "rod_compression_N.",
    "torque.rows[].mean_torque_Nm": "mean_torque_Nm.",
    "torque.rotating_friction_Nm": "rotating_friction_Nm",
    "flywheel.fluctuation_energy_J": "fluctuation_energy_J",
    "flywheel.inertia_MD2_kg_m2": "inertia_MD2_kg_m2",
    **{f"loads.rows[].{name}": f"{name}." for name in _OF_ROWS},
    **{
        f"loads.rows[].frame.{name}": f"frame_{name}."
        for name in ("tension_N", "compression_N", "mean_N", "amplitude_N")
    },
    **{
        f"loads.rows[].guide.{name}": f"guide_{name}."
        for name in ("weight_N", "largest_N", "smallest_N", "lifted_share")
    },
    "loads.rows[].covers[].largest_N": "cover_largest_N.",
    "loads.rows[].covers[].smallest_N": "cover_smallest_N.",
    "loads.throws[].rotating_mass_kg": "throw_rotating_mass_kg.",
    "loads.bearing_weights[].x_N": "bearing_weight_x_N.",
    "loads.bearing_weights[].y_N": "bearing_weight_y_N.",
    "loads.driver_Nm": "driver_Nm",
    "loads.foundation_weight_N": "foundation_weight_N",
    "main_bearings.bearings[].after.specific_load_Pa": "specific_load_Pa.",
    "main_bearings.bearings[].after.rms_N": "bearing_rms_N.",
    "main_bearings.bearings[].after.circle_x_N": "bearing_circle_x_N.",
    "main_bearings.bearings[].after.circle_y_N": "bearing_circle_y_N.",
    "main_bearings.bending.floor_Nm": "bending_floor_Nm",
}
#: key -> what its columns are about
_OF: dict[str, Of] = {key: details.of for group in DETAILS.values() for details in group for key in details.keys}


def detail_figures(request: SweepRequest, answer: OptimizeAnswer | AnalyzeAnswer) -> Iterator[tuple[str, Any]]:
    """Columns in detail of a row from the answer to its design alone."""
    for path, key in FIGURES.items():
        if balance_shafts(request.base.machine):
            # they change what counterweights on the crankshaft do not
            path = path.replace("residual.before.", "residual.after.")
        parts = list(parts_of(request.base.machine, _OF[key]))
        numbers = list(figures(answer, path.replace("[]", ".[]").split(".")))
        if getattr(answer, path.split(".")[0]) is not None:
            for part, number in zip(parts, numbers, strict=True):
                yield key + part.label, number


def figures(node: Any, path: list[str]) -> Iterator[Any]:
    """The figures that a path leads to; None below what is not there."""
    if not path:
        yield node
    elif path[0] == "[]":
        for value in node or ():
            yield from figures(value, path[1:])
    else:
        assert node is None or isinstance(node, BaseModel)
        yield from figures(None if node is None else getattr(node, path[0]), path[1:])
