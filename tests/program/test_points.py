"""Points with their figures: which of two is taken, how far one is moved, which proof goes with it (analytic)."""

from dataclasses import replace

import numpy as np
import pytest

from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.program.certificate import nothing_proven
from optimizer.program.kernel.judging import is_better, step_towards
from optimizer.program.methods.compiled import suits_kernel
from optimizer.program.methods.disc_programs import suits_discs
from optimizer.program.methods.stage_ends import pulled
from optimizer.program.points import points_at
from optimizer.program.solution import CEILING_ROUNDING, ConeSolution, evaluated, side_by_side
from tests.program.cases import random_point
from tests.program.test_leading_axes import WEBS, _multipliers, _program

_BROKEN = 2.0 * CEILING_TOLERANCE


def _figures(objective: float, mass: float, excess: float) -> tuple[float, float, float, float]:
    return objective, mass, excess, 1e-3


@pytest.mark.parametrize(
    ("old", "new", "better"),
    [
        # both keep the ceilings: the smaller objective, and of equal ones the first
        ((2.0, 0.0), (1.0, 0.0), True),
        ((1.0, 0.0), (2.0, 0.0), False),
        ((1.0, 0.0), (1.0, -1.0), False),
        ((2.0, CEILING_TOLERANCE), (1.0, CEILING_TOLERANCE), True),
        # only one does
        ((1.0, _BROKEN), (9.0, 0.0), True),
        ((9.0, 0.0), (1.0, _BROKEN), False),
        # none does: the smaller excess
        ((1.0, 3.0), (9.0, 2.0), True),
        ((9.0, 2.0), (1.0, 3.0), False),
        ((9.0, 2.0), (1.0, 2.0), False),
    ],
)
def test_the_better_of_two_points(old: tuple[float, float], new: tuple[float, float], better: bool) -> None:
    first, second = (_figures(objective, 1.0, excess) for objective, excess in (old, new))
    assert is_better.py_func(first, second, CEILING_TOLERANCE) == better


@pytest.mark.parametrize(
    ("target", "share"),
    [(8.0, 0.001 / 6.0), (6.0, 2.001 / 6.0), (2.5, 5.501 / 6.0), (8.001, 0.0), (9.0, None), (2.0, None), (1.0, None)],
)
def test_the_lightest_is_moved_as_far_as_its_target_calls_for(target: float, share: float | None) -> None:
    """Over its target by what it comes to and a rounding of 1e-3, of a fall of 6; not where that is not enough."""
    light, small = _figures(8.0, 1.0, 0.0), _figures(2.0, 3.0, 0.0)
    assert step_towards.py_func(light, small, target) == pytest.approx(share or 0.0, rel=1e-9)


def test_points_above_a_ceiling_are_moved_to_it_and_no_farther() -> None:
    """Property: excesses are convex, so that those half way are below; what keeps its ceilings stays."""
    programs = [_program(seed, "ceiling") for seed in range(4)]
    for seed, program in enumerate(programs):
        statement = program.alone()
        inside = np.zeros((1, WEBS), complex)
        for size in (0.1, 3.0, 10.0):
            u = size * random_point(np.random.default_rng(seed), program.limits)[None]
            points = pulled(statement, u, inside)
            above, below = float(points_at(statement, u).excess[0]), float(points_at(statement, inside).excess[0])
            if above <= CEILING_ROUNDING:
                assert np.array_equal(points, u)
            elif below < 0.0:
                assert points_at(statement, points).excess[0] <= 1e-9
                share = above / (above - below)
                np.testing.assert_allclose(points, u * (1.0 - share), rtol=1e-9)


def test_the_better_of_two_proofs_goes_with_a_point() -> None:
    program = _program(1, "ceiling")
    proof, none = _multipliers(1, program), nothing_proven(program)
    point = evaluated(program, np.ones(WEBS, complex))
    assert (point.lower_bound, point.mass_lower_bound, point.mass_target) == (-np.inf, 0.0, np.inf)
    assert point.objective == float(program.objective(np.ones(WEBS, complex)))
    assert point.mass == float(program.mass(np.ones(WEBS, complex)))
    assert point.excess == float(np.max(program.ceilings.excess(np.ones(WEBS, complex))))
    better = point.bounded(3.0, proof)
    assert (better.lower_bound, better.multipliers) == (3.0, proof)
    assert better.gap == better.objective - 3.0
    assert better.bounded(3.0, none) is better
    assert better.bounded(2.0, none) is better
    heavier = better.weighed(0.5, proof, 9.0)
    assert (heavier.mass_lower_bound, heavier.mass_multipliers, heavier.mass_target) == (0.5, proof, 9.0)
    assert heavier.weighed(0.5, none, 1.0) is heavier
    assert heavier.weighed(np.nan, none, 1.0) is heavier
    moved = heavier.with_point(program, np.zeros(WEBS, complex))
    assert (moved.mass, moved.lower_bound, moved.mass_lower_bound) == (0.0, 3.0, 0.5)
    assert moved.objective == pytest.approx(float(program.at_rest))


@pytest.mark.parametrize(
    ("excess", "keeps", "below"),
    [(CEILING_ROUNDING, True, True), (1.1 * CEILING_ROUNDING, True, False), (CEILING_TOLERANCE, True, False),
     (1.1 * CEILING_TOLERANCE, False, False), (-np.inf, True, True)],
)  # fmt: skip
def test_ceilings_are_kept_to_their_tolerance_and_to_rounding(excess: float, keeps: bool, below: bool) -> None:
    nothing = nothing_proven(_program(1, "plain"))
    solution = ConeSolution(np.zeros(WEBS, complex), 1.0, 0.0, 1.0, 0.0, excess, nothing)
    assert (solution.keeps_ceilings, solution.below_ceilings) == (keeps, below)


def test_parts_are_put_in_the_order_of_all_programs() -> None:
    assert side_by_side([np.array([2.0]), np.array([5.0])], np.array([1, 0])).tolist() == [5.0, 2.0]


@pytest.mark.parametrize(
    ("kind", "rows", "terms", "suits"),
    [("plain", 1, 1, True), ("plain", 1, 2, True), ("plain", 1, 3, True), ("plain", 2, 2, False),
     ("sector", 1, 2, True), ("budget", 1, 2, True), ("ceiling", 1, 2, True), ("scatter", 1, 2, False),
     ("scalar", 1, 2, False)],
)  # fmt: skip
def test_programs_of_discs_are_told_from_others(kind: str, rows: int, terms: int, suits: bool) -> None:
    """Analytic: one row of vectors that are multiples of two."""
    whole = _program(3, kind)
    some = np.arange(terms)
    norms = replace(
        whole.norms, constant=whole.norms.constant[some], influence=whole.norms.influence[some],
        scalar=whole.norms.scalar[:terms],
    )  # fmt: skip
    row = np.minimum(some, rows - 1)
    names = whole.names._replace(terms=whole.names.terms[:terms])
    program = replace(whole, norms=norms, row=row, group=np.zeros(rows, int), floor=whole.floor[:rows], names=names)
    assert suits_discs(program.alone()).tolist() == [suits]


@pytest.mark.parametrize(("kind", "suits"), [("plain", True), ("group", False), ("sector, budget", True)])
def test_the_compiled_interior_point_takes_one_group_of_real_influences(kind: str, suits: bool) -> None:
    program = _program(3, kind)
    assert suits_kernel(program) == suits
    turned = replace(program, norms=replace(program.norms, influence=program.norms.influence + 0j))
    assert not suits_kernel(turned)
