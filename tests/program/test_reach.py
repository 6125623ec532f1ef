"""How far webs without a limit have to be looked into."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import linprog

from optimizer.mechanics.angles import direction
from optimizer.numerics.arrays import Complex
from optimizer.program.ceilings import Ceilings
from optimizer.program.equal_castings import Alike
from optimizer.program.kernel.cancelling import least_changes_of_real
from optimizer.program.limits import Limits
from optimizer.program.methods.implied_bounds import (
    bounded,
    far_limits,
    level_above,
    within_reach,
)
from optimizer.program.methods.semicontinuous_bounds import _subset_mass, _subsets
from optimizer.program.norms import Norms
from optimizer.program.reference.solver import _blended
from optimizer.program.rows import combined, statement, weighted_peak
from optimizer.program.scaling import least_change, natural_reach
from optimizer.program.solution import evaluated
from optimizer.program.statement import Names, Statement, Term
from optimizer.responses.response import Phasors, Response
from tests.program.alone import carrying_mass, masses_by_inverse, responses

#: of a web that is all but free: where a cone is held up by next to nothing
STEEP = 89.999999


def limits(webs: int, half_angle: float, max_mass: float = np.inf, radius: float = 0.25) -> Limits:
    edge, ones = direction(half_angle), np.ones(webs)
    return Limits(
        radius * ones, max_mass * ones, ones < 0, ones + 0j, edge.real * ones, edge.imag * ones, np.asarray(np.inf)
    )


@pytest.mark.parametrize("webs", [1, 2, 3])
@pytest.mark.parametrize("scale", [1.0, 1e-9])
def test_webs_that_are_told_by_what_they_change(webs: int, scale: float) -> None:
    """Analytic: each carries no more than its largest multiple that all responses allow."""
    rng = np.random.default_rng(webs)
    for _ in range(20):
        matrix = rng.normal(size=(3, webs)) * scale ** rng.uniform(0, 1, webs)
        masses: Complex = rng.normal(size=(2, webs)).T @ np.array([1, 1j])
        inverse = masses_by_inverse(matrix, np.abs(matrix @ masses))
        assert np.all(np.abs(masses) <= inverse)
    assert np.all(np.isinf(masses_by_inverse(rng.normal(size=(webs - 1, webs)), np.ones(webs - 1))))


def test_one_web_is_told_by_one_response() -> None:
    """Analytic: half a unit a kilogram, and one unit at most."""
    assert masses_by_inverse(np.array([[0.5]]), np.array([1.0])) == pytest.approx([2.0], rel=1e-12)


def test_a_response_that_a_web_does_not_change_tells_nothing_of_it() -> None:
    """Analytic: 4 at most of the response of which a kilogram changes 2, and nothing of another one."""
    influence = np.array([[0.0, 1.0], [2.0, 3.0]])
    assert _subset_mass(influence, limits(2, STEEP), [0], np.array([0.0, 4.0]), np.zeros(2, bool)) == 2.0


def test_webs_that_cannot_be_told_apart_are_not() -> None:
    assert np.all(np.isinf(masses_by_inverse(np.array([[1.0, 1.0], [2.0, 2.0]]), np.ones(2))))
    assert np.all(np.isinf(masses_by_inverse(np.array([[1.0, 0.0], [2.0, 0.0]]), np.ones(2))))


def test_a_web_that_is_all_but_free_has_a_proven_reach() -> None:
    """Analytic: |10 + u| is at most 20 kg m, twice that of rest, so that |u| is at most 30 kg m."""
    force = Response("force", "N", Phasors(10.0 + 0j, 0j), np.ones(1))
    program = statement(combined([weighted_peak(force, 1.0)], "sum"), [], limits(1, STEEP))
    assert within_reach(program).limits.max_mass == pytest.approx([30.0 / 0.25], rel=1e-8)


@pytest.mark.parametrize("seed", range(5))
def test_two_webs_carry_what_two_responses_may_change(seed: int) -> None:
    """Analytic: Cramer's rule; the mass that is told is that of the changes which call for most."""
    rng = np.random.default_rng(seed)
    influence, most = rng.uniform(-1.0, 1.0, (2, 2)), rng.uniform(0.5, 3.0, 2)
    two, apart = limits(2, 90.0), np.zeros(2, bool)
    free = Limits(
        two.radius, two.max_mass, ~apart, two.centre, two.half_angle_cos, two.half_angle_sin, np.asarray(np.inf)
    )
    bound = carrying_mass(influence, free, most, apart)
    inverse = np.abs(np.linalg.inv(influence))
    assert bound == pytest.approx(np.sum(inverse @ most), rel=1e-9)
    changes = most[:, None] * np.exp(1j * rng.uniform(0.0, 2 * np.pi, (2, 200)))
    assert np.all(np.sum(np.abs(np.linalg.solve(influence, changes)), axis=0) <= bound * (1 + 1e-12))
    # one response of two webs: the one that does most
    assert carrying_mass(influence[:1], free, most[:1], apart[:1]) == pytest.approx(
        most[0] / np.max(np.abs(influence[0]))
    )


def test_what_is_blended_stays_in_its_sector() -> None:
    """Far from both the step is rounded by more than the sector is wide; a bound then stood above the mass."""
    force = Response("force", "N", Phasors(10.0 + 0j, 0j), np.ones(1))
    within = limits(1, STEEP, 1e15)
    program = statement(combined([weighted_peak(force, 1.0)], "sum"), [], within)
    safe = evaluated(program, within.into(np.array([-1.0 + 5.4j])))
    far = within.into(1e14 * np.array([-1.0 - 5.0j]))
    for target in (12.0, 15.0, 40.0):
        values = _blended(program, far, safe, target)
        assert np.all(np.abs(within.into(values) - values) <= 4e-16 * np.abs(values))


@pytest.mark.parametrize("turn", [0.0, 100.0, 180.0, 260.0])
@pytest.mark.parametrize("half_angle", [30.0, 100.0])
def test_the_reach_of_webs_in_sectors_does_not_depend_on_where_these_point(turn: float, half_angle: float) -> None:
    """Analytic: what turns with everything else is the same; a web alone carries its response by itself."""
    influence, most, apart = np.array([[0.5, -1.5]]), np.array([3.0]), np.zeros(1, bool)
    straight = limits(2, half_angle)
    turned = replace(straight, centre=direction(turn) * straight.centre)
    bound = carrying_mass(influence, turned, most, apart)
    assert bound == pytest.approx(carrying_mass(influence, straight, most, apart), rel=1e-6)
    # the lighter web reaches what is to be carried, or the heavier one does
    assert 3.0 / 1.5 * (1 - 1e-9) <= bound < np.inf


@pytest.mark.parametrize("ceiling", [12.0, 15.0])
def test_a_response_that_is_small_and_limited_is_one(ceiling: float) -> None:
    """Analytic: |10 + u| is at most its ceiling, so that |u| is at most 10 kg m more."""
    force = Response("force", "N", Phasors(np.asarray(10.0 + 0j), np.asarray(0j)), np.ones(1))
    free = replace(limits(1, 90.0), free=np.ones(1, bool))
    program = statement(combined([weighted_peak(force, 1.0)], "sum"), [(force, ceiling)], free)
    assert within_reach(program).limits.max_mass == pytest.approx([(10.0 + ceiling) / 0.25], rel=1e-6)


def _two_terms(**changes: Any) -> tuple[Statement, float]:
    """|10 + u1 + u2| and 3 |2 j - u1|, the larger of which is looked at, of two free webs; and a level."""
    free = replace(limits(2, 90.0), free=np.ones(2, bool))
    norms = Norms(np.array([10.0 + 0j, 6j]), np.array([[1.0, 1.0], [-3.0, 0.0]]), **changes)
    names = Names((Term("a", "co"), Term("b", "co")), ("a", "b"))
    none = Ceilings((), Norms(np.zeros(0, complex), np.zeros((0, 2))), np.zeros(0), np.zeros(0))
    rows = np.array([0, 1])
    return Statement(norms, rows, np.zeros(2, int), np.array([1.0, 2.0]), none, free, names), 20.0


def test_what_responses_may_change_is_told_in_units_of_the_web_that_does_most() -> None:
    """Analytic: |c| and what the level leaves of the floor, over the largest influence; signs with it."""
    program, level = _two_terms()
    rows, most, scalar = responses(program, np.ones(2, bool), level)
    np.testing.assert_allclose(rows, [[1.0, 1.0], [1.0, 0.0]])
    np.testing.assert_allclose(most, [10.0 + 19.0, (6.0 + 18.0) / 3.0], rtol=2e-9)
    assert np.all(most >= [29.0, 8.0])
    assert not np.any(scalar)
    # a web that is near reaches no farther than its limit
    near = replace(program, limits=replace(program.limits, max_mass=np.array([np.inf, 4.0])))
    rows, most, _ = responses(near, np.array([True, False]), level)
    # both are one response of the only web that is left
    np.testing.assert_allclose(rows, [[1.0]])
    assert most == pytest.approx([8.0], rel=2e-9)


def test_a_group_leaves_the_others_their_largest_floor() -> None:
    """Analytic: of a level of 20, the other group takes its floor."""
    program, level = _two_terms()
    program = replace(program, group=np.array([0, 1]))
    _, most, _ = responses(program, np.ones(2, bool), level)
    np.testing.assert_allclose(most, [10.0 + 20.0 - 1.0 - 2.0, (6.0 + 20.0 - 2.0 - 1.0) / 3.0], rtol=2e-9)


def test_scalars_in_other_directions_are_other_responses() -> None:
    program, level = _two_terms(scalar=(True, False))
    _, _, scalar = responses(program, np.ones(2, bool), level)
    assert scalar.tolist() == [True, False]
    turned = replace(program, norms=replace(program.norms, influence=1j * program.norms.influence))
    values, _, _ = responses(turned, np.ones(2, bool), level)
    np.testing.assert_allclose(values, [[1j, 1j], [1.0, 0.0]])
    # a response of the same direction and size is one, and bound by the closer
    twice = replace(
        program,
        norms=Norms(np.array([10.0 + 0j, 4.0 + 0j]), np.array([[1.0, 1.0], [2.0, 2.0]])),
    )
    rows, most, _ = responses(twice, np.ones(2, bool), level)
    np.testing.assert_allclose(rows, [[1.0, 1.0]])
    assert most == pytest.approx([(4.0 + 18.0) / 2.0], rel=2e-9)


def test_no_web_is_far_that_is_limited_to_what_is_called_for() -> None:
    """Analytic: the least unbalance that cancels is 12, of webs of 0.25 m; a thousand times that is as far as any."""
    program, _ = _two_terms()
    cancels = natural_reach(program) / 0.25
    for share, far in ((0.5, False), (999.0, False), (1001.0, True), (np.inf, True)):
        some = np.array([share * float(cancels), 1.0])
        bounds = far_limits(replace(program, limits=replace(program.limits, max_mass=some)))
        assert bounds.tolist() == [far, False]
    # a budget is a limit as well
    budget = replace(program.limits, max_total_mass=np.asarray(5.0 * float(cancels)), max_mass=np.full(2, 1e12))
    assert not np.any(far_limits(replace(program, limits=budget)))


def test_scattering_webs_reach_as_far_as_what_scatters_is_allowed() -> None:
    """Analytic: a kilogram scatters by 0.1 R |H|: of the second web only the first row, (20 - 1)/(0.1 * 0.25)."""
    program, level = _two_terms(scatter=0.1)
    max_mass = bounded(program, level).limits.max_mass
    first = min(19.0 / 0.025, 18.0 / (0.1 * 3.0 * 0.25))
    assert max_mass == pytest.approx([max(first, 19.0 / 0.025)] * 2, rel=1e-8)


def test_a_web_alone_is_bound_by_what_its_responses_leave() -> None:
    """Analytic: two webs and two responses, by Cramer's rule: u1 = -b, u2 = a + b, of |a| <= 29 and |b| <= 8."""
    program, level = _two_terms()
    max_mass = bounded(program, level).limits.max_mass
    most = max(8.0, 29.0 + 8.0) / 0.25
    assert np.all(max_mass >= [8.0 / 0.25, 37.0 / 0.25])
    assert np.max(max_mass) <= (8.0 + 37.0) / 0.25 * (1.0 + 1e-8)
    assert np.max(max_mass) >= most
    # what is limited far more closely stays as it is, and the other one with it
    near = replace(program, limits=replace(program.limits, max_mass=np.array([4.0, np.inf])))
    assert bounded(near, level).limits.max_mass[0] == 4.0
    assert bounded(near, level).limits.max_mass[1] >= 29.0 / 0.25
    # without a level nothing is proven, and no more than the largest mass is left
    assert np.all(bounded(program, np.inf).limits.max_mass == 1e15)


def test_of_mirrored_webs_nothing_is_proven_by_what_one_does() -> None:
    """By definition: a limit that there is stays, and no more than the largest mass is left of none."""
    program, level = _two_terms()
    pair = Alike(np.ones(2, complex), np.zeros(2), (0, 0), (False, True))
    for most in (np.array([4.0, 4.0]), np.full(2, np.inf)):
        limits = replace(program.limits, max_mass=most, alike=pair)
        assert (
            bounded(replace(program, limits=limits), level).limits.max_mass.tolist() == np.minimum(most, 1e15).tolist()
        )


def test_the_level_leaves_room_for_all_that_counts_as_an_optimum() -> None:
    """Analytic: twice the objective of a point, less the floors."""
    program, _ = _two_terms()
    assert level_above(program, np.zeros(2, complex)) == pytest.approx(2.0 * 11.0 - 1.0)


@pytest.mark.parametrize("seed", range(4))
def test_what_sectors_carry_they_carry_with_the_mass_that_is_told(seed: int) -> None:
    """Independent: of changes that some masses bring, the least mass of rays that bring them, by a linear program."""
    rng = np.random.default_rng(seed)
    influence, apart = rng.normal(size=(2, 3)), np.zeros(2, bool)
    sectors = replace(limits(3, 40.0), centre=np.exp(2j * np.pi * rng.random(3)))
    edge = np.exp(1j * np.deg2rad(40.0))
    rays = np.concatenate([sectors.centre * turn for turn in (1.0, edge, np.conj(edge))])
    brought = np.tile(influence, 3) * rays
    rows = np.concatenate([brought.real, brought.imag])
    bound = carrying_mass(influence, sectors, np.ones(2), apart)
    assert np.isfinite(bound)
    for _ in range(30):
        masses = rng.exponential(size=9) * rng.integers(0, 2, 9)
        change = brought @ masses
        size = np.max(np.abs(change))
        if size > 0.0:
            least = linprog(np.ones(9), A_eq=rows, b_eq=np.concatenate([change.real, change.imag]) / size).fun
            assert least <= bound * (1.0 + 1e-9)


def test_a_limited_response_is_no_larger_than_its_ceiling_and_its_tolerance() -> None:
    """Analytic: a ceiling of 5 on |3 + 2 u1| with a size of 1e9, whose tolerance is a unit more."""
    program, level = _two_terms()
    norms = Norms(np.array([3.0 + 0j]), np.array([[2.0, 0.0]]))
    capped = Ceilings(("a",), norms, np.array([5.0]), np.array([1e9]))
    rows, most, _ = responses(replace(program, ceilings=capped), np.ones(2, bool), level)
    # of u1 alone the second term allows 8, this one (3 + 5 + 1) / 2
    np.testing.assert_allclose(rows, [[1.0, 1.0], [1.0, 0.0]])
    np.testing.assert_allclose(most, [29.0, 4.5], rtol=2e-9)


@pytest.mark.parametrize(
    ("rows", "scalar", "free", "sets"),
    [
        # two planes: webs alone, and pairs that are apart; of one plane webs alone
        ([[1.0, 1.0, 1.0, 0.0], [0.5, 0.5, -1.0, 0.0]], (False, False), True, "0 1 2 02 12"),
        ([[1.0, 1.0, 1.0, 0.0]], (False,), True, "0 1 2"),
        # what is one number has no such planes, nor what a sector holds, nor three rows
        ([[1.0, 1.0, 1.0, 0.0], [0.5, 0.5, -1.0, 0.0]], (False, True), True, "0 1 2 01 02 12 012"),
        ([[1.0, 1.0, 1.0, 0.0]], (True,), True, "0 1 2 01 02 12 012"),
        ([[1.0, 1.0, 1.0, 0.0]], (False,), False, "0 1 2 01 02 12 012"),
        ([[1.0, 1.0, 1.0, 0.0]] * 3, (False,) * 3, True, "0 1 2 01 02 12 012"),
        # so many that none is looked at
        ([[1.0] * 5], (True,), True, ""),
        ([[1.0] * 4], (True,), True, "0 1 2 3 01 02 03 12 13 23 012 013 023 123 0123"),
    ],
)
def test_sets_of_webs_hold_one_that_changes_all_that_others_do(
    rows: list[list[float]], scalar: tuple[bool, ...], free: bool, sets: str
) -> None:
    ones = np.ones(len(rows[0]))
    limits = Limits(0.5 * ones, ones, np.full(ones.size, free), ones + 0j, 0.0 * ones, ones, np.asarray(np.inf))
    frozensets = [frozenset(subset) for subset in _subsets(np.array(rows), limits, np.array(scalar))]
    assert sorted(map(sorted, frozensets)) == sorted([int(web) for web in part] for part in sets.split())


def test_a_real_constant_is_cancelled_by_the_same_machine_code() -> None:
    """Analytic: 2 u - 4 is 0 for u = 2. Another signature would be compiled while a client waits."""
    for kind in (float, complex):
        assert least_change(np.full((1, 1), 2.0), np.full(1, -4.0, kind), 1) == 2.0
    assert len(least_changes_of_real.signatures) == 1


@given(terms=st.integers(1, 4), webs=st.integers(1, 6), passes=st.integers(1, 3), seed=st.integers(0, 2**16))
def test_real_influences_are_complex_ones_to_the_last_digit(terms: int, webs: int, passes: int, seed: int) -> None:
    """Independent: complex arithmetic with imaginary parts of 0."""
    source = np.random.default_rng(seed)
    influence = np.rint(3.0 * source.normal(size=(20, terms, webs)))
    constant = source.normal(size=(20, terms)) + 1j * source.normal(size=(20, terms))
    change = least_change(influence, constant, passes)
    np.testing.assert_array_equal(change, least_change(influence.astype(complex), constant, passes))


@given(seed=st.integers(0, 10_000))
def test_many_programs_reach_as_far_as_each_alone(seed: int) -> None:
    """Property: to the last bit, whichever webs have limits, whatever they change, and whether ceilings are kept."""
    rng = np.random.default_rng(seed)
    count, webs = int(rng.integers(2, 6)), int(rng.integers(1, 4))
    # some programs feel some webs alike, some not at all
    of_force, of_moment = (rng.choice([0.0, 1.0, -0.5], (count, webs)) for _ in range(2))
    names, responses_of = ("force", "moment"), []
    for name, influence in zip(names, (of_force, of_moment), strict=True):
        co, counter = (rng.normal(size=(2, count)).T @ np.array([1, 1j]) for _ in range(2))
        responses_of.append(Response(name, "N", Phasors(co, counter), influence))
    peaks = [weighted_peak(response, rng.uniform(0.5, 2.0, count)) for response in responses_of]
    edges = limits(webs, STEEP)
    many = edges.mapped(lambda array: np.broadcast_to(array, (count, *array.shape)).copy())
    many = replace(many, max_mass=rng.choice([np.inf, 1e9, 0.3], (count, webs)), free=np.ones((count, webs), bool))
    program = statement(combined(peaks, str(rng.choice(["sum", "max"]))), [], many)
    together = within_reach(program).limits.max_mass
    for n in range(count):
        assert within_reach(program.subset(n)).limits.max_mass.tolist() == together[n].tolist()
