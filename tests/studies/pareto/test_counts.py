"""Numbers of counterweights and of part numbers against the least objective and mass; and a million sets by hand."""

from typing import Any, NamedTuple

import numpy as np
import pytest
from pydantic import ValidationError

from optimizer.errors import MissingInput
from optimizer.studies.pareto.pareto import pareto
from schemas.front.counts import CountFront
from schemas.front.pareto import ParetoRequest
from tests.night import every
from tests.optimize import choices
from tests.verification.checking import optimized

PLANES, RADIUS, MASSES = (-0.4, -0.2, 0.2, 0.4), 0.12, (3.0, 7.5, 16.0)
SPEED = 500.0


def body(step_deg: float, masses: tuple[float, ...] = MASSES, **more: Any) -> dict[str, Any]:
    """Two cranks at right angles, a web on either side of each."""
    throws = [
        {"position_m": z, "crank_radius_m": 0.1, "crank_angle_deg": angle, "rotating_mass_kg": 9.0,
         "rows": [{"axis_deg": 0, "reciprocating_mass_kg": mass}]}
        for z, angle, mass in ((-0.3, 0.0, 21.0), (0.3, 90.0, 20.0))
    ]  # fmt: skip
    webs = [
        {"name": name, "position_m": z, "counterweight_radius_m": RADIUS, "max_mass_kg": 60}
        for name, z in zip("abcd", PLANES, strict=True)
    ]
    catalogue = {"masses_kg": list(masses), "angle_step_deg": step_deg}
    machine = {"kind": "reciprocating", "speed_rpm": SPEED, "throws": throws, "webs": webs, "catalogue": catalogue}
    return {"machine": machine, "accuracy": {"time_limit_s": 30, "relative_gap": 1e-9}, **more}


class Sets(NamedTuple):
    """All sets of a catalogue, independent: phasors of the first order by hand."""

    force: np.ndarray  # N
    moment: np.ndarray  # N m
    mass: np.ndarray  # kg
    weights: np.ndarray
    part_numbers: np.ndarray

    @property
    def objective(self) -> np.ndarray:
        force: np.ndarray = self.force + self.moment / (PLANES[-1] - PLANES[0])
        return force


def every_set(step_deg: float, masses: tuple[float, ...] = MASSES) -> Sets:
    square = (SPEED * np.pi / 30) ** 2
    force = couple = back = back_couple = 0j
    for z, angle, mass in ((-0.3, 0.0, 21.0), (0.3, 90.0, 20.0)):
        crank = np.exp(1j * np.radians(angle))
        force += 0.1 * crank * (9.0 + 0.5 * mass)
        couple += z * 0.1 * crank * (9.0 + 0.5 * mass)
        back += 0.1 * 0.5 * mass * np.conj(crank)
        back_couple += z * 0.1 * 0.5 * mass * np.conj(crank)
    angles = np.radians(np.arange(0, 360, step_deg))
    mass = np.array([0.0, *np.repeat(masses, angles.size)])
    weight = mass * np.exp(1j * np.array([0.0, *np.tile(angles, len(masses))])) * RADIUS
    part = np.array([-1, *np.repeat(np.arange(len(masses)), angles.size)])
    grid = np.array(np.meshgrid(*[np.arange(mass.size)] * 4, indexing="ij")).reshape(4, -1)
    # steps count from the own crank
    u, kind = weight[grid] * np.array([[1], [1], [1j], [1j]]), part[grid]
    used = sum(np.any(kind == index, axis=0).astype(int) for index in range(len(masses)))
    return Sets(
        square * (np.abs(force + u.sum(axis=0)) + abs(back)),
        square * (np.abs(couple + np.array(PLANES) @ u) + abs(back_couple)),
        mass[grid].sum(axis=0),
        (grid > 0).sum(axis=0),
        np.asarray(used),
    )


def front(fields: dict[str, Any], of: str, least: str, **more: Any) -> CountFront:
    answer = pareto(ParetoRequest.model_validate({**fields, "counts": {"of": of, "least": least}, **more}))
    assert answer.fronts == answer.trades == ()
    (counts,) = answer.counts
    return counts


def test_a_million_sets() -> None:
    """Independent: the best, and the lightest of the best, of 31^4 = 923,521 sets by hand."""
    sets = every_set(36.0)
    assert sets.mass.size == 31**4
    answer = optimized(body(36.0))
    assert answer.certificate is not None
    best = float(np.min(sets.objective))
    assert answer.certificate.objective == pytest.approx(best, rel=1e-12)
    assert answer.certificate.lower_bound == pytest.approx(best, rel=1e-12)
    assert answer.status_reason.startswith("Proven optimal: of all sets")
    equal = sets.objective <= best * (1 + 1e-9)
    assert answer.total_mass_kg == pytest.approx(float(np.min(sets.mass[equal])), rel=1e-12)
    # any masses at any angles are never worse
    assert answer.certificate.continuous_lower_bound is not None
    assert answer.certificate.continuous_lower_bound <= best


@pytest.mark.parametrize("of", ["weights", "part_numbers"])
def test_the_least_objective_of_every_number(of: str) -> None:
    """Independent: all 13^4 sets."""
    sets = every_set(90.0)
    count_front = front(body(90.0), of, "objective")
    assert count_front.status == "optimal"
    assert [point.at_most for point in count_front.points] == list(range(len(count_front.points)))
    for point in count_front.points:
        allowed = getattr(sets, of) <= point.at_most
        best = float(np.min(sets.objective[allowed]))
        assert point.value == pytest.approx(best, rel=1e-12)
        assert point.lower_bound == pytest.approx(best, rel=1e-9)
        used = getattr(point, of)
        assert used is not None
        assert used <= point.at_most
        equal = allowed & (sets.objective <= best * (1 + 1e-9))
        assert point.total_mass_kg == pytest.approx(float(np.min(sets.mass[equal])), rel=1e-12)
        assert len(point.counterweights) == 4
    # any more are of no use
    assert count_front.points[-1].value == pytest.approx(float(np.min(sets.objective)), rel=1e-12)


@pytest.mark.parametrize(("name", "of"), [("pieces", "weights"), ("sizes", "part_numbers")])
def test_goals_name_what_is_counted_as_well(name: str, of: str) -> None:
    count_front = front(body(90.0), name, "objective")
    assert count_front.of == name
    assert count_front.points == front(body(90.0), of, "objective").points


@pytest.mark.parametrize("of", ["weights", "part_numbers"])
def test_the_least_mass_of_every_number(of: str) -> None:
    """Independent: of all 13^4 sets that keep both ceilings the lightest."""
    sets = every_set(90.0)
    few = np.flatnonzero(getattr(sets, of) <= (2 if of == "weights" else 1))
    best = few[np.argmin(sets.objective[few])]
    force, moment = 1.01 * float(sets.force[best]), 1.01 * float(sets.moment[best])
    mask = (sets.force <= force) & (sets.moment <= moment)
    goal = {"force_ceiling_N": force, "moment_ceiling_Nm": moment}
    count_front = front(body(90.0, objective=goal), of, "mass")
    assert count_front.status == "optimal"
    assert count_front.points[0].status == "infeasible"
    for point in count_front.points:
        allowed = mask & (getattr(sets, of) <= point.at_most)
        if not np.any(allowed):
            assert point.status == "infeasible"
            assert (point.value, point.counterweights) == (None, ())
            continue
        lightest = float(np.min(sets.mass[allowed]))
        assert point.status == "optimal", point.status_reason
        assert point.value == point.total_mass_kg == pytest.approx(lightest, rel=1e-9)
        assert point.lower_bound is not None
        assert point.lower_bound <= lightest * (1 + 1e-9)
        assert point.force_peak_N is not None
        assert point.force_peak_N <= force * (1 + 1e-9)
    assert count_front.points[-1].value == pytest.approx(float(np.min(sets.mass[mask])), rel=1e-9)
    assert sum(point.status == "optimal" for point in count_front.points) >= 1


def test_budgets_and_ceilings_out_of_reach() -> None:
    payload = body(90.0) | {"counts": {"of": "weights"}, "total_mass_budgets_kg": [10.0, 40.0]}
    light, heavy = pareto(ParetoRequest.model_validate(payload)).counts
    assert (light.max_total_mass_kg, heavy.max_total_mass_kg) == (10.0, 40.0)
    assert all((point.total_mass_kg or 0.0) <= 10.0 for point in light.points)
    assert heavy.points[-1].value is not None
    assert light.points[-1].value is not None
    assert heavy.points[-1].value <= light.points[-1].value
    for least in ("objective", "mass"):
        none = front(body(90.0, objective={"force_ceiling_N": 1.0}), "weights", least)
        assert none.status == "infeasible"
        assert [point.status for point in none.points] == ["infeasible"]


def test_fewer_points_than_numbers() -> None:
    count_front = front(body(90.0), "weights", "objective", points=2)
    assert count_front.points[0].at_most == 0
    assert len(count_front.points) == 2


def test_a_search_that_runs_out_of_time_says_its_gap() -> None:
    payload = body(5.0, tuple(np.arange(1.0, 20.0).tolist())) | {
        "accuracy": {"time_limit_s": 1e-6, "relative_gap": 1e-9}
    }
    count_front = front(payload, "weights", "objective")
    assert count_front.status == "inaccurate"
    late = [point for point in count_front.points if point.status == "inaccurate"]
    assert late
    assert all(point.lower_bound is not None and point.lower_bound <= (point.value or 0.0) for point in late)


@pytest.mark.parametrize(
    ("change", "path"),
    [
        ({"responses": ["force", "mass"]}, ("responses",)),
        ({"multipliers": True}, ("multipliers",)),
        ({"counts": {"of": "weights", "least": "mass"}}, ("counts", "least")),
    ],
)
def test_what_does_not_go_together(change: dict[str, Any], path: tuple[str, ...]) -> None:
    with pytest.raises(ValidationError) as refused:
        ParetoRequest.model_validate({**body(90.0), "counts": {"of": "weights"}, **change})
    assert path in [problem.path for problem in refused.value.errors()[0]["ctx"]["problems"]]


def test_without_a_catalogue_nothing_is_counted() -> None:
    payload = body(90.0)
    del payload["machine"]["catalogue"]
    with pytest.raises(ValidationError) as refused:
        ParetoRequest.model_validate({**payload, "counts": {"of": "weights"}})
    assert ("counts",) in [problem.path for problem in refused.value.errors()[0]["ctx"]["problems"]]


@pytest.mark.parametrize("of", ["weights", "part_numbers"])
def test_numbers_for_the_whole_turn(of: str) -> None:
    """Independent: the largest bearing load of all 2,401 sets of no more than a number, by statics."""
    machine = choices.twin()
    chosen, u = choices.every_set(machine)
    loads = choices.Loads(machine).peak(u)
    used = np.array([_used(choice, of) for choice in chosen])
    count_front = front(
        choices.request_body(machine, bearing_weight=1, force_weight=0, moment_weight=0), of, "objective"
    )
    assert count_front.status == "optimal"
    assert [point.at_most for point in count_front.points] == list(range(len(count_front.points)))
    for point in count_front.points:
        best = float(np.min(loads[used <= point.at_most]))
        assert point.value is not None
        assert best * (1 - 1e-9) <= point.value <= best * (1 + choices.DEGREE)
        assert point.lower_bound == pytest.approx(point.value, rel=1e-5)
        assert point.status_reason
    assert count_front.points[-1].value == pytest.approx(float(np.min(loads)), rel=choices.DEGREE)


@pytest.mark.parametrize("of", every(2, ["part_numbers", "weights"]))
def test_the_least_mass_for_the_whole_turn(of: str) -> None:
    """Independent: of all 2,401 sets that keep a ceiling on the bearings the lightest."""
    machine = choices.twin()
    chosen, u = choices.every_set(machine)
    loads = choices.Loads(machine).peak(u)
    used, mass = (
        np.array([_used(choice, of) for choice in chosen]),
        np.array([sum(m for m, _ in choice) for choice in chosen]),
    )
    # between two loads, so that angles in between tell nothing else
    ordered = np.unique(loads)
    gap = np.flatnonzero(ordered[1:] > ordered[:-1] * (1 + 3 * choices.DEGREE))
    place = int(gap[gap >= 3][0])
    ceiling = float(0.5 * (ordered[place] + ordered[place + 1]))
    query = choices.request_body(machine, moment_weight=0, bearing_ceiling_N=ceiling)
    count_front = front(query, of, "mass")
    assert count_front.status == "optimal"
    statuses = set()
    for point in count_front.points:
        allowed = (loads <= ceiling) & (used <= point.at_most)
        statuses.add(point.status)
        assert (point.status == "optimal") == bool(np.any(allowed)), point.status_reason
        if np.any(allowed):
            assert point.value == point.total_mass_kg == pytest.approx(float(np.min(mass[allowed])), rel=1e-9)
            assert point.lower_bound == pytest.approx(point.value, rel=1e-6)
    assert statuses == {"optimal", "infeasible"}


def test_masses_that_nothing_keeps_over_the_turn() -> None:
    """Independent: a ceiling below what any masses reach."""
    query = choices.request_body(choices.twin(), moment_weight=0, bearing_ceiling_N=100.0)
    for least in ("objective", "mass"):
        count_front = front(query, "weights", least)
        assert count_front.status == "infeasible"
        assert all(
            (point.status, point.value, point.counterweights) == ("infeasible", None, ())
            for point in count_front.points
        )


def _used(chosen: Any, of: str) -> int:
    masses = [mass for mass, _ in chosen if mass > 0]
    return len(masses) if of == "weights" else len(set(masses))


@pytest.mark.parametrize("more", [{}, {"responses": ["force", "mass"]}])
def test_goals_in_their_order_are_no_front(more: dict[str, Any]) -> None:
    goal = {"bearing_weight": 1, "priorities": [{"goal": "external"}, {"goal": "bearings"}]}
    with pytest.raises(ValidationError) as refused:
        front(choices.request_body(choices.twin(), **goal), "weights", "objective", **more)
    problems = [problem.path for error in refused.value.errors() for problem in error["ctx"]["problems"]]
    assert ("objective", "priorities") in problems


def test_what_the_whole_turn_needs_is_named() -> None:
    machine = choices.twin()
    del machine["bearings"]
    with pytest.raises(MissingInput) as refused:
        front(choices.request_body(machine, bearing_weight=1), "weights", "objective")
    assert [problem.path for problem in refused.value.problems] == [("machine", "bearings")]


def test_fewer_counterweights_than_sizes_are_counted_too() -> None:
    """Analytic: with no counterweight, and with one, there is no second size to leave out."""
    payload = body(90.0, counts={"of": "pieces", "least": "objective"}, points=3)
    free = pareto(ParetoRequest.model_validate(payload)).counts[0].points
    payload["machine"]["catalogue"]["max_part_numbers"] = 2
    two = pareto(ParetoRequest.model_validate(payload)).counts[0].points
    assert two[0].at_most == 0
    assert two[0].value == free[0].value
    assert all((point.part_numbers or 0) <= 2 for point in two)
