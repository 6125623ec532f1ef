"""Ample choices: no worse and hardly heavier than a plain local search by hand from the rounded optimum."""

from typing import Any

import numpy as np
import pytest

from optimizer.choices.discrete import few_slots, sums
from optimizer.choices.discrete.lightest import Lightest, lighter
from schemas.answer.answers import OptimizeAnswer
from tests.benchmarks.discrete import choice
from tests.hard.cases.case import Body
from tests.night import part
from tests.verification.checking import optimized

#: the four throws of opposed pistons of which an engineer knows what a foundry would cast
POSITIONS, CRANKS, AXES, MASSES = (-1.35, -0.45, 0.45, 1.35), (0, 180, 90, 270), (0, 180, 0, 180), (420, 395, 410, 388)
RADIUS, MOST, SPEED = 0.26, 90.0, 600.0
WEIGHT = 1.0 / 3.0


def machine(seed: int | None = None) -> Body:
    """That one, or two to four throws by chance, with a web on either side of each."""
    chance = np.random.default_rng([seed or 0, 30])
    throws = len(CRANKS) if seed is None else int(chance.integers(2, 5))
    cranks = CRANKS if seed is None else chance.choice([0, 60, 90, 120, 180, 240, 270], throws).tolist()
    masses = MASSES if seed is None else chance.uniform(100.0, 450.0, throws).round().tolist()
    places = POSITIONS if seed is None else [0.9 * k for k in range(throws)]
    return {
        "kind": "reciprocating",
        "speed_rpm": SPEED,
        "throws": [
            {
                "position_m": z, "crank_radius_m": 0.1, "crank_angle_deg": crank, "rotating_mass_kg": 60,
                "rows": [{"axis_deg": AXES[k], "reciprocating_mass_kg": mass}],
            }
            for k, (z, crank, mass) in enumerate(zip(places, cranks, masses, strict=True))
        ],
        "webs": [
            {
                "name": f"{k}{side}", "position_m": z + off, "counterweight_radius_m": RADIUS, "max_mass_kg": MOST,
                "sector": {"centre_deg": (crank + 180) % 360, "half_angle_deg": 60},
            }
            for k, (z, crank) in enumerate(zip(places, cranks, strict=True))
            for side, off in (("a", -0.15), ("b", 0.15))
        ],
    }  # fmt: skip


def answer(body: Body, **catalogue: Any) -> OptimizeAnswer:
    request = {**body, "catalogue": catalogue} if catalogue else body
    return optimized({"machine": request, "objective": {"moment_weight": WEIGHT}})


def objective_of(body: Body, u: np.ndarray) -> np.ndarray:
    """Force and moment of sets (..., webs) by hand: co-rotating vectors change, counter-rotating ones stay."""
    square = (SPEED * np.pi / 30) ** 2
    co = back = np.zeros(2, complex)
    for throw in body["throws"]:
        crank, (row,) = np.exp(1j * np.radians(throw["crank_angle_deg"])), throw["rows"]
        axis, arm = np.exp(1j * np.radians(row["axis_deg"])), np.array([1.0, throw["position_m"]])
        mass = row["reciprocating_mass_kg"]
        co = co + arm * 0.1 * crank * (throw["rotating_mass_kg"] + 0.5 * mass)
        back = back + arm * 0.1 * 0.5 * mass * axis**2 * np.conj(crank)
    place = np.array([web["position_m"] for web in body["webs"]])
    force, moment = np.abs(co[0] + np.sum(u, axis=-1)), np.abs(co[1] + u @ place)
    actual_square: np.ndarray = square * (force + np.abs(back[0]) + WEIGHT * (moment + np.abs(back[1])))
    return actual_square


def by_hand(body: Body, masses: np.ndarray, step_deg: float) -> float:
    """Independent: the rounded optimum, one web at a time over all its options until none is better."""
    options = []
    for web in body["webs"]:
        # steps count from the own crank
        turns = (web["sector"]["centre_deg"] - 180.0 + np.arange(0.0, 360.0, step_deg)) % 360.0
        off = np.abs((turns - web["sector"]["centre_deg"] + 180.0) % 360.0 - 180.0)
        inside = turns[off <= 60.0 + 1e-9]
        options.append(np.r_[0.0, (RADIUS * masses[:, None] * np.exp(1j * np.radians(inside))).ravel()])
    free = answer(body)
    start = np.array([complex(counterweight.x_kg_m, counterweight.y_kg_m) for counterweight in free.counterweights])
    u = np.array([some[np.argmin(np.abs(some - unbalance))] for some, unbalance in zip(options, start, strict=True)])
    best, left = float(objective_of(body, u)), len(options)
    while left:
        for k, some in enumerate(options):
            sets = np.repeat(u[None], some.size, axis=0)
            sets[:, k] = some
            values = objective_of(body, sets)
            left -= 1
            if np.min(values) < best - 1e-9:
                best, u, left = float(np.min(values)), sets[np.argmin(values)], len(options)
            if not left:
                break
    return best


def test_by_hand_and_by_answer_the_objective_is_the_same() -> None:
    """Independent: what the answer is judged by here."""
    free = answer(machine())
    u = np.array([complex(counterweight.x_kg_m, counterweight.y_kg_m) for counterweight in free.counterweights])
    assert free.certificate is not None
    assert objective_of(machine(), u) == pytest.approx(free.certificate.objective, rel=1e-9)


def test_no_slots_are_searched_twice_for_what_is_lighter_than_a_set(monkeypatch: pytest.MonkeyPatch) -> None:
    searched: list[tuple[object, ...]] = []

    def counted(*arguments: Any) -> Lightest:
        _, _, slots, level, below_kg, *_ = arguments
        searched.append((*(options.tobytes() for options in slots), level, below_kg))
        return lighter(*arguments)

    monkeypatch.setattr(few_slots, "lighter", counted)
    assert optimized(choice(webs=4, holes=12, masses=16)).status == "optimal"
    assert searched
    assert len({*searched}) == len(searched)


def test_no_sums_are_listed_that_are_given_up_in_the_end(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of two webs with 2,251 options there are five millions: a limit of 30 s is no reason to make them."""
    listed: list[int] = []
    merged = sums._distinct

    def counted(several: sums.Sums) -> sums.Sums:
        listed.append(several.code.size)
        return merged(several)

    monkeypatch.setattr(sums, "_distinct", counted)
    catalogue = {"mass_step_kg": 0.5, "angle_step_deg": 5}
    request = {"machine": machine() | {"catalogue": catalogue}, "objective": {"moment_weight": WEIGHT}}
    short, long = (optimized({**request, "accuracy": {"time_limit_s": limit_s}}) for limit_s in (5, 30))
    assert short.counterweights == long.counterweights
    assert max(listed) < 1_000_000


def test_what_a_foundry_would_cast() -> None:
    """Regression: eight castings of 256.5 kg were shown, and an objective of 40,882 N above this by 0.7 %."""
    optimum = answer(machine(), mass_step_kg=0.5, angle_step_deg=5)
    assert optimum.status == "optimal"
    assert optimum.certificate is not None
    # 40,549.4 N is proven of any masses, of which the lightest weigh 85.75 kg
    assert optimum.certificate.objective <= 40_620.0
    assert optimum.total_mass_kg is not None
    assert optimum.total_mass_kg <= 100.0
    assert sum(counterweight.mass_kg > 0 for counterweight in optimum.counterweights) <= 5


@pytest.mark.parametrize(
    ("mass_step_kg", "angle_step_deg", "heaviest_kg"),
    [(1.0, 10.0, 112.0), pytest.param(0.5, 5.0, 96.0, marks=pytest.mark.nightly)],
)
def test_two_sizes(mass_step_kg: float, angle_step_deg: float, heaviest_kg: float) -> None:
    """Regression: 144 and 107.5 kg were shown, where by hand 43 and 2 kg come to 96 kg within the asked gap."""
    optimum = answer(machine(), mass_step_kg=mass_step_kg, angle_step_deg=angle_step_deg, max_part_numbers=2)
    assert optimum.status == "optimal"
    assert len({counterweight.mass_kg for counterweight in optimum.counterweights if counterweight.mass_kg > 0}) <= 2
    assert optimum.total_mass_kg is not None
    assert optimum.total_mass_kg <= heaviest_kg
    assert optimum.certificate is not None
    # 1e-3 of the reference value above what is proven of any masses
    assert optimum.certificate.objective <= 40_549.5 + 91.2


@pytest.mark.parametrize("seed", part(2, [2, 4, *(pytest.param(n, marks=pytest.mark.nightly) for n in range(5, 40))]))
@pytest.mark.parametrize("catalogue", ["steps", "sizes"])
def test_no_worse_than_by_hand(seed: int, catalogue: str) -> None:
    body = machine(seed)
    if catalogue == "steps":
        masses, optimum = 0.5 * np.arange(1, 181), answer(body, mass_step_kg=0.5, angle_step_deg=5)
        step_deg = 5.0
    else:
        masses, step_deg = np.array([5.0, 10.0, 20.0, 35.0, 50.0, 70.0]), 15.0
        optimum = answer(body, masses_kg=masses.tolist(), angle_step_deg=step_deg)
    assert optimum.certificate is not None
    gap = optimum.certificate.objective - by_hand(body, masses, step_deg)
    # or within the asked gap of what is proven of all
    assert gap <= 1e-9 * optimum.certificate.yardstick or optimum.status == "optimal"
