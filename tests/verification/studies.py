"""Sweeps and fronts by chance, through what is otherwise asked of one machine.

A sweep varies any numeric fields of its base, also those that are null there. Values are lists with texts, null and
what no field takes, ranges, Latin hypercubes, orders of the cranks. Most ask for the multipliers that prove rows and
points.
"""

import json
import math
import random
from collections.abc import Iterator
from typing import Any

from optimizer.studies.pareto.pareto import pareto
from optimizer.studies.sweep import run_chunk
from schemas.base.model import Model
from schemas.base.target import BadPointer, Target, find_target, pointer
from schemas.front.pareto import ParetoRequest
from schemas.request.requests import OptimizeRequest
from schemas.sweep.request import SweepRequest
from service.common.validation import check

Body = dict[str, Any]

#: what is of one machine alone
_ALONE = ("alternatives", "fitted")
#: values of an axis
_LEVELS = (1, 2, 2, 3)
#: of so many studies one asks for no multipliers
_BARE = 10
#: what a number of a unit is in another one
_OTHER_UNITS = {"kg": ("lb", 1.0 / 0.45359237), "m": ("mm", 1e3), "rpm": ("Hz", 1.0 / 60.0), "N": ("kN", 1e-3)}


class Fault(Exception):
    """A row that computing broke down for."""


def sweep_of(body: Body, rng: random.Random) -> Body:
    """A sweep through a request to optimise.

    Raises
    ------
    InvalidRequest
        if that is none, without what a sweep does not take.
    """
    base = {name: value for name, value in body.items() if name not in _ALONE}
    proof: Body = {"base": base, "multipliers": rng.randrange(_BARE) > 0, "details": rng.randrange(_BARE) == 0}
    request = check(OptimizeRequest, base)
    cranks = [throw.crank_angle_deg for throw in getattr(request.machine, "throws", ())]
    if 2 <= len(cranks) <= 4 and rng.randrange(_BARE) == 0:
        angles = rng.choice([cranks, [90.0 * k for k in range(len(cranks))], [0.0] + [180.0] * (len(cranks) - 1)])
        return proof | {"design": "crank_orders", "angles_deg": angles}
    fields = list(_numbers(request, (), request))
    varied = rng.sample(fields, min(len(fields), rng.choice([1, 1, 2, 3])))
    design = rng.choice(["grid", "grid", "grid", "paired", "latin_hypercube"])
    if design == "latin_hypercube":
        axes = [_range(rng, *field) for field in varied]
        return proof | {"design": design, "axes": axes, "samples": 3, "seed": rng.randrange(99)}
    levels = [rng.choice(_LEVELS) if len(varied) < 3 else 2] * len(varied)
    return proof | {"design": design, "axes": [_axis(rng, *f, count) for f, count in zip(varied, levels, strict=True)]}


def front_of(body: Body, rng: random.Random) -> Body:
    """A front of force and moment of a request to optimise."""
    fields = {name: value for name, value in body.items() if name not in _ALONE}
    request = fields | {"points": rng.choice([2, 3, 3, 5])}
    webs, machine = request["machine"].get("webs", ()), request["machine"]
    chosen = {"catalogue", "web_groups"} & machine.keys() or any(
        {"envelope", "min_fitted_mass_kg", "hole_angles_deg", "catalogue_masses_kg"} & web.keys() for web in webs
    )
    if not chosen and rng.randrange(_BARE):
        request["multipliers"] = True
    if rng.random() < 0.3 and not machine.get("balance_shafts"):
        most = sum(web.get("max_mass_kg") or 10.0 for web in webs if isinstance(web.get("max_mass_kg", 0.0), float))
        request["total_mass_budgets_kg"] = [share * (most or 1.0) for share in rng.choice([(0.5,), (0.0, 0.3, 1.5)])]
    return request


def sweep_rows(body: Body) -> Any:
    """Rows of a sweep as a client reads them.

    Raises
    ------
    Fault
        if computing broke down for one of them.
    """
    request = check(SweepRequest, body)
    rows = run_chunk(request.model_dump_json().encode(), 0, request.total).to_pylist()
    failed = [f"row {row['index']}: {row['message']}" for row in rows if row["status"] == "failed"]
    if failed:
        raise Fault(*failed)
    return rows


def front_answer(body: Body) -> Any:
    """A front as a client reads it."""
    return json.loads(pareto(check(ParetoRequest, body)).model_dump_json())


def _numbers(value: Any, path: tuple[str | int, ...], request: Model) -> Iterator[tuple[Target, float | None]]:
    """Numeric fields of machine and objective with their values."""
    if isinstance(value, Model):
        parts: Iterator[tuple[str | int, Any]] = ((name, getattr(value, name)) for name in type(value).model_fields)
    elif isinstance(value, tuple):
        parts = enumerate(value)
    else:
        if not isinstance(value, str | bool):
            try:
                yield find_target(request, pointer(path)), value
            except BadPointer:
                # null of what is no number
                return
        return
    for name, part in parts:
        if path or name in ("machine", "objective"):
            yield from _numbers(part, (*path, name), request)


def _near(rng: random.Random, target: Target, value: float | None) -> float:
    """A number that a field may take, or one a little outside."""
    if value is None or value == 0.0:
        value = rng.choice([0.0, 10.0 ** rng.uniform(-3.0, 4.0)])
    factor = rng.choice([0.5, 0.9, 1.0, 1.0 + 1e-9, 1.1, 2.0, rng.uniform(0.0, 3.0), 10.0 ** rng.uniform(-6.0, 6.0)])
    number = value * factor
    if rng.random() < 0.9:
        number = min(max(number, target.lowest), target.highest)
    return float(round(number)) if target.integer and abs(number) < 1e9 else number


def _value(rng: random.Random, target: Target, value: float | None) -> Any:
    """What may stand in a field: a number, a text with a unit, null."""
    if target.nullable and rng.random() < 0.2:
        return None
    number = _near(rng, target, value)
    if target.takes_text and target.unit in _OTHER_UNITS and rng.random() < 0.15:
        unit, factor = _OTHER_UNITS[target.unit]
        return f"{number * factor!r} {unit}" if math.isfinite(number * factor) else number
    return number


def _range(rng: random.Random, target: Target, value: float | None) -> Body:
    start, stop = _near(rng, target, value), _near(rng, target, value)
    spacing = "log" if min(start, stop) > 0.0 and rng.random() < 0.3 else "linear"
    return {"path": pointer(target.path), "start": start, "stop": stop, "spacing": spacing}


def _axis(rng: random.Random, target: Target, value: float | None, count: int) -> Body:
    if count > 1 and rng.random() < 0.2:
        return _range(rng, target, value) | {"count": count}
    return {"path": pointer(target.path), "values": [_value(rng, target, value) for _ in range(count)]}
