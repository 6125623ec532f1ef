"""What may stand for an optimum in which some webs are empty: analytic."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from optimizer.program.cuts import empty_webs as cuts
from optimizer.program.methods import empty_webs
from optimizer.program.methods.empty_webs import Optimum, _unit, leave_empty
from optimizer.program.methods.optima import optima
from optimizer.program.points import Points, points_at
from optimizer.program.solution import CEILING_ROUNDING
from optimizer.program.verdict import MASS_GAP
from tests.program.test_settled import in_planes


def _point(objective: float = 1.0, mass: float = 2.0, excess: float = 0.0) -> Points:
    return Points(np.zeros((1, 2), complex), *(np.array([figure]) for figure in (objective, mass, excess, 1e-12)))


@pytest.mark.parametrize(
    ("point", "admitted"),
    [
        (_point(), True),
        (_point(objective=1.0 + 0.9e-12), True),
        (_point(objective=1.0 + 1.1e-12), False),
        (_point(mass=2.0 + 1e-12), False),
        (_point(excess=1e-12), False),
        (_point(objective=0.5, mass=1.0, excess=-np.inf), True),
    ],
)
def test_a_point_is_no_worse_than_the_optimum_but_for_the_rounding_of_its_objective(
    point: Points, admitted: bool
) -> None:
    optimum = Optimum(np.array([1.0]), np.array([2.0]), np.array([0.0]), None)
    assert optimum.admits(point).tolist() == [admitted]


def test_webs_that_are_not_alike_are_emptied_one_by_one() -> None:
    program = in_planes([-1.0, 1.0, 0.3]).alone()
    assert [_unit(program, web).tolist() for web in range(3)] == np.eye(3, dtype=bool).tolist()


@pytest.mark.parametrize("least_mass", [True, False])
def test_without_dust_a_point_is_as_heavy_as_may_be_claimed(least_mass: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """Analytic: nine tenths of the gap that a mass may have; the objective no further than its own target."""
    program = in_planes([-1.0, 1.0, 0.3]).alone()
    actual_optima = optima(program, 1e-6, True)
    dusty = np.array([[-2.0, -2.5, 1e-9]]) + 0j
    objective, mass = program.objective(dusty), program.mass(dusty)
    variant = replace(actual_optima, unbalance=dusty, objective=objective, mass=mass, clean=np.zeros(1, bool))
    variant.mass_lower_bound[:], variant.mass_target[:], variant.lower_bound[:] = 4.6, 9.0, 1.0
    entries = []

    def nowhere(_: object, empty: np.ndarray, optimum: Optimum, *rest: object) -> tuple[Points, np.ndarray]:
        entries.append(optimum)
        return points_at(program, dusty), np.zeros(len(empty), bool)

    monkeypatch.setattr(empty_webs, "_without", nowhere)
    leave_empty(program, variant, np.array([0.5]), least_mass)
    optimum = entries[0]
    assert optimum.mass == pytest.approx([4.6 / (1.0 - 0.9 * MASS_GAP) if least_mass else np.inf], rel=1e-14)
    assert optimum.excess == [CEILING_ROUNDING]
    assert optimum.objective == pytest.approx(max(1.0 + empty_webs.TARGET * 0.5, float(program.objective(dusty)[0])))
    assert (optimum.mass_bound is None) != least_mass


def test_webs_are_left_empty_in_many_programs_at_once_as_in_each_alone() -> None:
    """Programs with dust on one web, on another and on two, and one with none: to the last bit as each by itself."""
    program = in_planes([-1.0, 1.0, 0.3, 0.7]).alone().subset(np.zeros(4, np.int64))
    solutions, share = optima(program, 1e-6, True), np.full(4, 0.5)
    dust = np.array([[1e-9, 0, 0, 0], [0, 0, 1e-9, 0], [0, 1e-9, 1e-9, 0], [0, 0, 0, 0]])
    dusty = np.array([-2.0, -2.5, -1.0, -1.5]) * (dust == 0) + dust + 0j
    objective = program.objective(dusty)
    mass, clean = program.mass(dusty), np.zeros(4, bool)
    solutions = replace(solutions, unbalance=dusty, objective=objective, mass=mass, clean=clean)
    solutions.lower_bound[:], solutions.mass_lower_bound[:], solutions.mass_target[:] = objective, 1e-3, objective + 1.0
    alone = [solutions.subset(np.array([n])) for n in range(4)]
    leave_empty(program, solutions, share, True)
    for n, optimum in enumerate(alone):
        leave_empty(program.subset(np.array([n])), optimum, share[[n]], True)
        assert np.array_equal(optimum.unbalance[0], solutions.unbalance[n])
        assert optimum.objective[0] == solutions.objective[n]
        assert optimum.mass[0] == solutions.mass[n]
    assert ((solutions.unbalance == 0) >= (dust > 0)).all()
    assert np.array_equal(solutions.unbalance[3], dusty[3])


class _Noted(cuts.EmptyWebs):
    """Searches that find what they are told to, and note what was to be empty."""

    def __init__(self, fields: dict[tuple[int, ...], list[float]]) -> None:
        object.__setattr__(self, "optima", fields)
        object.__setattr__(self, "tried", [])
        object.__setattr__(
            self, "program", SimpleNamespace(limits=SimpleNamespace(radius=np.array([1.0, 1.0, 2.0, 1.0])))
        )

    def _without(self, empty: np.ndarray, point: cuts.Point) -> cuts.Point | None:
        key = tuple(np.flatnonzero(empty).tolist())
        self.tried.append(key)
        return _at(self.optima[key]) if key in self.optima else None


def _at(masses: list[float]) -> cuts.Point:
    return cuts.Point(np.array(masses) * np.array([1.0, 1.0, 2.0, 1.0]) + 0j, None, 1.0)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("masses", "fields", "tried", "left"),
    [
        ([1.0, 2.0, 0.0, 3.0], {}, [], [1.0, 2.0, 0.0, 3.0]),
        # all of it at once, and what is only then next to nothing
        ([1.0, 1e-9, 2e-9, 3.0], {(1, 2): [1.0, 0.0, 0.0, 3.0]}, [(1, 2)], [1.0, 0.0, 0.0, 3.0]),
        (
            [1.0, 1e-9, 2.0, 3.0],
            {(1,): [1e-9, 0.0, 2.0, 3.0], (0, 1): [0.0, 0.0, 2.0, 3.0]},
            [(1,), (0, 1)],
            [0.0, 0.0, 2.0, 3.0],
        ),
        # else web by web, the lightest first
        ([1.0, 2e-9, 1e-9, 3.0], {(2,): [1.0, 2e-9, 0.0, 3.0]}, [(1, 2), (2,), (1, 2)], [1.0, 2e-9, 0.0, 3.0]),
        ([1.0, 2e-9, 1e-9, 3.0], {(1,): [1.0, 0.0, 1e-9, 3.0]}, [(1, 2), (2,), (1,)], [1.0, 0.0, 1e-9, 3.0]),
    ],
)
def test_over_the_turn_webs_are_left_empty_together_or_one_by_one(
    masses: list[float], fields: dict[tuple[int, ...], list[float]], tried: list[tuple[int, ...]], left: list[float]
) -> None:
    search = _Noted(fields)
    assert search.leave(_at(masses)).unbalance.tolist() == _at(left).unbalance.tolist()
    assert search.tried == tried
