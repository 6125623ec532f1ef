"""Random bodies that the schema accepts: machines and objectives of any size in any field."""

import random
from typing import Any

Body = dict[str, Any]


class Draw:
    """Numbers of every size that the schema allows, ordinary ones more often."""

    def __init__(self, rng: random.Random) -> None:
        self.rng = rng
        self.wild = rng.random()  # how much of this body is out of the ordinary

    def size(self, low: float, high: float, ordinary: tuple[float, float], zero: bool = False) -> float:
        """A number between 10^low and 10^high, or one of ordinary size, or 0."""
        if self.rng.random() > self.wild:
            return self.rng.uniform(*ordinary)
        if zero and self.rng.random() < 0.2:
            return 0.0
        return self.rng.choice([1.0, self.rng.uniform(1.0, 10.0)]) * 10.0 ** self.rng.randint(
            round(low), round(high) - 1
        )

    def place(self) -> float:
        if self.rng.random() > self.wild:
            return self.rng.uniform(-1.0, 1.0)
        near = self.rng.choice([0.0, 0.0, 0.1, 1e-15, 0.1 + 1e-12, -0.5])
        return self.rng.choice([near, self.rng.choice([-1, 1]) * self.size(-20, 9, (0.0, 1.0))])

    def angle(self) -> float:
        return self.rng.choice([0.0, 90.0, 180.0, 120.0, self.rng.uniform(-400.0, 400.0), 1e6 * self.rng.random()])

    def choice(self, *values: Any) -> Any:
        return self.rng.choice(values)


def body(rng: random.Random) -> Body:
    """A request to optimise that the schema accepts, of any size in any field."""
    draw = Draw(rng)
    machine = _scroll(draw) if rng.random() < 0.15 else _reciprocating(draw)
    machine |= {
        "speed_rpm": draw.size(-9, 9, (100, 3000)),
        "rotation": draw.choice("ccw", "cw"),
        "reference_plane_m": draw.choice(None, None, draw.place()),
        "webs": [web(draw, k) for k in range(rng.choice([0, 1, 1, 2, 2, 3, 4, 6, 9]))],
        "max_total_mass_kg": draw.choice(None, None, draw.size(-12, 15, (1, 50), zero=True)),
    }
    return {
        "machine": machine,
        "objective": _objective(draw),
        "accuracy": {"relative_gap": draw.size(-12, 0, (1e-7, 1e-6))},
    }


def _reciprocating(draw: Draw) -> Body:
    return {"kind": "reciprocating", "throws": [_throw(draw) for _ in range(draw.rng.randint(1, 4))]}


def _throw(draw: Draw) -> Body:
    radius = draw.size(-12, 9, (0.05, 0.2))
    rows = [
        {
            "axis_deg": draw.angle(),
            "offset_m": draw.choice(0.0, draw.place()),
            "reciprocating_mass_kg": draw.size(-15, 15, (1, 100), zero=True),
            "connecting_rod": draw.choice(
                None, {"length_m": None}, {"length_m": min(5 * radius, 1e9), "mass_kg": draw.size(-15, 15, (1, 20))}
            )
            if radius < 1e8
            else None,
        }
        for _ in range(draw.rng.randint(0, 3))
    ]
    return {
        "position_m": draw.place(),
        "crank_radius_m": radius,
        "crank_angle_deg": draw.angle(),
        "rotating_mass_kg": draw.size(-15, 15, (1, 50), zero=True),
        "rows": rows,
    }


def _scroll(draw: Draw) -> Body:
    ring = {"type": "oldham", "mass_kg": draw.size(-15, 15, (0.1, 1.0), zero=True), "axis_deg": draw.angle()}
    pins = {
        "type": "crank_pins",
        "count": draw.rng.randint(1, 12),
        "pin_circle_radius_m": draw.size(-6, 3, (0.03, 0.1)),
        "eccentric_mass_kg": draw.size(-15, 15, (0.01, 0.1), zero=True),
    }
    return {
        "kind": "scroll",
        "orbit_radius_m": draw.size(-12, 9, (0.003, 0.01)),
        "orbiting_mass_kg": draw.size(-15, 15, (0.5, 5.0), zero=True),
        "orbiting_position_m": draw.place(),
        "anti_rotation": draw.choice(ring, pins) | {"position_m": draw.place()},
    }


def web(draw: Draw, number: int) -> Body:
    half = draw.choice(1e-9, 1e-3, 30.0, 60.0, 89.999999, 90.0, draw.rng.uniform(1, 90))
    return {
        "name": str(number),
        "position_m": draw.place(),
        "counterweight_radius_m": draw.size(-12, 9, (0.1, 0.4)),
        "max_mass_kg": draw.choice(*NO_LIMIT, draw.size(-12, 15, (1, 60), zero=True), draw.size(-12, 15, (1, 60))),
        "sector": draw.choice(None, None, {"centre_deg": draw.angle(), "half_angle_deg": half}),
    }


#: what stands for no limit
NO_LIMIT: tuple[float | None, ...] = (None, 1e15, 1e30, 1e300)


def _objective(draw: Draw) -> Body:
    across = draw.choice(None, None, (draw.size(-12, 12, (0, 2)), 1.0), (1.0, 0.0), (0.0, draw.size(-12, 12, (0, 2))))
    weights = [draw.size(-30, 30, (0.1, 3.0), zero=True), draw.choice(None, draw.size(-30, 30, (0.1, 3.0), zero=True))]
    weights = draw.choice([1.0, None], weights, [0.0, 1.0], [1.0, 0.0])
    if weights == [0.0, 0.0]:
        weights = [0.0, 1.0]
    ceiling = [draw.choice(None, None, draw.size(-12, 30, (1e2, 1e5), zero=True)) for _ in range(2)]
    fields: Body = {
        "combine": draw.choice("sum", "sum", "max"),
        "force_weight": weights[0],
        "moment_weight": weights[1],
        "force_ceiling_N": ceiling[0],
        "moment_ceiling_Nm": ceiling[1],
        "least_mass": draw.rng.random() < 0.8,
    }
    if across is not None:
        fields["direction_weights"] = {"x": across[0], "y": across[1]}
    return fields
