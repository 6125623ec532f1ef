"""Rows of a sweep against the answers to single requests: every design asked for by itself."""

import json
from pathlib import Path
from typing import Any

import pyarrow as pa

from optimizer.analyze import analyze
from optimizer.choices.discrete.search import EXHAUSTED, TREE
from optimizer.errors import NotComputable
from optimizer.optimize import optimize
from optimizer.program.cuts import optimum as cuts
from optimizer.program.solution import CLOSED_FORM, CONE_PROGRAM
from optimizer.studies.sweep import run_chunk
from schemas.answer.answers import AnalyzeAnswer, Certificate, OptimizeAnswer
from schemas.answer.outputs import Order
from schemas.base.target import BadPointer, find_target
from schemas.machine.reciprocating import balance_shafts
from schemas.request.objective import OVER_THE_TURN
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from schemas.sweep.request import SweepRequest
from service.common.validation import InvalidRequest, check, pointer
from tests.studies.sweep.details import detail_figures

EXAMPLES = Path(__file__).parents[3] / "examples"
#: agreement of a row with the single call, relative to the larger of the value and its natural size
CLOSE = 1e-9


def example(name: str) -> dict[str, Any]:
    body: dict[str, Any] = json.loads((EXAMPLES / f"{name}.json").read_text())
    return body


def sweep(base: dict[str, Any], *axes: dict[str, Any], **rest: Any) -> SweepRequest:
    return check(SweepRequest, {"base": base, "axes": list(axes), **rest})


def table(request: SweepRequest, start: int = 0, stop: int | None = None) -> pa.Table:
    return run_chunk(request.model_dump_json().encode(), start, request.total if stop is None else stop)


def put(body: Any, path: tuple[str | int, ...], value: Any) -> None:
    """Write a value into a JSON body."""
    for part in path[:-1]:
        body = body[part]
    body[path[-1]] = value


def single(request: SweepRequest, row: dict[str, Any]) -> OptimizeAnswer | AnalyzeAnswer | list[str]:
    """The answer to one design by itself, or what is wrong with it, each with its pointer."""
    body = request.base.model_dump(mode="json")
    for target in request.targets:
        value = row[pointer(target.path)]
        whole = target.integer and value is not None and value == round(value)
        put(body, target.path, int(value) if whole else value)
    try:
        if request.task == "analyze":
            return analyze(check(AnalyzeRequest, body))
        return optimize(check(OptimizeRequest, body))
    except (InvalidRequest, NotComputable) as error:
        return [f"{pointer(problem.path)}: {problem.message}" for problem in error.problems]


def assert_row_is_the_single_answer(request: SweepRequest, row: dict[str, Any], close: float = CLOSE) -> str:
    """Compare a row with the answer to its design alone; its status."""
    answer = single(request, row)
    if isinstance(answer, list):
        assert row["status"] == "invalid", (row, answer)
        assert row["message"] in answer, (row["message"], answer)
        figures = [name for name in row if name not in _labels(request)]
        assert all(row[name] is None for name in figures)
        return "invalid"
    expected = dict(_figures(request, answer))
    expected |= {name: value for name, value in detail_figures(request, answer) if name in row}
    for name, value in expected.items():
        if name in ("status", "method"):
            assert row[name] == value, (name, row, value)
        elif name.startswith("angle_deg."):
            # an angle matters as much as the mass that it turns
            turned = (row[name] - value + 180.0) % 360.0 - 180.0
            share = row[name.replace("angle_deg.", "mass_kg.")] / (answer.total_mass_kg or 1.0)
            assert abs(turned) * share <= close * 360.0, (name, row[name], value)
        else:
            # peaks over the turn are known within a bracket
            bracketed = name.startswith(("peak_", "bearing_peak_N."))
            assert_close(name, row[name], value, _size(answer, name), max(close, CLOSE) if bracketed else close)
    unseen = set(row) - set(expected) - _labels(request)
    assert not {name for name in unseen if row[name] is not None}, unseen
    return str(row["status"])


def assert_close(name: str, figure: float | None, expected: float | None, size: float, close: float = CLOSE) -> None:
    if expected is None or figure is None:
        assert figure is expected, (name, figure, expected)
    else:
        assert abs(figure - expected) <= close * max(abs(expected), size), (name, figure, expected, size)


def _labels(request: SweepRequest) -> set[str]:
    labels = {"index", "status", "message", *(pointer(target.path) for target in request.targets)}
    # what scatters is found by either method
    return {*labels, "method"} if getattr(request.base, "uncertain", False) else labels


def _size(answer: OptimizeAnswer | AnalyzeAnswer, name: str) -> float:
    """What rounding errors of a figure are measured by: it may be the small rest of what cancels."""
    if name.startswith("mass_kg.") or name == "mass_lower_bound_kg":
        return answer.total_mass_kg or 0.0
    if name in ("relative_gap", "mass_relative_gap"):
        return 1.0
    if (
        isinstance(answer, OptimizeAnswer)
        and answer.certificate is not None
        and name in ("objective", "lower_bound", "yardstick", "nominal_objective", "nominal_optimum")
    ):
        return answer.certificate.objective_without_counterweights
    if answer.residual is None:
        return 0.0
    before = answer.residual.before
    return {"force_peak_N": before.force.peak_N, "moment_peak_Nm": before.moment.peak_Nm}.get(name, 0.0)


def _figures(request: SweepRequest, answer: OptimizeAnswer | AnalyzeAnswer) -> Any:
    """Columns of a row from the answer to one request."""
    if isinstance(answer, OptimizeAnswer):
        yield "status", answer.status
        if answer.certificate is None:
            machine = request.base.machine
            chosen = any(web.fixed is None for web in machine.webs) and machine.max_total_mass_kg != 0
            by_program = CONE_PROGRAM if chosen else CLOSED_FORM
            usual = cuts.METHOD if request.base.objective.over_the_turn else by_program
            # the reason of what is chosen says what proved that there is nothing
            by_search = {"all were compared.": EXHAUSTED, "a tree of bounds over all of them proves it.": TREE}
            of_choices = (name for ending, name in by_search.items() if answer.status_reason.endswith(ending))
            if not request.base.uncertain:
                yield "method", next(of_choices, usual)
        else:
            yield from _certificate_figures(answer.certificate)
        if request.base.uncertain:
            yield from _worst_figures(request, answer)
        on_shafts = (counterweight for shaft in answer.balance_shafts or () for counterweight in shaft.counterweights)
        for weight in (*answer.counterweights, *on_shafts):
            yield f"mass_kg.{weight.web}", weight.mass_kg
            yield f"angle_deg.{weight.web}", weight.angle_deg
            if f"half_angle_deg.{weight.web}" in {column.name for column in request.all_columns}:
                yield f"half_angle_deg.{weight.web}", None if weight.shape is None else weight.shape.half_angle_deg
    else:
        yield "status", "analyzed"
    yield "total_mass_kg", answer.total_mass_kg
    if balance_shafts(request.base.machine):
        yield "balance_shafts_mass_kg", answer.balance_shafts_mass_kg
    if answer.residual is not None and "force_peak_N" in {column.name for column in request.all_columns}:
        after = answer.residual.after
        yield "force_peak_N", None if after is None else after.force.peak_N
        yield "moment_peak_Nm", None if after is None else after.moment.peak_Nm
    yield from _drive_figures(request, answer)
    yield from _balance_figures(request, answer)


def _worst_figures(request: SweepRequest, answer: OptimizeAnswer) -> Any:
    worst, price = answer.worst_case, answer.price_of_robustness
    yield "worst_case_force_peak_N", None if worst is None else worst.force_peak_N
    yield "worst_case_moment_peak_Nm", None if worst is None else worst.moment_peak_Nm
    if "worst_case_bearing_peak_N" in {column.name for column in request.all_columns}:
        yield "worst_case_bearing_peak_N", None if worst is None else worst.bearing_peak_N
    yield "nominal_objective", None if price is None else price.nominal
    yield "nominal_optimum", None if price is None else price.nominal_optimum
    yield "nominal_optimum_worst_case", None if price is None else price.nominal_optimum_worst_case


def _certificate_figures(certificate: Certificate) -> Any:
    for name in (
        "objective",
        "lower_bound",
        "relative_gap",
        "yardstick",
        "mass_lower_bound_kg",
        "mass_relative_gap",
        "mass_yardstick_kg",
        "method",
    ):
        yield name, getattr(certificate, name)
    for goal in certificate.goals:
        yield f"goal_value.{goal.goal}", goal.value
        yield f"goal_lower_bound.{goal.goal}", goal.lower_bound
        yield f"goal_limit.{goal.goal}", goal.limit


def _drive_figures(request: SweepRequest, answer: OptimizeAnswer | AnalyzeAnswer) -> Any:
    if answer.gas is not None:
        yield "indicated_power_W", answer.gas.indicated_power_W
    if answer.piston_force is not None:
        yield (
            "peak_piston_force_N",
            max(max(abs(row.peak_tension_N), abs(row.peak_compression_N)) for row in answer.piston_force.rows),
        )
    if answer.rod_loads is not None:
        yield "peak_rod_load_N", answer.rod_loads.governing_load_N
    if answer.torque is not None:
        yield "mean_torque_Nm", answer.torque.mean_torque_Nm
        yield "peak_torque_Nm", answer.torque.peak_Nm
        yield "fluctuation_energy_J", answer.torque.fluctuation_energy_J
        yield "shaft_power_W", answer.torque.shaft_power_W
        yield "indicated_power_W", answer.torque.indicated_power_W
        yield "friction_power_W", answer.torque.friction_power_W
    if answer.flywheel is not None:
        yield "irregularity", answer.flywheel.irregularity
        yield "inertia_J_kg_m2", answer.flywheel.inertia_J_kg_m2
    if answer.overturning is not None:
        yield "peak_overturning_Nm", answer.overturning.peak_Nm
    if answer.roll is not None:
        # balance shafts alone change it, and without counterweights there is nothing that they carry
        with_shafts = answer.roll.after if balance_shafts(request.base.machine) else answer.roll.before
        yield "peak_roll_Nm", None if with_shafts is None else with_shafts.peak_Nm
    if answer.loads is not None:
        yield "peak_crosshead_pin_N", max((row.crosshead_pin_N for row in answer.loads.rows), default=0.0)
        yield "peak_sudden_stop_N", max((row.stop_over_the_turn_N for row in answer.loads.rows), default=0.0)
        yield "own_base_peak_Nm", answer.loads.own_base_peak_Nm
        yield "shared_base_peak_Nm", answer.loads.shared_base_peak_Nm
        for weight in answer.loads.bearing_weights:
            yield f"bearing_weight_N.{weight.name}", weight.weight_N
    if answer.main_bearings is not None:
        peaks = {
            bearing.name: None if bearing.after is None else bearing.after.peak_N
            for bearing in answer.main_bearings.bearings
        }
        fitted = None not in peaks.values()
        yield "peak_bearing_load_N", max(peaks.values()) if fitted else None
        yield "peak_bending_Nm", answer.main_bearings.bending.peak_Nm if fitted else None
        for name, peak in peaks.items():
            yield f"bearing_peak_N.{name}", peak
    if answer.pin_loads is not None:
        yield "peak_pin_load_N", answer.pin_loads.peak_N


def _balance_figures(request: SweepRequest, answer: OptimizeAnswer | AnalyzeAnswer) -> Any:
    """Orders, stages and balance rates, which are known without an angle."""
    if answer.orders is not None:
        fitted = {order.order: order for order in answer.orders.after or ()}
        for harmonic in answer.orders.before:
            # counterweights change the first order alone; without them there is nothing with them
            with_them = fitted.get(harmonic.order, harmonic if harmonic.order > 1 else None)
            yield from _order_figures(harmonic.order, with_them)
    if answer.internal_moment is not None:
        yield "internal_moment_Nm", answer.internal_moment.after_Nm
    for stage in answer.stages or ():
        yield f"stage_value.{stage.stage}", stage.value
        yield f"stage_remaining.{stage.stage}", stage.remaining if stage.stage not in ("V", "VI") else stage.value
    if "balance_rate" in request.base.outputs:
        throws = getattr(request.base.machine, "throws", ())
        named = all(throw.name is not None for throw in throws)
        for k, throw in enumerate(throws):
            rate = answer.balance_rate[k] if answer.balance_rate else None
            label = throw.name if named else k
            yield f"balance_rate.{label}", None if rate is None else rate.rate
            yield f"balance_rate_sideways.{label}", None if rate is None else rate.sideways


def _order_figures(number: int, order: Order | None) -> Any:
    for quantity, unit in (("force", "N"), ("moment", "Nm")):
        of = None if order is None else getattr(order, quantity)
        yield f"{quantity}_peak_{unit}.order_{number}", None if of is None else getattr(of, f"peak_{unit}")
        for sense in ("co_rotating", "counter_rotating"):
            phasor = None if of is None else getattr(of, sense)
            for part in ("real", "imag"):
                name = f"{quantity}_{sense}_{part}_{unit}.order_{number}"
                yield name, None if phasor is None else getattr(phasor, f"{part}_{unit}")


def numeric_paths(request: SweepRequest) -> list[str]:
    """Pointers to every numeric field that holds a number, of the parts that an axis may vary."""
    pointers: list[str] = []

    def walk(node: Any, path: tuple[str | int, ...]) -> None:
        if isinstance(node, dict):
            for name, item in node.items():
                walk(item, (*path, name))
        elif isinstance(node, list):
            for number, item in enumerate(node):
                walk(item, (*path, number))
        elif isinstance(node, int | float) and not isinstance(node, bool):
            pointers.append(pointer(path))

    body = request.base.model_dump(mode="json")
    for part in ("machine", "objective", "counterweights"):
        if part in body:
            walk(body[part], (part,))
    # a sweep does not weigh what is known over the turn
    refused = tuple(pointer(("objective", name)) for name in OVER_THE_TURN)
    return [path for path in pointers if not path.startswith(refused) and _is_number(request, path)]


def _is_number(request: SweepRequest, path: str) -> bool:
    """Whether a field is one, and no choice of a few."""
    try:
        find_target(request.base, path)
    except BadPointer:
        return False
    return True
