"""Groups of webs that choose from what there is: one choice for all webs of a group, mirrored or not."""

from itertools import product
from typing import Any

import numpy as np
import pytest
from scipy.optimize import minimize

from optimizer.errors import OutOfRange
from optimizer.studies.pareto.pareto import pareto
from schemas.front.pareto import ParetoRequest
from tests.night import part
from tests.optimize.test_mirrored_groups import PAIRS, alike, grouped
from tests.optimize.test_web_groups import ANGLES, NAMES, RADIUS, objective
from tests.verification.checking import optimized, sound_answer

HALVES = [["0a", "1b", "2a"], ["0b", "1a", "2b"]]
MASSES = [1.5, 3.0, 4.5, 6.0, 9.0]


def request_body(
    groups: list[list[str]], mirror: bool, masses: list[float], step: float, **more: Any
) -> dict[str, Any]:
    body = grouped(groups, mirror, **more)
    body["machine"]["catalogue"] = {"masses_kg": masses, "angle_step_deg": step}
    body["accuracy"] = {"relative_gap": 1e-9, "time_limit_s": 30}
    return body


def every_set(body: dict[str, Any]) -> tuple[np.ndarray, np.ndarray]:
    """Masses and unbalances (sets, 6) of all that can be chosen, by hand."""
    machine = body["machine"]
    groups = [group["webs"] for group in machine["web_groups"]]
    groups += [[name] for name in NAMES if not any(name in group for group in groups)]
    steps = np.arange(0.0, 360.0, machine["catalogue"]["angle_step_deg"])
    values = [0j, *(m * np.exp(1j * np.radians(a)) for m in machine["catalogue"]["masses_kg"] for a in steps)]
    sets = np.array(list(product(values, repeat=len(groups))))
    on_webs = np.zeros((len(sets), 6), complex)
    for g, group in enumerate(groups):
        mirror = g < len(machine["web_groups"]) and machine["web_groups"][g].get("mirror", False)
        for n, name in enumerate(group):
            on_webs[:, NAMES.index(name)] = np.conj(sets[:, g]) if mirror and n % 2 else sets[:, g]
    return np.abs(on_webs), on_webs * np.exp(1j * np.radians(np.repeat(ANGLES, 2))) * RADIUS


@pytest.mark.parametrize("mirror", [False, True])
@pytest.mark.parametrize(
    ("groups", "masses", "step", "limits"),
    part(
        2,
        [
            ([NAMES], MASSES, 15.0, {}),
            (PAIRS, [3.0, 6.0, 9.0], 45.0, {}),
            (PAIRS, [3.0, 6.0, 9.0], 45.0, {"max_total_mass_kg": 24.0}),
            (PAIRS, [3.0, 6.0, 9.0], 45.0, {"max_counterweights": 4}),
            (PAIRS, [3.0, 6.0, 9.0], 45.0, {"max_part_numbers": 1}),
            ([PAIRS[0], PAIRS[2]], [4.0], 60.0, {"max_counterweights": 3}),
        ],
        rows=True,
    ),
)
def test_no_set_by_hand_is_better(
    mirror: bool, groups: list[list[str]], masses: list[float], step: float, limits: dict[str, Any]
) -> None:
    """Independent: all sets, up to 15,625, by sums over throws and webs."""
    body = request_body(groups, mirror, masses, step)
    catalogue = body["machine"]["catalogue"]
    for name, value in limits.items():
        (catalogue if name == "max_part_numbers" else body["machine"])[name] = value
    answer = sound_answer(body)
    alike(answer, groups, mirror)
    mass, u = every_set(body)
    mask = np.sum(mass, axis=-1) <= limits.get("max_total_mass_kg", np.inf) * (1 + 1e-12)
    mask &= np.sum(mass > 0, axis=-1) <= limits.get("max_counterweights", 6)
    different = [len(set(np.round(row[row > 0], 9))) for row in mass]
    mask &= np.array(different) <= limits.get("max_part_numbers", 6)
    best = float(np.min(objective(body, u[mask])))
    assert answer.status == "optimal"
    assert answer.certificate is not None
    assert answer.certificate.objective == pytest.approx(best, rel=1e-9)
    assert answer.certificate.lower_bound == pytest.approx(best, rel=1e-9)


@pytest.mark.parametrize("mirror", part(2, [False, True]))
@pytest.mark.parametrize("ceiling", part(2, [200.0, None]))
def test_a_tree_finds_what_trying_all_sets_does(
    mirror: bool, ceiling: float | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Independent: 117,649 sets, by sums over throws and webs; halves are given no room, and leaves of the tree few."""
    monkeypatch.setattr("optimizer.choices.discrete.search._SUMS", 1)
    monkeypatch.setattr("optimizer.choices.discrete.branch._SETS", 20)
    body = request_body(PAIRS, mirror, [2.0, 5.0, 9.0], 22.5, objective={"force_ceiling_N": ceiling})
    answer = sound_answer(body)
    assert answer.certificate is not None
    assert answer.certificate.method == "branch and bound"
    alike(answer, PAIRS, mirror)
    _, u = every_set(body)
    mask = objective(body, u, moment_share=0.0) <= (ceiling or np.inf)
    best = float(np.min(objective(body, u[mask])))
    assert answer.status == "optimal"
    assert answer.certificate.objective == pytest.approx(best, rel=1e-9)
    assert answer.certificate.lower_bound == pytest.approx(best, rel=1e-9)


@pytest.mark.parametrize("mirror", [False, True])
def test_counts_are_of_webs(mirror: bool) -> None:
    """Independent: of every number of webs the best by hand, where a group takes two or none."""
    body = request_body(PAIRS, mirror, [3.0, 6.0, 9.0], 45.0) | {"counts": {"of": "weights", "least": "objective"}}
    (front,) = pareto(ParetoRequest.model_validate(body)).counts
    mass, u = every_set(body)
    objectives, fitted = objective(body, u), np.sum(mass > 0, axis=-1)
    for point in front.points:
        assert point.weights is not None
        assert point.weights % 2 == 0
        assert point.weights <= point.at_most
        assert point.value == pytest.approx(float(np.min(objectives[fitted <= point.at_most])), rel=1e-9)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"catalogue_masses_kg": [1.0, 2.0]}, "its catalogue_masses_kg must equal that of 0a"),
        ({"min_fitted_mass_kg": 2.0}, "its min_fitted_mass_kg must equal that of 0a"),
        ({"hole_angles_deg": [10.0, 20.0]}, "its hole_angles_deg, counted from the own crank, must equal that of 0a"),
    ],
)
def test_unlike_choices_are_refused(change: dict[str, Any], words: str) -> None:
    body = request_body([["0a", "0b"]], False, MASSES, 15.0)
    body["machine"]["webs"][1] |= change
    with pytest.raises(OutOfRange) as refusal:
        optimized(body)
    assert refusal.value.problems[0].path == ("machine", "web_groups", 0, "webs", 1)
    assert words in refusal.value.problems[0].message


@pytest.mark.parametrize("mirror", [False, True])
def test_holes_count_from_the_own_crank(mirror: bool) -> None:
    body = request_body([["0a", "1a"]], mirror, [3.0, 6.0], 90.0)
    webs, sign = body["machine"]["webs"], -1 if mirror else 1
    webs[0]["hole_angles_deg"] = [170.0, 200.0, 0.0]
    webs[2]["hole_angles_deg"] = [120.0, 120.0 + sign * 200.0, 480.0 + sign * 170.0]
    answer = optimized(body)
    alike(answer, [["0a", "1a"]], mirror)
    assert answer.counterweights[0].angle_deg in (170.0, 200.0)


@pytest.mark.parametrize("mirror", part(2, [False, True]))
@pytest.mark.parametrize(("groups", "least"), part(2, [(HALVES, 7.0), ([NAMES], 8.5)], rows=True))
def test_no_least_mass_by_hand_is_better(mirror: bool, groups: list[list[str]], least: float) -> None:
    """Independent: every choice of groups that are fitted, each searched over size and angle of its castings."""
    body = grouped(groups, mirror, max_mass_kg=12.0)
    for web in body["machine"]["webs"]:
        web["min_fitted_mass_kg"] = least
    body["accuracy"] = {"relative_gap": 1e-3, "time_limit_s": 30}
    answer = sound_answer(body)
    alike(answer, groups, mirror)
    assert all(counterweight.mass_kg == 0 or counterweight.mass_kg >= least for counterweight in answer.counterweights)
    turn = np.exp(1j * np.radians(np.repeat(ANGLES, 2))) * RADIUS
    owner = np.array([next(g for g, group in enumerate(groups) if name in group) for name in NAMES])
    mirrors = np.array([mirror and groups[g].index(name) % 2 == 1 for g, name in zip(owner, NAMES, strict=True)])

    def value(p: np.ndarray, fitted: tuple[bool, ...]) -> Any:
        """Of sizes from 0 to 1 between the limits and angles (..., 2 groups)."""
        size, angle = np.clip(p[..., : len(groups)], 0.0, 1.0), p[..., len(groups) :]
        w = np.where(fitted, (least + (12.0 - least) * size) * np.exp(1j * angle), 0.0)[..., owner]
        return objective(body, np.where(mirrors, np.conj(w), w) * turn)

    chance, values = np.random.default_rng(17), []
    for fitted in product([False, True], repeat=len(groups)):
        tried = chance.random((20_000, 2 * len(groups))) * ([1.0] * len(groups) + [2 * np.pi] * len(groups))
        best = tried[np.argsort(value(tried, fitted))[:3]]
        values += [
            minimize(value, start, (fitted,), method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-9}).fun
            for start in best
        ]
    assert answer.status == "optimal"
    assert answer.certificate is not None
    assert answer.certificate.objective <= min(values) + 1e-3 * answer.certificate.yardstick
    assert answer.certificate.lower_bound is not None
    assert answer.certificate.lower_bound <= min(values) * (1 + 1e-9)
