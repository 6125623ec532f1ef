"""Every number of a single answer's outputs has a column in a sweep, or stands here with the reason why not."""

from fnmatch import fnmatchcase

import pytest

from schemas.answer.outputs import OUTPUT_COLUMNS
from schemas.sweep.details import DETAILS, keys_of, usual_keys
from schemas.sweep.request import SweepRequest
from tests.studies.sweep.details import FIGURES
from tests.studies.sweep.figures import every_figure
from tests.studies.sweep.single import example, sweep

_PHASORS = ("co_rotating.real", "co_rotating.imag", "counter_rotating.real", "counter_rotating.imag")
#: figure -> key of its column, of those that come along; their values are compared in single.py
USUAL = {
    "residual.after.force.peak_N": "force_peak_N",
    "residual.after.moment.peak_Nm": "moment_peak_Nm",
    "balance_rate[].rate": "balance_rate.",
    "balance_rate[].sideways": "balance_rate_sideways.",
    "orders.after[].force.peak_N": "force_peak_N.",
    "orders.after[].moment.peak_Nm": "moment_peak_Nm.",
    **{f"orders.after[].force.{name}_N": f"force_{name.replace('.', '_')}_N." for name in _PHASORS},
    **{f"orders.after[].moment.{name}_Nm": f"moment_{name.replace('.', '_')}_Nm." for name in _PHASORS},
    "stages[].value": "stage_value.",
    "stages[].remaining": "stage_remaining.",
    "internal_moment.after_Nm": "internal_moment_Nm",
    "gas.indicated_power_W": "indicated_power_W",
    "rod_loads.governing_load_N": "peak_rod_load_N",
    "torque.peak_Nm": "peak_torque_Nm",
    **{f"torque.{name}": name for name in ("mean_torque_Nm", "fluctuation_energy_J")},
    **{f"torque.{name}_power_W": f"{name}_power_W" for name in ("indicated", "friction", "shaft")},
    "flywheel.irregularity": "irregularity",
    "flywheel.inertia_J_kg_m2": "inertia_J_kg_m2",
    "overturning.peak_Nm": "peak_overturning_Nm",
    # nothing but balance shafts changes it
    "roll.before.peak_Nm": "peak_roll_Nm",
    "roll.after.peak_Nm": "peak_roll_Nm",
    "loads.own_base_peak_Nm": "own_base_peak_Nm",
    "loads.shared_base_peak_Nm": "shared_base_peak_Nm",
    "loads.bearing_weights[].weight_N": "bearing_weight_N.",
    "main_bearings.bearings[].after.peak_N": "bearing_peak_N.",
    "main_bearings.bending.peak_Nm": "peak_bending_Nm",
    "pin_loads.peak_N": "peak_pin_load_N",
}
#: figures without a column -> why
WITHOUT = {
    "*[[]].throw": "numbers the parts",
    "*[[]].row": "numbers the parts",
    "*[[]].cylinder": "numbers the parts",
    "*[[]].order": "numbers the parts",
    "*_angle_deg": "where a peak is: it jumps between peaks that are equal, however little designs differ",
    "rod_loads.*.tension_deg": "where a peak is, likewise",
    "rod_loads.*.compression_deg": "where a peak is, likewise",
    "main_bearings.bending.peak_position_m": "where a peak is, likewise",
    "residual.*.major_axis_deg": "the direction of an ellipse, none of a circle; the phasors of orders hold it",
    "*.phase_deg": "angle of a phasor whose parts are columns; none where it is 0",
    "orders.*.magnitude_N": "size of a phasor whose parts are columns",
    "orders.*.magnitude_Nm": "size of a phasor whose parts are columns",
    "*.before.*": "without counterweights: the same sweep as an analysis of the bare machine",
    "orders.before[[]].*": "without counterweights, likewise",
    "internal_moment.before_Nm": "without counterweights, likewise",
    "residual.after.force.counter_rotating_N": "what balance shafts alone change: that before is a column, with them",
    "residual.after.moment.counter_rotating_Nm": "what balance shafts alone change: that before is a column, with them",
    "main_bearings.bearings[[]].after.floor_N": "what counterweights leave alone: that before is a column",
    "residual.orders.*": "columns of the output orders",
    "foundation_loads[[]].*": "made of phasors that are columns of the output orders",
    "residual.responses[[]].before": "without counterweights, likewise",
    "residual.responses[[]].after": "a column by the name of its peak where it counts in the objective",
    "residual.responses[[]].turn_*": "of all orders, which the column objective then holds",
    "residual.turn.*": "only where the objective is over all orders, which the column objective then holds",
    "stages[[]].acting[[]].*": "what the stages are made of: columns of the output orders",
    "stages[[]].left[[]].*": "what the stages are made of: columns of the output orders",
    "stages[[]].iron[[]].*": "for drawing any share of a rule, which is no design of the sweep",
    "stages[[]].rules_of_thumb[[]].*": "beside the optimum, of no design of the sweep",
    "torque.*_error_*": "an estimate of what is rounding",
    "loads.gravity_deg": "as the machine gives it",
    "main_bearings.bearings[[]].position_m": "as the machine gives it",
    "pin_loads.pins[[]].*": "by pin, of which designs may have different numbers; all are alike but for their angles",
    "pin_loads.half_turn_mechanism_peak_N": "four times the largest torque over number and radius of the pins",
    "pin_loads.equilibrium.*": "rounding, where the pins of a machine can hold the torque at all",
    "pin_loads.mechanism.*": "counted from the number of pins",
    "pin_loads.contact.*": "of pins with play, which a machine's have not",
    "pin_loads.drive_bearing.*": "what evenly spaced pins leave to it is 0 from three pins on",
    "pin_loads.energy.*": "a check of the torque's work over one pitch",
    "pin_loads.comparison.*": "asked for at /v1/scroll/pin-loads alone",
}


def reasons(figure: str) -> list[str]:
    return [pattern for pattern in WITHOUT if fnmatchcase(figure, pattern)]


@pytest.mark.parametrize("figure", every_figure())
def test_it_is_a_column_or_it_is_said_why_not(figure: str) -> None:
    assert (figure in FIGURES) + (figure in USUAL) + bool(reasons(figure) and figure not in FIGURES | USUAL) == 1


def test_nothing_is_listed_that_there_is_not() -> None:
    figures = set(every_figure())
    assert figures >= FIGURES.keys()
    assert figures >= USUAL.keys()
    left = figures - FIGURES.keys() - USUAL.keys()
    assert {pattern for figure in left for pattern in reasons(figure)} == WITHOUT.keys()


def figure_sweep(*names: str) -> SweepRequest:
    base = {**example("2d12"), "outputs": [*names]}
    return sweep(base, {"path": "/machine/speed_rpm", "values": [400]}, task="analyze", details=True)


@pytest.mark.parametrize("figure", sorted({**FIGURES, **USUAL}))
def test_its_output_brings_the_column(figure: str) -> None:
    output = figure.partition(".")[0].removesuffix("[]")
    brought = {*usual_keys(output), *(keys_of(output) if output in DETAILS else ())}
    if output == "residual":
        brought |= {column.name for column in figure_sweep("residual").all_columns}
    assert (FIGURES | USUAL)[figure] in brought
    assert output in OUTPUT_COLUMNS
