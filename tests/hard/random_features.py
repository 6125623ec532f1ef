"""What else a random body may ask for: catalogues, plates, balance shafts, scenarios, tolerances, parts to match.

Every feature takes a drawn body and gives another one that the schema accepts, in most cases.
"""

import copy
from collections.abc import Callable, Mapping
from typing import Any

from tests.hard.random_bodies import Body, Draw, web

#: searches among discrete choices end here; what they have found by then is an answer
_TIME_LIMITS = (0.01, 0.1, 0.3)


def catalogue(draw: Draw, body: Body) -> Body:
    """Counterweights from lists or steps of masses, at holes or steps of angles, any number of them."""
    rng, machine = draw.rng, body["machine"]
    step = rng.random() < 0.3
    machine["catalogue"] = {
        "masses_kg": None if step else _masses(draw),
        "mass_step_kg": draw.size(-12, 15, (0.1, 10)) if step else None,
        "angle_step_deg": draw.choice(0.5, 5, 15, 45, 72, 90, 120, 180),
        "max_part_numbers": draw.choice(None, None, 1, 2),
    }
    machine["max_counterweights"] = draw.choice(None, None, 0, 1, 2, 5)
    counting: list[Body] = []
    for place in machine["webs"]:
        if step:
            place["max_mass_kg"] = machine["catalogue"]["mass_step_kg"] * draw.choice(0, 0.5, 1, 1 + 1e-15, 3.7, 25)
        if rng.random() < 0.2:
            place["catalogue_masses_kg"] = _masses(draw)
        elif step:
            counting.append(place)
        if machine["kind"] == "reciprocating" and rng.random() < 0.8:
            place["throw"] = rng.randrange(len(machine["throws"]))
        if rng.random() < 0.3:
            place["hole_angles_deg"] = _holes(draw, place["sector"])
    if counting and 0 < max(place["max_mass_kg"] for place in counting) < machine["catalogue"]["mass_step_kg"]:
        # a step that nothing can carry is refused
        counting[0]["max_mass_kg"] = machine["catalogue"]["mass_step_kg"]
    body["accuracy"]["time_limit_s"] = draw.choice(*_TIME_LIMITS)
    return body


def _masses(draw: Draw) -> list[float]:
    return sorted({draw.size(-15, 15, (1, 60)) for _ in range(draw.rng.randint(1, 6))})


def _holes(draw: Draw, sector: Body | None) -> list[float]:
    if sector is None:
        return sorted({draw.angle() for _ in range(draw.rng.randint(1, 12))})
    half = sector["half_angle_deg"]
    return sorted({sector["centre_deg"] + half * draw.choice(-1, 0, 1, draw.rng.uniform(-1, 1)) for _ in range(4)})


def plates(draw: Draw, body: Body) -> Body:
    """Counterweights that are cut from plates, beside some of a known radius."""
    machine, goal = body["machine"], body["objective"]
    for place in machine["webs"]:
        if draw.rng.random() < 0.8:
            place["envelope"] = _plate(draw)
            del place["counterweight_radius_m"], place["max_mass_kg"]
    if machine["max_total_mass_kg"] is not None:
        goal |= {"force_ceiling_N": None, "moment_ceiling_Nm": None}
    body["accuracy"]["time_limit_s"] = draw.choice(*_TIME_LIMITS, 5.0)
    return body


def _plate(draw: Draw) -> Body:
    outer = draw.size(-4, 3, (0.1, 0.4))
    return {
        "shape": draw.choice("sector", "segment"),
        "outer_radius_m": outer,
        "inner_radius_m": outer * draw.choice(0.0, 1e-9, draw.rng.uniform(0, 0.999), 0.99, 0.999),
        "thickness_m": draw.size(-5, 2, (0.01, 0.1)),
        "density_kg_m3": draw.size(0, 5, (2700, 11300)),
        "max_half_angle_deg": draw.choice(90.0, 90.0, 89.999999, 0.1, draw.rng.uniform(0.1, 90)),
    }


def shafts(draw: Draw, body: Body) -> Body:
    """Balance shafts beside the crankshaft, with ceilings along the axes where whole ones do not go."""
    machine, goal, rng = body["machine"], body["objective"], draw.rng
    machine["balance_shafts"] = [
        {
            "name": f"shaft {k}",
            "speed_ratio": draw.choice(-2, -1, -1, 1, 2),
            "x_m": draw.place(),
            "y_m": draw.place(),
            "webs": [web(draw, 10 * (k + 1) + i) for i in range(rng.randint(1, 3))],
        }
        for k in range(rng.choice([1, 1, 2, 3]))
    ]
    machine["max_total_mass_kg"] = None
    if any(shaft["speed_ratio"] == -1 for shaft in machine["balance_shafts"]):
        goal |= {"force_ceiling_N": None, "moment_ceiling_Nm": None}
    return axis_ceilings(draw, body)


def plates_on_shafts(draw: Draw, body: Body) -> Body:
    """Plates on balance shafts and beside them."""
    body = shafts(draw, body)
    for shaft in (body["machine"], *body["machine"]["balance_shafts"]):
        for place in shaft["webs"]:
            if draw.rng.random() < 0.6:
                place["envelope"] = _plate(draw)
                for name in ("counterweight_radius_m", "max_mass_kg", "max_centrifugal_force_N"):
                    place.pop(name, None)
    body["accuracy"]["time_limit_s"] = draw.choice(*_TIME_LIMITS)
    return body


def axis_ceilings(draw: Draw, body: Body) -> Body:
    """Ceilings of force and moment along x and y."""
    for name in ("force_ceiling_x_N", "force_ceiling_y_N", "moment_ceiling_x_Nm", "moment_ceiling_y_Nm"):
        body["objective"][name] = draw.choice(None, None, None, draw.size(-12, 30, (1e2, 1e5), zero=True))
    return body


def scenarios(draw: Draw, body: Body) -> Body:
    """Other speeds, masses and places that the counterweights are to suit as well."""
    numbers = list(_changeable(body["machine"]))
    body["scenarios"] = [
        {
            "name": str(k),
            "weight": draw.size(-30, 12, (0.1, 3)),
            "changes": [
                {"path": path, "value": _changed(draw, path, value)}
                for path, value in draw.rng.sample(numbers, draw.rng.randint(0, min(4, len(numbers))))
            ],
        }
        for k in range(draw.rng.choice([1, 2, 2, 3, 5]))
    ]
    return tolerances(draw, body) if draw.rng.random() < 0.3 else body


def _changeable(machine: Body) -> "list[tuple[str, float]]":
    """Numbers that a scenario may change, by pointer."""
    values = [("/machine/speed_rpm", machine["speed_rpm"])]
    places = {"/machine": machine, "/machine/anti_rotation": machine.get("anti_rotation", {})}
    places |= {f"/machine/webs/{k}": {"position_m": plane["position_m"]} for k, plane in enumerate(machine["webs"])}
    for t, throw in enumerate(machine.get("throws", [])):
        places[f"/machine/throws/{t}"] = throw
        places |= {f"/machine/throws/{t}/rows/{i}": row for i, row in enumerate(throw["rows"])}
    for at, fields in places.items():
        for name, value in fields.items():
            if isinstance(value, float) and name.endswith(("_m", "_kg", "_deg")) and not name.startswith("max_"):
                values.append((f"{at}/{name}", value))
    return values


def _changed(draw: Draw, path: str, value: float) -> float:
    if path.endswith("_deg"):
        return draw.angle()
    if path.endswith(("position_m", "offset_m", "plane_m")):
        return draw.choice(draw.place(), value * (1 + 1e-12))
    return draw.choice(value * draw.rng.uniform(0.5, 1.5), value * (1 + 1e-15), draw.size(-9, 9, (0.1, 100)))


def tolerances(draw: Draw, body: Body) -> Body:
    """What may be off, from nothing to a whole counterweight anywhere."""
    body["tolerances"] = {
        "mass_relative": draw.choice(0.0, 1e-12, draw.rng.uniform(0, 0.05), draw.rng.random(), 1.0),
        "angle_deg": draw.choice(0.0, 1e-9, draw.rng.uniform(0, 5), 180.0, 1e6),
        "unbalance_kg_m": draw.choice(0.0, 0.0, draw.size(-15, 15, (1e-4, 1e-2))),
        "reciprocating_mass_relative": draw.choice(0.0, 0.0, draw.rng.uniform(0, 0.05), 1.0),
    }
    return body


def parts(draw: Draw, body: Body) -> Body:
    """Rows made of parts, and rods with a centre of mass."""
    for throw in body["machine"]["throws"]:
        for row in throw["rows"]:
            row["parts"] = [
                {"name": str(k), "mass_kg": draw.size(-15, 15, (1, 50), zero=True), "motion": motion}
                for k, motion in enumerate(draw.rng.choices(("reciprocating", "rotating"), k=draw.rng.randint(1, 4)))
            ]
            if draw.rng.random() < 0.7:
                del row["reciprocating_mass_kg"]
            rod = row["connecting_rod"]
            if rod is not None and rod["length_m"] is not None:
                rod["centre_of_mass_m"] = rod["length_m"] * draw.choice(1e-6, 1 / 3, 1.0, draw.rng.uniform(0.1, 0.9))
    return body


def match(draw: Draw, body: Body) -> Body:
    """Parts and nuts for the rows, on counterweights that are there or are chosen."""
    machine, rng = body["machine"], draw.rng
    rows = [{"throw": t, "row": i} for t, throw in enumerate(machine["throws"]) for i in range(len(throw["rows"]))]
    parts = []
    for k in range(rng.randint(0 if rows else 1, 3)):
        places = rng.sample(rows, rng.randint(min(1, len(rows)), len(rows)))
        size = draw.size(-15, 15, (1, 100), zero=True)
        scatter = draw.choice(0.0, 1e-15, 0.01, 1.0)
        parts.append(
            {
                "class": f"class {k}",
                "names": [f"{k}.{n}" for n in range(len(places))],
                "masses_kg": [min(size * (1 + scatter * rng.random()), 1e15) for _ in places],
                "rows": places,
            }
        )
    nuts = [draw.size(-15, 15, (0.1, 5), zero=True) for _ in range(rng.choice([0, 0, 1, 2, 4]))]
    chosen = rng.random() < 0.5
    if chosen:
        for place in machine["webs"]:
            place["max_mass_kg"] = min(1e15 if place["max_mass_kg"] is None else place["max_mass_kg"], 1e15)
    goal = {name: value for name, value in body["objective"].items() if "ceiling" not in name}
    return {
        "machine": machine,
        "parts": parts,
        "balance_nuts_kg": nuts if parts or nuts else [1.0],
        "choose_counterweights": chosen,
        "objective": goal,
        "accuracy": body["accuracy"],
    }


#: by name, and whether a machine without throws has it
FEATURES: Mapping[str, tuple[Callable[[Draw, Body], Body], bool]] = {
    "catalogue": (catalogue, True),
    "plates": (plates, True),
    "balance shafts": (shafts, False),
    "plates on shafts": (plates_on_shafts, False),
    "axis ceilings": (axis_ceilings, True),
    "scenarios": (scenarios, True),
    "tolerances": (tolerances, True),
    "parts": (parts, False),
    "match": (match, False),
}


def with_feature(draw: Draw, body: Body, feature: str) -> Body:
    """The body with a feature; as it is where its machine cannot have it."""
    add, of_all = FEATURES[feature]
    if not of_all and body["machine"]["kind"] != "reciprocating":
        return body
    value: Any = add(draw, copy.deepcopy(body))
    return dict(value)
