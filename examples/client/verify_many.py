"""Fronts and the rows of sweeps: each point, and each row, by what is done with one answer."""

from __future__ import annotations

import json
from functools import partial
from typing import Any, Dict, Iterator, List, Sequence

from verify_answer import MASS_GAP, before, touched
from verify_cases import OF_CASES, OFF, uncertain, with_value
from verify_ceilings import LOADED
from verify_claims import EVIDENCE, Claim, Claims, covered, near, same
from verify_cuts import SHAFTS
from verify_first import CEILING, ceilings, infeasible, light, lightest, priced_at, proven, smallest
from verify_form import form
from verify_leaves import Path
from verify_machine import ENTRY_FIELDS, NAMES, ON_FRAME, Machine, Responses
from verify_numbers import ABOUT_ONE, ONE, SPECK, ZERO, NotCovered, Number, Place, Unreadable, largest, real
from verify_orders import first_order
from verify_program import CEILINGS, Statement
from verify_shafts import geared
from verify_single import single
from verify_turn import unreachable
from verify_weights import active_limits, counterweights, shafts, usual_gap
from verify_worst_front import of_both, worst_curve

STATUSES = ("optimal", "inaccurate", "infeasible")
STRAIGHT = 1e-4  # a front that lies nearer to the line between its ends has no knee
UNSURE = 1e-9
ORDERED = "crank_orders"  # a design that varies the crank angles instead of axes
#: of a certificate what no row has, and what it has with its multipliers alone
NO_COLUMN, WITH_MULTIPLIERS = "objective_without_counterweights", "mass_objective_limit"
#: how columns begin that hold loads of bearings and bending moments
LOADS = ("bearing_peak_N.", "peak_bearing_load_N", "peak_bending_Nm")
#: columns of the worst case, and of what it costs by the fields of a single answer
OF_WORST = ("worst_case_force_peak_N", "worst_case_moment_peak_Nm", "worst_case_bearing_peak_N")
OF_PRICE = {
    "nominal_objective": "nominal",
    "nominal_optimum": "nominal_optimum",
    "nominal_optimum_worst_case": "nominal_optimum_worst_case",
}
#: columns without which it is not told whether a row is optimal
OF_STATUS = {"objective", "lower_bound", "yardstick"}


def front(request: Place, answer: Place) -> Claims:
    """Fronts of force and moment, one for each budget."""
    yield from form(answer, ("pareto",))
    request.require_coverage(f"{ENTRY_FIELDS}{SHAFTS}{OFF}{OF_CASES}")
    design, goal = request / "machine", request / "objective"
    plain = _machine(request, answer, design / "max_total_mass_kg")
    yield from before(request, plain, answer)
    yield from first_order("before", answer / "without_counterweights", plain.before)
    fronts, budgets = list(answer / "fronts"), list(request / "total_mass_budgets_kg")
    if len(fronts) != max(1, len(budgets)):
        raise Unreadable((*answer.path, "fronts"), "must hold one front for each budget")
    worst = max(fronts, key=lambda curve: STATUSES.index((curve / "status").text(*STATUSES)))
    yield same("status", answer / "status", (worst / "status").value)
    for curve, budget in zip(fronts, budgets or [design / "max_total_mass_kg"]):
        if budget:
            yield near("max_total_mass", curve / "max_total_mass_kg", budget.number())
        elif curve / "max_total_mass_kg":
            # nobody asked for one
            yield "max_total_mass", curve / "max_total_mass_kg", -ONE, ONE
        if (curve / "status").text(*STATUSES) == "infeasible":
            yield "status", curve / "status", ONE if curve / "infeasibility" else -ONE, ONE
            of_all = list(design / "balance_shafts") or uncertain(request)
            no_weights = unreachable if of_all else infeasible
            yield from no_weights(request, answer, budget, curve / "infeasibility")
            continue
        machine = _machine(request, answer, budget)
        if uncertain(request):
            yield from worst_curve(request, machine, curve)
            yield from _closed(request, curve)
            yield from _shape(curve)
            continue
        on_shafts = geared(design, machine, mirrored=True)
        statement = Statement(machine, goal, {name: {name: ONE} for name in NAMES}, geared=on_shafts)
        for name, unit in NAMES.items():
            alone = Statement(machine, goal, {name: {name: ONE}}, geared=on_shafts)
            yield _scale(alone, curve / "scale" / f"{name}_{unit}")
        for entry in curve / "points":
            yield from covered(point(statement, request, curve / "scale", entry))
        yield from _closed(request, curve)
        yield from _shape(curve)
        ends, implied = curve / "ends", curve / "implied_max_mass_kg"
        yield from covered(smallest(machine, goal, ends, ends / "multipliers", implied, on_shafts))


def _shape(curve: Place) -> Claims:
    """The ends are the first and the last point, and the knee is farthest below the line between them."""
    points, ends = list(curve / "points"), curve / "ends"
    worst = max(points, key=lambda point: STATUSES.index((point / "status").text(*STATUSES[:2])), default=curve)
    status, of_points = (curve / "status").value, (worst / "status").value
    # ends that are not closed leave a front open whose points all are closed: that is not looked at
    modest = status == "inaccurate" and of_points == "optimal"
    yield "status", curve / "status", None if modest else ONE if status == of_points else -ONE, ONE
    peaks = [[point / f"weighted_{name}_peak_{unit}" for name, unit in NAMES.items()] for point in points]
    names = (("smallest_force_N", "moment_at_smallest_force_Nm"), ("force_at_smallest_moment_N", "smallest_moment_Nm"))
    for fields, point in zip(names, (peaks[0], peaks[-1])) if peaks else ():
        for field, peak in zip(fields, point):
            yield near("front", ends / field, peak.number() * ABOUT_ONE)
    for first, second in zip(peaks, peaks[1:]):
        # from the smallest force to the smallest moment
        right = first[0].double() <= second[0].double() and first[1].double() > second[1].double()
        yield "front", second[0], ONE if right else -ONE, ONE
    (x, y), (far, low) = (
        ([number.double() for number in point] for point in (peaks[0], peaks[-1])) if peaks else ((0, 0),) * 2
    )
    bent = peaks if len(peaks) > 2 and far > x and y > low else []
    depths = [(y - m.double()) / (y - low) - (f.double() - x) / (far - x) for f, m in bent]
    deepest = max(depths, default=0.0)
    if not curve / "knee":
        yield "front", curve, ONE if deepest <= STRAIGHT * (1 + UNSURE) else -ONE, ONE
    else:
        k = (curve / "knee").double()
        there = depths[int(k)] if k in range(len(depths)) else -1.0
        yield "front", curve / "knee", ONE if there >= deepest - UNSURE and deepest > 0 else -ONE, ONE


def _closed(request: Place, curve: Place) -> Claims:
    """A front is optimal only where both smallest peaks are as near to what is proven of them as its points are."""
    accuracy = (request / "accuracy" / "relative_gap").number(usual_gap(request / "machine"), least=0)
    for name, unit in NAMES.items() if (curve / "status").value == "optimal" else ():
        smallest, bound = (curve / "ends" / f"smallest_{name}_{end}{unit}" for end in ("", "lower_bound_"))
        peak, size = smallest.number(), (curve / "scale" / f"{name}_{unit}").number()
        # that the end is near to its bound proves nothing of the bound
        yield "status", smallest, accuracy * size + SPECK * peak - (peak - bound.number()), size


def _scale(statement: Statement, place: Place) -> Claim:
    """The peak without counterweights, or where that is next to nothing at most what they could make it."""
    machine, size = statement.machine, place.number()
    (rest,) = statement.values(machine.laden).values()
    most = statement.reachable(Place({}))
    if rest.low > (size * real(1e-6)).high:
        return near("yardstick", place, rest)
    if most is None:
        return "yardstick", place, None, ONE
    # where they make nothing, 1 kg m or 1 kg m^2 that turns with the shaft
    return "yardstick", place, largest(most, machine.square) * ABOUT_ONE - size, size


def _machine(request: Place, answer: Place, budget: Place) -> Machine:
    return Machine(request / "machine", request / "objective", answer / "reference_plane_m", budget)


def point(statement: Statement, request: Place, scale: Place, answer: Place) -> Claims:
    """One point of a front: nobody is below its corner in both weighted peaks."""
    proof, multipliers, status = answer / "certificate", answer / "multipliers", answer / "status"
    implied, place = proof / "implied_max_mass_kg", answer / "counterweights"
    optimal = status.text("optimal", "inaccurate") == "optimal"
    weights, mass = yield from counterweights(statement.machine, place, request / "machine")
    yield near("total_mass", answer / "total_mass_kg", mass)
    if statement.geared or list(answer / "balance_shafts"):
        turning, on_shafts = yield from shafts(statement.machine, request / "machine", answer / "balance_shafts")
        yield near("total_mass", answer / "balance_shafts_mass_kg", on_shafts)
        weights, mass = [*weights, *(weight for order, weight in turning if order == 1)], mass + on_shafts
    yield from ceilings(statement, weights, place, optimal)
    after = statement.machine.responses(weights)
    peaks = statement.values(after)
    relative, worst = proof / "relative_gap", ZERO
    for name, unit in NAMES.items():
        co, counter = after[name]
        yield near("after", answer / f"{name}_peak_{unit}", abs(co) + abs(counter))
        yield near("objective", answer / f"weighted_{name}_peak_{unit}", peaks[name])
        if answer / "worst_case":
            # of what nothing is said to be off
            yield near("worst_case", answer / "worst_case" / f"{name}_peak_{unit}", abs(co) + abs(counter))
        corner, size = proof / f"{name}_{unit}", (scale / f"{name}_{unit}").number()
        yield near("yardstick", proof / "yardstick" / f"{name}_{unit}", size)
        if corner:
            worst = largest(worst, (peaks[name] + SPECK * peaks[name] - corner.number()) * ABOUT_ONE / size)
            # the point is above its corner by no more than it says: that proves nothing of the corner
            above = peaks[name] + SPECK * peaks[name] - corner.number()
            yield "gap", relative, relative.number() * size - above, peaks[name]
    if relative:
        yield near("gap", relative, worst)
    if not optimal:
        yield "status", status, ONE, ONE
    if optimal:
        accuracy = (request / "accuracy" / "relative_gap").number(usual_gap(request / "machine"), least=0)
        yield "status", relative, accuracy - relative.number() if relative else None, ONE
    yield from _active(request, machine=statement.machine, place=answer, left=after, mass=mass)
    slack = {name: size * real(CEILING) for name, size in statement.sizes.items()}
    priced = partial(priced_at, {name: (proof / f"{name}_{unit}").number(0.0) for name, unit in NAMES.items()})
    of_corner = proven("corner", proof / "force_N", statement, multipliers / "objective", implied, slack, priced)
    yield from of_both(of_corner, proof)
    most = {name: (proof / f"mass_{name}_limit_{unit}").number(0.0) for name, unit in NAMES.items()}
    if proof / "mass_lower_bound_kg":
        yield from lightest(statement, proof, multipliers, most, after, mass)
        sizes = {name: (scale / f"{name}_{unit}").number() for name, unit in NAMES.items()}
        yield from light(statement, proof, sizes, mass)
        size, gap = (proof / "mass_yardstick_kg").number(0.0), mass - (proof / "mass_lower_bound_kg").number()
        yield near("mass_gap", proof / "mass_relative_gap", gap * ABOUT_ONE / size if size.low > 0 else ZERO)
        if optimal:
            yield "status", status, size * real(MASS_GAP) - gap, size


def _active(request: Place, machine: Machine, place: Place, left: Responses, mass: Number) -> Claims:
    rooms = touched(request, machine, left, mass)
    if rooms is not None:
        yield from active_limits("active_limits", place / "active_limits", rooms)


def sweep(request: Place, rows: Place) -> Iterator[Claim]:
    """Rows of a sweep, each as the answer to the base with the values of its axes or in an order of its cranks."""
    paths = [(axis / "path").text() for axis in request / "axes"]
    if (request / "design").value == ORDERED:
        paths = [f"/machine/throws/{t}/crank_angle_deg" for t, _ in enumerate(request / "angles_deg")]
    first = next(iter(rows), Place(None))
    for row in rows:
        if isinstance(row.value, dict) and isinstance(first.value, dict) and {*row.value} != {*first.value}:
            # all rows of a table have its columns
            yield "form", row, -ONE, ONE
        if (row / "status").text() in ("optimal", "inaccurate", "infeasible"):
            yield from covered(_design(request, paths, row))


def _design(request: Place, paths: Sequence[str], row: Place) -> Claims:
    """A row as the answer to the base with its values."""
    body, has_selection = (request / "base").value, bool(request / "columns")
    for path in paths:
        if has_selection and path not in row.value:
            raise NotCovered(row / path)
        body = with_value(body, path.split("/")[1:], (row / path).value, request / "axes")
    yield from covered(_row(Place(body, "request", "base"), row, has_selection))
    yield from (_on_axis(axis, row) for axis in request / "axes")
    if (request / "design").value == ORDERED:
        yield from _in_order([row / path for path in paths], request / "angles_deg")


def _in_order(cranks: Sequence[Place], order: Place) -> Claims:
    """Every angle stands in a row as often as it is listed."""
    angles, target = [crank.double() for crank in cranks], [item.double() for item in order]
    for crank, angle in zip(cranks, angles):
        times = [sum(abs((item - angle + 180) % 360 - 180) <= 360 * UNSURE for item in row) for row in (angles, target)]
        yield "axis", crank, ONE if times[0] == times[1] else -ONE, ONE


def _on_axis(axis: Place, row: Place) -> Claim:
    """A value of the axis: one of those that are listed, or between its ends."""
    path = (axis / "path").text()
    # of an item of a list, the name of the list says the unit
    where, place = [int(part) if part.isdecimal() else part for part in path.split("/")[1:]], row / path
    if axis / "values":
        allowed = [
            None if item.value is None else Place(item.value, "request", *where).double() for item in axis / "values"
        ]
    else:
        allowed = [Place((axis / name).value, "request", *where).double() for name in ("start", "stop")]
    if not place:
        return "axis", place, None if None in allowed else -ONE, ONE
    value, numbers = Place(place.value, "request", *where).double(), [item for item in allowed if item is not None]
    slack = UNSURE * max(map(abs, numbers), default=0.0)
    if axis / "values":
        on_axis = any(abs(value - item) <= slack for item in numbers)
    else:
        on_axis = min(numbers) - slack <= value <= max(numbers) + slack
    return "axis", place, ONE if on_axis else -ONE, ONE


def _row(request: Place, row: Place, has_selection: bool) -> Claims:
    """A row in the form of the answer to one request; what it does not hold stays out.

    ``has_selection``: whether it has some of its columns alone.
    """
    try:
        proof = json.loads((row / "multipliers").text(default="{}"))
    except (ValueError, RecursionError):
        proof = None
    if not isinstance(proof, dict):
        raise Unreadable((*row.path, "multipliers"), "must be a JSON object as a text")
    status = (row / "status").value
    weights = _weights(request / "machine", row, status)
    shafts = [
        {
            **{name: (shaft / name).value for name in ("name", "speed_ratio")},
            "counterweights": _weights(shaft, row, status),
        }
        for shaft in request / "machine" / "balance_shafts"
    ]
    limits = [field for field in (*CEILINGS.values(), *LOADED) if request / "objective" / field]
    loads = {name: value for name, value in row.value.items() if name.startswith(LOADS) and value is not None}
    peaks = {name: {f"peak_{unit}": (row / f"{name}_peak_{unit}").value} for name, unit in NAMES.items()}
    proofs = {**proof, **row.value, "multipliers": proof}
    answer = {
        "status": status,
        "counterweights": weights if status != "infeasible" else [],
        "total_mass_kg": (row / "total_mass_kg").value,
        "balance_shafts": shafts if status != "infeasible" else [],
        "balance_shafts_mass_kg": (row / "balance_shafts_mass_kg").value,
        "residual": {"after": peaks, "responses": list(_beside(row))} if status != "infeasible" else {"after": None},
        "bearing_columns": loads or None,
        "certificate": proofs if status != "infeasible" else None,
        "infeasibility": {**proofs, "conflict": limits} if status == "infeasible" else None,
        **_worst(row, status, proof.get("nominal")),
    }
    yield from _by_columns(single(request, Place(answer, *row.path), whole=False), row, answer, has_selection)
    if row / "multipliers":
        yield EVIDENCE, row / "multipliers", None, ONE


def _worst(row: Place, status: Any, nominal: Any) -> Dict[str, Any]:
    """The worst case and its price, where columns hold them; of several loads the largest alone is one.

    ``nominal``: what proves the optimum of the unchanged machine.
    """
    if status == "infeasible" or not row / OF_WORST[0]:
        return {}
    worst = {name[len("worst_case_") :]: (row / name).value for name in OF_WORST}
    beside = [
        {"response": name, "peak": (row / f"worst_case_{name}_peak_{response.unit}").value}
        for name, response in ON_FRAME.items()
        if name not in NAMES and row / f"worst_case_{name}_peak_{response.unit}"
    ]
    worst.update({"objective": (row / "objective").value, "responses": beside})
    price = {of: (row / name).value for name, of in OF_PRICE.items()}
    proof = nominal if isinstance(nominal, dict) else {}
    return {"worst_case": worst, "price_of_robustness": {**{f"nominal_{of}": proof[of] for of in proof}, **price}}


def _weights(shaft: Place, row: Place, status: Any) -> List[Dict[str, Any]]:
    """What the webs of a shaft carry."""
    weights = []
    for web in shaft / "webs":
        name = (web / "name").text()
        weights.append({"web": name, **{of: (row / f"{of}.{name}").value for of in ("mass_kg", "angle_deg")}})
        if status != "infeasible" and (web / "envelope" or weights[-1]["mass_kg"] is None):
            # a column that was not asked for; and of what is cut from a plate no row tells the radius
            raise NotCovered(row / f"mass_kg.{name}")
    return weights


def _by_columns(claims: Claims, row: Place, fields: Any, has_selection: bool) -> Claims:
    """Claims by the columns that they are about: of one that there is not nothing is claimed."""
    untold = has_selection and not {*row.value} >= OF_STATUS
    try:
        for claim, place, room, size in claims:
            if claim == "active_limits":
                # which limits are touched is in no column
                continue
            room = None if claim == "status" and untold else room
            path = _column(place.path, len(row.path), fields)
            there = path[-1] in row.value or (path[-1] == WITH_MULTIPLIERS and row / "multipliers")
            if there or place or not (has_selection or path[-1] in (NO_COLUMN, WITH_MULTIPLIERS)):
                yield claim, Place(place.value, *path), room, size
    except Unreadable as error:
        path = _column(error.path, len(row.path), fields)
        if has_selection and path[-1] not in row.value:
            raise NotCovered(Place(None, *path)) from None
        raise


def _beside(row: Place) -> Iterator[Dict[str, Any]]:
    """Peaks of the responses that count beside force and moment."""
    for name, response in ON_FRAME.items():
        column = f"{name}_peak_{response.unit}"
        if name not in NAMES and row / column:
            yield {"response": name, "after": (row / column).value}


def _column(path: Path, start: int, answer: Any) -> Path:
    """The column of a row in which a field of an answer stands."""
    row, inner = path[:start], path[start:]
    if inner[:1] in (("worst_case",), ("price_of_robustness",)) and len(inner) > 1:
        return (*row, _of_worst(inner, answer))
    if inner[-3:-2] == ("counterweights",):
        # of the crankshaft or of a balance shaft
        weight = answer
        for step in inner[:-1]:
            weight = weight[step]
        return (*row, f"{inner[-1]}.{weight['web']}")
    if inner[:1] == ("residual",) and len(inner) == 4:
        return (*row, _of_residual(inner, answer))
    if inner[:2] == ("infeasibility", "conflict"):
        return (*row, "status")
    if inner[:1] in (("certificate",), ("infeasibility",), ("bearing_columns",)):
        return (*row, *inner[1:2])
    return path


def _of_residual(inner: Path, answer: Any) -> str:
    """The same of what is left."""
    if inner[1] == "after":
        return f"{inner[2]}_{inner[3]}"
    name = answer["residual"]["responses"][inner[2]]["response"]
    return f"{name}_peak_{ON_FRAME[name].unit}"


def _of_worst(inner: Path, answer: Any) -> str:
    """The same of the worst case, and of what it costs; what proves that is in the column of all proofs."""
    name = str(inner[1])
    if inner[0] != "worst_case":
        return {of: column for column, of in OF_PRICE.items()}.get(name, "multipliers")
    if name == "responses" and len(inner) == 4:
        response = answer["worst_case"]["responses"][inner[2]]["response"]
        return f"worst_case_{response}_peak_{ON_FRAME[response].unit}"
    return name if name == "objective" else f"worst_case_{name}"
