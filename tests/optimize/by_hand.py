"""Bounds evaluated from a request and the multipliers in its answer alone, in 60 digits: the proof checked by hand.

Independent of the package: the machine is summed up from the definitions of the contract, and the bound is the formula
of docs/mathematics.md section 5. Bodies carry plain numbers here, no strings with units.
"""

import json
from collections.abc import Mapping
from typing import Any, NamedTuple

from mpmath import MPContext, mpc, mpf

mp = MPContext()
mp.dps = 60

JSON = Mapping[str, Any]


class Phasors(NamedTuple):
    """What turns with the shaft and what turns against it, over omega^2."""

    co: mpc
    counter: mpc


class Machine(NamedTuple):
    """A machine as far as the first order needs it."""

    square: mpf  # omega^2
    responses: dict[str, Phasors]
    arms: dict[str, list[mpf]]  # influence of a kg m on each web
    webs: list[JSON]
    budget: mpf | None
    span: mpf


def turned(degrees: Any) -> mpc:
    """Unit vector of an angle; quarter turns are exact."""
    quarters = mp.mpf(degrees) / 90
    if quarters == mp.floor(quarters):
        return [mp.mpc(1, 0), mp.mpc(0, 1), mp.mpc(-1, 0), mp.mpc(0, -1)][int(quarters) % 4]
    return mp.expjpi(mp.mpf(degrees) / 180)


def machine(body: JSON, reference_plane: float) -> Machine:
    """Sums of the contract, sections 3 and 1."""
    co: list[tuple[mpc, mpf]] = []
    counter: list[tuple[mpc, mpf]] = []

    def slides(mass: Any, radius: Any, crank: Any, axis: Any, plane: Any) -> None:
        half = mp.mpf(mass) * mp.mpf(radius) / 2
        co.append((half * turned(crank), plane))
        counter.append((half * turned(axis) ** 2 / turned(crank), plane))

    if body["kind"] == "reciprocating":
        planes = [mp.mpf(throw["position_m"]) for throw in body["throws"]]
        for throw, plane in zip(body["throws"], planes, strict=True):
            radius, angle = mp.mpf(throw["crank_radius_m"]), throw["crank_angle_deg"]
            co.append((mp.mpf(throw["rotating_mass_kg"]) * radius * turned(angle), plane))
            for row in throw["rows"]:
                own = plane + mp.mpf(row["offset_m"])
                mass = mp.mpf(row["reciprocating_mass_kg"])
                if row["connecting_rod"] is not None:
                    share, rod = mp.mpf(row["connecting_rod"]["reciprocating_share"]), row["connecting_rod"]["mass_kg"]
                    mass += share * rod
                    co.append(((1 - share) * rod * radius * turned(angle), own))
                slides(mass, radius, angle, row["axis_deg"], own)
    else:
        guide, radius = body["anti_rotation"], mp.mpf(body["orbit_radius_m"])
        place, guide_plane = mp.mpf(body["orbiting_position_m"]), mp.mpf(guide["position_m"])
        planes = [place, guide_plane]
        co.append((body["orbiting_mass_kg"] * radius, place))
        if guide["type"] == "oldham":
            slides(guide["mass_kg"], radius, 0, guide["axis_deg"], guide_plane)
        else:
            co.append((guide["count"] * mp.mpf(guide["eccentric_mass_kg"]) * radius, guide_plane))
    reference = mp.mpf(reference_plane)
    force = Phasors(mp.fsum(f for f, _ in co), mp.fsum(b for b, _ in counter))
    moment = Phasors(mp.fsum((z - reference) * f for f, z in co), mp.fsum((z - reference) * b for b, z in counter))
    webs, budget = body["webs"], body["max_total_mass_kg"]
    places = planes + [mp.mpf(web["position_m"]) for web in webs]
    span = max(places) - min(places)
    return Machine(
        square=(mp.mpf(body["speed_rpm"]) * mp.pi / 30) ** 2,
        responses={"force": force, "moment": moment},
        arms={
            "force": [mp.mpf(1)] * len(webs),
            "moment": [mp.mpf(web["position_m"]) - reference for web in webs],
        },
        webs=webs,
        budget=None if budget is None else mp.mpf(budget),
        span=span if span > 0 else mp.mpf(1),
    )


def weights(body: JSON, objective: JSON, reference_plane: float) -> dict[str, mpf]:
    """w_F and w_M, with the default 1/L."""
    moment_weight = objective["moment_weight"]
    return {
        "force": mp.mpf(objective["force_weight"]),
        "moment": 1 / machine(body, reference_plane).span if moment_weight is None else mp.mpf(moment_weight),
    }


def bound(
    body: JSON,
    reference_plane: float,
    multipliers: JSON,
    weight: Mapping[str, Any],
    across: tuple[Any, Any] = (1, 1),
    ceilings: Mapping[str, Any] | None = None,
    mass_cost: int = 0,
    reaches: Mapping[str, float] | None = None,
) -> mpf:
    """Least value of the Lagrangian over the limits.

    Parameters
    ----------
    weight : w of each response whose peak is in the objective.
    across : direction weights.
    ceilings : largest peaks allowed, N and N m.
    mass_cost : 0 in a bound on the objective, 1 in one on the mass.
    reaches : implied limits of webs without one, kg.
    """
    design = machine(body, reference_plane)
    square = design.square
    slope = [mp.mpc(0)] * len(design.webs)
    rows = {row["name"]: mp.mpf(row["value"]) for row in multipliers["rows"]}
    constant = mp.mpf(0)
    wx, wy = (mp.mpf(coordinate) for coordinate in across)
    if multipliers["terms"]:
        for name, factor in weight.items():
            if wx == wy and factor > 0:
                row = rows[next(term["row"] for term in multipliers["terms"] if term["response"] == name)]
                constant += row * factor * wx * abs(design.responses[name].counter) * square
    for term in multipliers["terms"]:
        name = term["response"]
        p, q = weight[name] * (wx + wy) / 2, weight[name] * (wx - wy) / 2
        if term["part"] == "counter":
            p, q = q, p
        y = mp.mpc(term["x"], term["y"])
        assert abs(y) <= rows[term["row"]]
        f, b = design.responses[name]
        constant += mp.re(mp.conj(y) * (p * f + q * mp.conj(b))) * square
        slope = [w + p * arm * y * square for w, arm in zip(slope, design.arms[name], strict=True)]
    for ceiling in multipliers["ceilings"]:
        name, price = ceiling["response"], mp.mpc(ceiling["x"], ceiling["y"])
        f, b = design.responses[name]
        cap = mp.mpf((ceilings or {})[name]) - abs(b) * square
        length = abs(price)
        if not multipliers["terms"]:
            assert length <= rows[name]
            length = rows[name]
        constant += mp.re(mp.conj(price) * f) * square - length * cap
        slope = [w + arm * price * square for w, arm in zip(slope, design.arms[name], strict=True)]
    beta = mp.mpf(multipliers["budget"])
    assert design.budget is not None or beta == 0
    total = constant
    for web, w in zip(design.webs, slope, strict=True):
        most = web["max_mass_kg"] if web["max_mass_kg"] is not None else (reaches or {})[web["name"]]
        most = mp.mpf(most) if design.budget is None else min(mp.mpf(most), design.budget)
        worth = mp.mpf(web["counterweight_radius_m"]) * support(-w, web["sector"])
        total -= most * max(worth - mass_cost - beta, mp.mpf(0))
    return total - (0 if design.budget is None else beta * design.budget)


def support(g: mpc, sector: JSON | None) -> mpf:
    """Largest Re(conj(g) v) over unit-disc vectors v in a sector."""
    if sector is None:
        return abs(g)
    g = g / turned(sector["centre_deg"])
    half = turned(sector["half_angle_deg"])
    sine, cosine = mp.im(half), mp.re(half)
    across = abs(mp.im(g))
    if across * cosine <= mp.re(g) * sine:
        return abs(g)
    return max(mp.re(g) * cosine + across * sine, mp.mpf(0))


def of_answer(request: JSON, answer: JSON) -> dict[str, tuple[mpf, float]]:
    """Every bound of an optimize answer: by hand, and as printed.

    Parameters
    ----------
    request : with its defaults filled in.
    """
    body, objective = request["machine"], request["objective"]
    plane = answer["reference_plane_m"]
    ceilings = ceilings_of(objective)
    if answer["status"] == "infeasible":
        infeasibility = answer["infeasibility"]
        proofs = infeasibility["multipliers"]
        return {
            "conflict": (bound(body, plane, proofs["conflict"], {}, ceilings=ceilings), 0.0),
            "smallest_force": (
                bound(body, plane, proofs["smallest_force"], {"force": 1}),
                infeasibility["smallest_force_lower_bound_N"],
            ),
            "smallest_moment": (
                bound(body, plane, proofs["smallest_moment"], {"moment": 1}),
                infeasibility["smallest_moment_lower_bound_Nm"],
            ),
        }
    certificate = answer["certificate"]
    return of_certificate(request, plane, certificate["multipliers"], certificate)


def of_certificate(request: JSON, plane: float, proofs: JSON, single_bound: JSON) -> dict[str, tuple[mpf, float]]:
    """Both bounds: by hand, and as told."""
    body, objective = request["machine"], request["objective"]
    across, ceilings = directions_of(objective), ceilings_of(objective)
    weight = {
        name: single_weight for name, single_weight in weights(body, objective, plane).items() if single_weight > 0
    }
    payload, reaches = {}, single_bound.get("implied_max_mass_kg")
    first = proofs["objective"]
    rows = mp.fsum(row["value"] for row in first["rows"])
    least = bound(body, plane, first, weight, across, ceilings, 0, reaches) / rows
    if single_bound["lower_bound"] is not None:
        payload["objective"] = least, single_bound["lower_bound"]
    if proofs["mass"] is not None and single_bound["mass_lower_bound_kg"] is not None:
        allowed = weighed(proofs["mass"], *[single_bound["mass_objective_limit"]] * len(proofs["mass"]["rows"]))
        lightest = bound(body, plane, proofs["mass"], weight, across, ceilings, 1, reaches) - allowed
        payload["mass"] = max(lightest, mp.mpf(0)), single_bound["mass_lower_bound_kg"]
    return payload


def weighed(multipliers: JSON, *values: float) -> mpf:
    """What the rows weigh: sum of row times value."""
    return mp.fsum(mp.mpf(row["value"]) * value for row, value in zip(multipliers["rows"], values, strict=True))


def ceilings_of(objective: JSON) -> dict[str, float]:
    fields = {"force": objective["force_ceiling_N"], "moment": objective["moment_ceiling_Nm"]}
    return {name: ceiling for name, ceiling in fields.items() if ceiling is not None}


def directions_of(objective: JSON) -> tuple[float, float]:
    return objective["direction_weights"]["x"], objective["direction_weights"]["y"]


def of_front(request: JSON, front: JSON, plane: float) -> dict[str, tuple[mpf, float]]:
    """Every bound of a front without infeasibility: by hand, and as printed.

    A corner is proven by what its rows weigh: sum of row times corner.
    """
    body = {**request["machine"], "max_total_mass_kg": front["max_total_mass_kg"]}
    objective, ones = request["objective"], {"force": 1, "moment": 1}
    ceilings, across, reaches = ceilings_of(objective), directions_of(objective), front["implied_max_mass_kg"]
    ends = front["ends"]
    fields = {
        name: (
            bound(body, plane, ends["multipliers"][name], ones, across, ceilings, 0, reaches),
            ends[f"{name}_lower_bound_{unit}"],
        )
        for name, unit in (("smallest_force", "N"), ("smallest_moment", "Nm"))
    }
    for k, point in enumerate(front["points"]):
        proofs, certificate = point["multipliers"], point["certificate"]
        corner = weighed(proofs["objective"], certificate["force_N"], certificate["moment_Nm"])
        assert certificate["implied_max_mass_kg"] == reaches
        fields[f"corner {k}"] = bound(body, plane, proofs["objective"], ones, across, ceilings, 0, reaches), corner
        if proofs["mass"] is not None:
            allowed = weighed(proofs["mass"], certificate["mass_force_limit_N"], certificate["mass_moment_limit_Nm"])
            lightest = bound(body, plane, proofs["mass"], ones, across, ceilings, 1, reaches) - allowed
            fields[f"mass {k}"] = max(lightest, mp.mpf(0)), certificate["mass_lower_bound_kg"]
    return fields


def of_row(request: JSON, plane: float, row: JSON) -> dict[str, tuple[mpf, float]]:
    """Every bound of a row of a sweep: by hand, and as printed.

    Parameters
    ----------
    request : that of the design, with its defaults filled in.
    """
    proofs = json.loads(row["multipliers"])
    body, objective = request["machine"], request["objective"]
    ceilings = ceilings_of(objective)
    if row["status"] == "infeasible":
        return {"conflict": (bound(body, plane, proofs["conflict"], {}, ceilings=ceilings), 0.0)}
    return of_certificate(request, plane, proofs, {**row, **proofs})
