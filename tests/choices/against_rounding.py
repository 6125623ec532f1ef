"""Choices from steps, two sizes, holes and catalogues beside rounding by hand with local search, on random machines.

``python -m tests.choices.against_rounding [--count 100] [--first 0] [--limit 10]`` prints every answer as it comes, and
how many are worse by more than the asked gap, with gaps, masses and times; it ends with 1 where any is. Heavier is an
answer where by hand a lighter set was come upon that is within the asked gap of the bound as well. By hand is a plain
search: from the rounded continuous optimum one web at a time over all its options, then two, with a price on mass and
without.
"""

import argparse
import sys
import time
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
from numba import njit

from optimizer.optimize import optimize
from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import OptimizeRequest

MODES = ("steps", "two sizes", "holes", "catalogue")
#: N a kilogram; options of one web that are tried with all of another
_PRICES, _PAIRED = (0.0, 1.0), 60
#: gap that is asked for where nothing is said
_GAP = 1e-3
#: s for an answer
_LIMIT_S = 10.0

Body = dict[str, Any]


class Compared(NamedTuple):
    """One machine both ways."""

    mode: str
    throws: int
    value: float
    by_hand: float
    mass: float
    mass_by_hand: float
    lightest_by_hand: float  # kg, of the sets within the asked gap of the bound; inf where there are none
    yardstick: float
    gap: float
    seconds: float

    def __str__(self) -> str:
        return (
            f"{self.mode:<10} {self.throws} throws: {self.value:.0f}, by hand {self.by_hand:.0f} N;"
            f" {self.mass:.1f}, by hand {self.mass_by_hand:.1f} kg, as good {self.lightest_by_hand:.1f} kg;"
            f" gap {self.gap:.1e}; CPU {self.seconds:.2f} s"
        )

    @property
    def worse(self) -> bool:
        return self.value > self.by_hand + _GAP * self.yardstick * (1 + 1e-6)

    @property
    def heavier(self) -> bool:
        return self.mass > self.lightest_by_hand * (1 + 1e-9)


def machine(rng: np.random.Generator) -> Body:
    """Two to six throws of one row each, with a web on either side."""
    count, pitch = int(rng.integers(2, 7)), 0.9
    throws, webs = [], []
    for n in range(count):
        z, crank = (n - 0.5 * (count - 1)) * pitch, float(rng.choice(np.arange(0, 360, 30)))
        row = {"axis_deg": float(rng.choice([0, 180, 90])), "reciprocating_mass_kg": float(rng.uniform(150, 450))}
        turning = float(rng.uniform(20, 90))
        throws.append(
            {
                "position_m": z,
                "crank_radius_m": 0.1,
                "crank_angle_deg": crank,
                "rotating_mass_kg": turning,
                "rows": [row],
            }
        )
        for side, off in (("a", -0.15), ("b", 0.15)):
            webs.append(
                {
                    "name": f"{n}{side}", "position_m": z + off, "counterweight_radius_m": 0.26, "max_mass_kg": 90,
                    "throw": n, "sector": {"centre_deg": (crank + 180) % 360, "half_angle_deg": 60},
                }
            )  # fmt: skip
    return {"kind": "reciprocating", "speed_rpm": 600, "throws": throws, "webs": webs}


def with_choices(free: Body, mode: str, rng: np.random.Generator) -> Body:
    design: Body = {**free, "webs": [dict(web) for web in free["webs"]]}
    if mode in ("steps", "two sizes"):
        design["catalogue"] = {"mass_step_kg": 0.5, "angle_step_deg": 5}
    elif mode == "holes":
        design["catalogue"] = {"mass_step_kg": 1.0}
        for web in design["webs"]:
            web["hole_angles_deg"] = [web["sector"]["centre_deg"] + off for off in (-45, -15, 15, 45)]
    else:
        masses = np.unique(np.round(rng.uniform(2, 90, 12), 1)).tolist()
        design["catalogue"] = {"masses_kg": masses, "angle_step_deg": 15}
    if mode == "two sizes":
        design["catalogue"]["max_part_numbers"] = 2
    return design


@njit  # type: ignore[untyped-decorator]
def _best_pair(
    first: np.ndarray,
    second: np.ndarray,
    values: np.ndarray,
    array: np.ndarray,
    weight: np.ndarray,
    still: np.ndarray,
) -> tuple[float, int, int]:
    """The smallest cost of one of (a, 2) with one of (b, 2), and which they are."""
    best, count, number = np.inf, 0, 0
    for i in range(len(first)):
        for j in range(len(second)):
            cost = values[i] + array[j]
            for k in range(2):
                z = first[i, k] + second[j, k]
                cost += weight[k] * (np.sqrt(z.real * z.real + z.imag * z.imag) + still[k])
            if cost < best:
                best, count, number = cost, i, j
    return best, count, number


class Plain:
    """Rounding by hand with local search; it knows nothing of the service but the continuous optimum."""

    def __init__(self, body: Body, free: OptimizeAnswer) -> None:
        self.body, self.plane = body, free.reference_plane_m
        #: objective and mass of every set that no move makes better
        self.ends: list[tuple[float, float]] = []
        square = (body["speed_rpm"] * np.pi / 30) ** 2
        z, co, counter = [], [], []
        for throw in body["throws"]:
            phase = np.exp(1j * np.radians(throw["crank_angle_deg"])) * throw["crank_radius_m"]
            (row,) = throw["rows"]
            axis, half = np.exp(2j * np.radians(row["axis_deg"])), 0.5 * row["reciprocating_mass_kg"]
            z.append(throw["position_m"] - self.plane)
            co.append((throw["rotating_mass_kg"] + half) * phase)
            counter.append(half * axis * np.conj(phase))
        levers = np.array(z)
        places = [w["position_m"] for w in body["webs"]] + [t["position_m"] for t in body["throws"]]
        weight = 1.0 / (max(places) - min(places))
        self.weight = np.array([square, square * weight])
        self.start = np.array([np.sum(co), np.sum(levers * co)])
        self.still = np.abs([np.sum(counter), np.sum(levers * counter)])
        self.arms = np.array([[1.0, web["position_m"] - self.plane] for web in body["webs"]])
        self.options = [self._options(k) for k in range(len(body["webs"]))]
        self.free = np.array(
            [
                counterweight.mass_kg * np.exp(1j * np.radians(counterweight.angle_deg))
                for counterweight in free.counterweights
            ]
        )

    def _options(self, k: int) -> np.ndarray:
        """Masses times directions of a web, nothing first."""
        web, catalogue = self.body["webs"][k], self.body["catalogue"]
        step = catalogue.get("mass_step_kg")
        masses = np.arange(step, 90 + step / 2, step) if step else np.array(catalogue["masses_kg"])
        if "hole_angles_deg" in web:
            angles = np.array(web["hole_angles_deg"], float)
        else:
            crank = self.body["throws"][web["throw"]]["crank_angle_deg"]
            angles = crank + np.arange(0, 360, catalogue["angle_step_deg"])
            off = (angles - web["sector"]["centre_deg"] + 180) % 360 - 180
            angles = angles[np.abs(off) <= web["sector"]["half_angle_deg"] + 1e-9]
        return np.append(0, np.multiply.outer(masses[masses <= 90], np.exp(1j * np.radians(angles))).ravel())

    def values(self, co: np.ndarray) -> np.ndarray:
        """Objectives of co-rotating parts (..., 2)."""
        total: np.ndarray = np.sum(self.weight * (np.abs(co) + self.still), axis=-1)
        return total

    def best(self, options: list[np.ndarray]) -> tuple[float, float]:
        """Objective and mass of the best set by moves of one and of two webs."""
        minimum = (np.inf, 0.0)
        for price in _PRICES:
            taken = [some[np.argmin(np.abs(some - at))] for some, at in zip(options, self.free, strict=True)]
            minimum = min(minimum, self._moved(taken, options, price))
        return minimum

    def _moved(self, taken: list[complex], options: list[np.ndarray], price: float) -> tuple[float, float]:
        rng, effects = (
            np.random.default_rng(1),
            [0.26 * some[:, None] * arm for some, arm in zip(options, self.arms, strict=True)],
        )
        mass = [np.abs(some) for some in options]
        at = [int(np.argmin(np.abs(some - phasor))) for some, phasor in zip(options, taken, strict=True)]
        webs, moved, best = len(at), True, np.inf

        def without(*which: int) -> tuple[np.ndarray, float]:
            rest = [k for k in range(webs) if k not in which]
            co = self.start + sum((effects[k][at[k]] for k in rest), np.zeros(2))
            return co, float(sum(mass[k][at[k]] for k in rest))

        while moved:
            moved = False
            for k in range(webs):
                co, weight = without(k)
                cost = self.values(co + effects[k]) + price * (weight + mass[k])
                if cost.min() < best * (1 - 1e-12):
                    best, at[k], moved = float(cost.min()), int(np.argmin(cost)), True
            if moved:
                continue
            for i in range(webs):
                for j in range(webs):
                    if i == j:
                        continue
                    co, weight = without(i, j)
                    some = rng.choice(len(options[i]), min(_PAIRED, len(options[i])), replace=False)
                    carried = price * (weight + mass[i][some]), price * mass[j]
                    cost, a, b = _best_pair(co + effects[i][some], effects[j], *carried, self.weight, self.still)
                    if cost < best * (1 - 1e-12):
                        best, at[i], at[j], moved = cost, int(some[a]), b, True
        co, weight = without()
        self.ends.append((float(self.values(co)), weight))
        return self.ends[-1]

    def of_two_sizes(self) -> tuple[float, float]:
        """Sizes near the masses of the optimum, moved by a step at a time."""
        used = np.round(np.abs(self.free[np.abs(self.free) > 0.5]) * 2) / 2
        first = (float(used.max()), float(used.min())) if used.size else (10.0, 1.0)
        sizes = first if first[0] != first[1] else (first[0], 2.0)

        def smallest_of(pair: tuple[float, float]) -> tuple[float, float]:
            some = [
                o[(np.abs(o) == 0) | np.isclose(np.abs(o), pair[0]) | np.isclose(np.abs(o), pair[1])]
                for o in self.options
            ]
            return self.best(some)

        best, moved = smallest_of(sizes), True
        for _ in range(6):
            if not moved:
                break
            moved = False
            for da, db in ((0.5, 0), (-0.5, 0), (0, 0.5), (0, -0.5)):
                pair = (min(sizes[0] + da, 90.0), max(sizes[1] + db, 0.5))
                other = smallest_of(pair)
                if other[0] < best[0] * (1 - 1e-12):
                    best, sizes, moved = other, pair, True
        return best


def compared(seed: int, limit_s: float = _LIMIT_S, modes: Sequence[str] = MODES) -> Iterator[Compared]:
    """One machine in some modes, each with so many seconds."""
    rng = np.random.default_rng(seed)
    free = machine(rng)
    optimum = optimize(OptimizeRequest.model_validate({"machine": free}))
    for mode in MODES:
        body = with_choices(free, mode, rng)
        if mode not in modes:
            continue
        start = time.process_time()
        request = {"machine": body, "accuracy": {"time_limit_s": limit_s}}
        answer = optimize(OptimizeRequest.model_validate(request))
        seconds = time.process_time() - start
        assert answer.certificate is not None
        plain = Plain(body, optimum)
        objective_by_hand, mass = plain.of_two_sizes() if mode == "two sizes" else plain.best(plain.options)
        proof = answer.certificate
        limit = (proof.lower_bound or 0.0) + _GAP * proof.yardstick
        as_good = min((kg for objective, kg in plain.ends if objective <= limit), default=np.inf)
        yield Compared(
            mode, len(free["throws"]), proof.objective, objective_by_hand, answer.total_mass_kg or 0.0, mass, as_good,
            proof.yardstick, np.nan if proof.relative_gap is None else proof.relative_gap, seconds,
        )  # fmt: skip


def main(first: int, count: int, limit_s: float, modes: Sequence[str]) -> int:
    every = []
    for seed in range(first, first + count):
        for comparison in compared(seed, limit_s, modes):
            marks = ", worse" * comparison.worse + ", heavier" * comparison.heavier
            print(f"{seed:>4} {comparison}{marks}", flush=True)
            every.append(comparison)
    for mode in modes:
        some = [comparison for comparison in every if comparison.mode == mode]
        gaps, seconds = (
            np.array([comparison.gap for comparison in some]),
            np.array([comparison.seconds for comparison in some]),
        )
        heavier = np.array([comparison.mass - comparison.mass_by_hand for comparison in some])
        worse = [comparison for comparison in some if comparison.worse]
        print(
            f"{mode:<10} machines {len(some):>4}, worse {len(worse):>3}, better"
            f" {sum(comparison.value < comparison.by_hand - _GAP * comparison.yardstick for comparison in some):>3};"
            f" gap median {np.nanmedian(gaps):.1e}, largest {np.nanmax(gaps):.1e};"
            f" CPU median {np.median(seconds):.2f} s, largest {np.max(seconds):.1f};"
            f" mass against by hand, median {np.median(heavier):+.1f} kg, most {np.max(heavier):+.1f};"
            f" heavier than as good by hand {sum(comparison.heavier for comparison in some)}"
        )
    return int(any(comparison.worse for comparison in every))


if __name__ == "__main__":
    reader = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    reader.add_argument("--count", type=int, default=100, help="machines, each in four modes")
    reader.add_argument("--first", type=int, default=0, help="seed of the first of them")
    reader.add_argument("--limit", type=float, default=_LIMIT_S, help="seconds for each answer")
    reader.add_argument("--modes", nargs="+", choices=MODES, default=MODES, help="what is chosen from")
    arguments = reader.parse_args()
    sys.exit(main(arguments.first, arguments.count, arguments.limit, arguments.modes))
