"""Groups of webs and part numbers among choices for the whole turn: what trying every set comes to."""

from itertools import product
from typing import Any

import numpy as np
import pytest

from tests.night import part
from tests.optimize.choices import DEGREE, MASSES, Loads, certified, every_set, request_body, twin
from tests.optimize.whole_turn import ALONE

#: on the crank at 90 degrees, and on that at 180
FIRST, SECOND = ["1a", "1b"], ["2a", "2b"]
GOALS: list[dict[str, Any]] = [
    {"bearing_weight": 1, **ALONE},
    {"bearing_weight": 1, "force_weight": 0.5, "moment_weight": 2.0, "combine": "max"},
    {"bearing_weight": 1, "force_weight": 0.5, "moment_weight": 2.0,
     "priorities": [{"goal": "external", "allowance": 0.05}, {"goal": "bearings"}]},
]  # fmt: skip


def stepped(groups: list[dict[str, Any]], **more: Any) -> dict[str, Any]:
    """The twin without holes: steps of a quarter count from the own crank."""
    machine = twin(catalogue={"masses_kg": MASSES, "angle_step_deg": 90}, web_groups=groups, **more)
    machine["webs"] = [{k: v for k, v in web.items() if k != "hole_angles_deg"} for web in machine["webs"]]
    return machine


def grouped_sets(machine: dict[str, Any]) -> np.ndarray:
    """Unbalances (sets, webs) of all that can be chosen, by hand."""
    values = [0j, *(mass * np.exp(1j * np.deg2rad(angle)) for mass, angle in product(MASSES, np.arange(0, 360, 90)))]
    names = [web["name"] for web in machine["webs"]]
    groups = [(group["webs"], group.get("mirror", False)) for group in machine["web_groups"]]
    sets = np.array(list(product(values, repeat=len(groups))))
    u = np.zeros((len(sets), len(names)), complex)
    for number, (webs, mirror) in zip(sets.T, groups, strict=True):
        for place, name in enumerate(webs):
            own = -1.0 if name in SECOND else 1j
            u[:, names.index(name)] = 0.12 * own * (np.conj(number) if mirror and place % 2 else number)
    return u


def value(loads: Loads, u: np.ndarray, plane: float, goal: dict[str, Any], limit: float | None) -> np.ndarray:
    """What is to be small by statics, inf where a goal before it is above its limit."""
    bearings = loads.peak(u)
    if not goal["force_weight"]:
        return bearings
    force, moment = (weight * values for weight, values in zip((0.5, 2.0), loads.frame(u, plane), strict=True))
    if limit is None:
        return np.max([bearings, force, moment], axis=0)
    return np.where(force + moment <= limit * (1 + 1e-6), bearings, np.inf)


@pytest.mark.parametrize("goal", part(2, GOALS))
@pytest.mark.parametrize(
    "groups",
    [
        [{"webs": FIRST}, {"webs": SECOND}],
        [{"webs": ["1a", "2a"]}, {"webs": ["1b", "2b"]}],
        [{"webs": FIRST, "mirror": True}, {"webs": SECOND, "mirror": True}],
        [{"webs": [*FIRST, *SECOND]}],
    ],
)
def test_groups(groups: list[dict[str, Any]], goal: dict[str, Any]) -> None:
    """Independent: one choice of nine for each group, all sets by statics."""
    named = [{"name": str(n), **group} for n, group in enumerate(groups)]
    machine = stepped(named)
    optimum, proof = certified(request_body(machine, **goal))
    limit = proof.goals[0].limit if "priorities" in goal else None
    least = float(np.min(value(Loads(machine), grouped_sets(machine), optimum.reference_plane_m, goal, limit)))
    assert least * (1 - 1e-9) <= proof.objective <= least * (1 + DEGREE)
    assert proof.lower_bound is not None
    assert proof.lower_bound == pytest.approx(proof.objective, rel=1e-5)
    fitted = {counterweight.web: counterweight for counterweight in optimum.counterweights}
    for group in named:
        assert len({fitted[name].mass_kg for name in group["webs"]}) == 1
    assert proof.continuous_lower_bound is not None
    assert proof.continuous_lower_bound <= proof.lower_bound


@pytest.mark.parametrize("goal", GOALS)
def test_part_numbers(goal: dict[str, Any]) -> None:
    """Independent: of all 2,401 sets those of one mass alone."""
    machine = twin(catalogue={"masses_kg": MASSES, "max_part_numbers": 1})
    optimum, proof = certified(request_body(machine, **goal))
    assert len({counterweight.mass_kg for counterweight in optimum.counterweights if counterweight.mass_kg > 0}) == 1
    sets, u = every_set(machine)
    alike = np.array([len({mass for mass, _ in choice if mass > 0}) <= 1 for choice in sets])
    limit = proof.goals[0].limit if "priorities" in goal else None
    values = value(Loads(machine), u, optimum.reference_plane_m, goal, limit)
    least = float(np.min(values[alike]))
    assert least * (1 - 1e-9) <= proof.objective <= least * (1 + DEGREE)
    assert proof.lower_bound == pytest.approx(proof.objective, rel=1e-5)
    if "priorities" not in goal:
        # two masses are of use
        assert float(np.min(values)) < 0.999 * least


def test_groups_of_so_many_counterweights() -> None:
    """Independent: a pair or none, for a limit of three counterweights."""
    named = [{"name": "one", "webs": FIRST}, {"name": "other", "webs": SECOND}]
    machine = stepped(named, max_counterweights=3)
    optimum, proof = certified(request_body(machine, bearing_weight=1, **ALONE))
    u = grouped_sets(machine)
    few = u[np.sum(u != 0, axis=-1) <= 3]
    least = float(np.min(Loads(machine).peak(few)))
    assert least * (1 - 1e-9) <= proof.objective <= least * (1 + DEGREE)
    assert sum(counterweight.mass_kg > 0 for counterweight in optimum.counterweights) <= 3
