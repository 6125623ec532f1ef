"""Rows of sweeps: each by what is done with one answer."""

from __future__ import annotations

import json
from typing import Any, Dict, Iterator, List, Sequence

from verify_cases import with_value
from verify_ceilings import LOADED
from verify_claims import EVIDENCE, Claim, Claims, covered
from verify_leaves import Path
from verify_machine import NAMES, ON_FRAME
from verify_numbers import ONE, NotCovered, Place, Unreadable
from verify_program import CEILINGS
from verify_single import single

UNSURE = 1e-9
CRANK_ORDERS = "crank_orders"  # a design that varies the crank angles instead of axes
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


def sweep(request: Place, rows: Place) -> Iterator[Claim]:
    """Rows of a sweep, each as the answer to the base with the values of its axes or in an order of its cranks."""
    paths = [(axis / "path").text() for axis in request / "axes"]
    if (request / "design").value == CRANK_ORDERS:
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
    if (request / "design").value == CRANK_ORDERS:
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
