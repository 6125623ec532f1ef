"""Random machines of ordinary sizes, whose counterweights have sectors or not, as request bodies."""

from collections.abc import Mapping

import numpy as np

from tests.hard.cases.case import Body, machine, row, throw

_PITCH_M = 0.4
_CUSTOMARY_DEG = (0.0, 90.0, 120.0, 180.0, 240.0, 270.0)
#: radius to which plates reach, against that of other counterweights
_OUTER = 1.3


def crankshaft(rng: np.random.Generator, sectors: float = 0.0, rods: bool = False, most_throws: int = 5) -> Body:
    """One to five throws with two webs each.

    Parameters
    ----------
    sectors : share of webs that have a sector opposite their cranks.
    rods : connecting rods, and bearings between the throws.
    """
    throws, webs = [], []
    count = int(rng.integers(1, most_throws + 1))
    for k in range(count):
        crank = float(rng.choice([*_CUSTOMARY_DEG, rng.uniform(0, 360)]))
        more: Body = {}
        if rods:
            more["connecting_rod"] = {"length_m": float(rng.uniform(0.35, 0.6)), "mass_kg": float(rng.uniform(0, 10))}
        rows = [
            row(float(rng.choice([0, 45, 90, 180])), float(10 ** rng.uniform(0, 2.5)), **more)
            for _ in range(rng.integers(int(rods), 3))
        ]
        throws.append(throw(_PITCH_M * k, crank, rows, rotating=float(10 ** rng.uniform(-1, 2))))
        webs += [
            _web(rng, f"{k}{side}", _PITCH_M * (k + at), crank, sectors) for side, at in (("a", -0.25), ("b", 0.25))
        ]
    design = machine(throws, webs)
    if rods:
        design["bearings"] = [
            {"name": str(k), "position_m": _PITCH_M * (k - 0.5), "diameter_m": 0.1, "length_m": 0.05}
            for k in range(count + 1)
        ]
    return design


def _web(rng: np.random.Generator, name: str, z: float, crank: float, sectors: float) -> Body:
    web: Body = {
        "name": name,
        "position_m": z,
        "counterweight_radius_m": 0.2,
        "max_mass_kg": float(10 ** rng.uniform(0.5, 2.2)),
    }
    if rng.random() < sectors:
        half = float(rng.choice([10, 30, 60, 90]))
        web["sector"] = {"centre_deg": (crank + 180) % 360, "half_angle_deg": half}
    return web


def with_plates(rng: np.random.Generator, body: Body) -> Body:
    """The machine with plates on all webs, or on some: mostly of one kind."""
    share, outer = rng.choice([1.0, 0.5]), _OUTER * 0.2
    kinds = [
        {
            "shape": str(rng.choice(["sector", "segment"])),
            "inner_radius_m": float(rng.uniform(0.0, 0.4)) * outer,
            "outer_radius_m": outer,
            "thickness_m": float(10 ** rng.uniform(-2.0, -1.0)),
            "max_half_angle_deg": float(rng.choice([60.0, 75.0, 90.0])),
        }
        for _ in range(rng.integers(1, 3))
    ]
    for web in body["webs"]:
        if rng.random() < share:
            del web["counterweight_radius_m"], web["max_mass_kg"]
            web["envelope"] = dict(kinds[rng.integers(len(kinds))])
    return body


def with_budget(rng: np.random.Generator, body: Body) -> Body:
    """The machine with a limit of the total mass, of which webs take a few times as much."""
    body["max_total_mass_kg"] = float(rng.uniform(0.1, 0.8)) * sum(web["max_mass_kg"] for web in body["webs"])
    return body


def with_groups(rng: np.random.Generator, body: Body) -> Body:
    """The machine with the two webs of some throws alike, or mirror images of one another."""
    body["web_groups"] = []
    for number, (first, second) in enumerate(zip(body["webs"][::2], body["webs"][1::2], strict=True)):
        if number and rng.random() < 0.5:
            continue
        first["throw"] = second["throw"] = number
        for name in ("max_mass_kg", "sector"):
            second.pop(name, None)
            if name in first:
                second[name] = first[name]
        both = [first["name"], second["name"]]
        body["web_groups"].append({"name": str(number), "webs": both, "mirror": bool(rng.random() < 0.5)})
    return body


def with_balance_shafts(rng: np.random.Generator, body: Body) -> Body:
    """The machine with a shaft that turns against it."""
    at = [(-0.3, "near"), (0.6, "far")]
    webs = [
        {"name": name, "position_m": z, "counterweight_radius_m": 0.1, "max_mass_kg": float(10 ** rng.uniform(0, 2))}
        for z, name in at
    ]
    body["balance_shafts"] = [{"name": "balancer", "speed_ratio": -1, "x_m": 0.1, "y_m": 0.05, "webs": webs}]
    return body


def scenarios(rng: np.random.Generator, body: Body) -> list[Mapping[str, object]]:
    """Two scenarios: as the machine is, and with another reciprocating or rotating mass."""
    throws = body["throws"]
    path, old = "/machine/throws/0/rotating_mass_kg", throws[0]["rotating_mass_kg"]
    if throws[-1]["rows"]:
        path = f"/machine/throws/{len(throws) - 1}/rows/0/reciprocating_mass_kg"
        old = throws[-1]["rows"][0]["reciprocating_mass_kg"]
    change = {"path": path, "value": old * float(rng.uniform(0.7, 1.5))}
    return [{"name": "as it is"}, {"name": "other", "changes": [change]}]
