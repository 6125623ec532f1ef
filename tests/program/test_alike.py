"""Webs that are alike: the nearest point, what pulls at them, and the same program in fewer unknowns."""

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.mechanics.angles import direction
from optimizer.numerics.arrays import Complex
from optimizer.program import scaling
from optimizer.program.ceilings import Ceilings
from optimizer.program.equal_castings import Alike
from optimizer.program.equal_unknowns import apart, united
from optimizer.program.limits import Limits
from optimizer.program.methods.compensation import balanced
from optimizer.program.norms import Norms
from optimizer.program.statement import Names, Statement, Term

WEBS = 6


def alike(leader: tuple[int, ...], mirrored: tuple[bool, ...], seed: int) -> Alike:
    ahead = np.random.default_rng(seed).uniform(0, 360, len(leader))
    ahead[np.array(leader) == np.arange(len(leader))] = 0.0
    return Alike(direction(ahead), ahead, leader, mirrored)


GROUPS = (
    ((0, 0, 2, 2, 4, 4), (False, True, False, True, False, True)),
    ((0, 1, 0, 1, 0, 1), (False, False, True, False, False, True)),
    ((3, 1, 3, 3, 1, 3), (False, False, True, False, False, False)),
    ((0, 1, 2, 3, 4, 5), (False,) * 6),
)
ANY = st.sampled_from(GROUPS)
SEED = st.integers(0, 10_000)


def points(seed: int, count: int) -> Complex:
    random = np.random.default_rng(seed)
    return random.normal(size=(count, WEBS)) + 1j * random.normal(size=(count, WEBS))


@given(ANY, SEED)
def test_the_nearest_is_alike_and_nearest(group: tuple[tuple[int, ...], tuple[bool, ...]], seed: int) -> None:
    """Analytic: a projection; what it leaves pulls at nothing that is alike."""
    webs = alike(*group, seed)
    u, v = points(seed, 2)
    near = webs.nearest(u)
    assert np.allclose(webs.nearest(near), near, rtol=0, atol=1e-12)
    assert np.allclose(np.abs(near), np.abs(near)[list(webs.leader)], rtol=0, atol=1e-12)
    assert abs(np.sum((np.conj(u - near) * webs.nearest(v)).real)) <= 1e-12


@given(ANY, SEED)
def test_the_support_is_no_less_than_any_that_is_alike_gains(
    group: tuple[tuple[int, ...], tuple[bool, ...]], seed: int
) -> None:
    """Analytic: and is reached by unit vectors towards it."""
    webs = alike(*group, seed)
    ones, none = np.ones(WEBS), np.zeros(WEBS)
    limits = Limits(ones, ones, np.ones(WEBS, bool), ones.astype(complex), none, ones, np.asarray(np.inf), webs)
    pull, u = points(seed, 2)
    support = limits.support(pull)
    inside = limits.into(u)
    assert np.sum((np.conj(pull) * inside).real) <= np.sum(support) + 1e-12
    towards = webs.nearest(pull)
    most = towards / np.abs(towards)
    assert np.allclose(webs.nearest(most), most, rtol=0, atol=1e-12)
    assert np.sum((np.conj(pull) * most).real) == pytest.approx(np.sum(support), rel=1e-12)


@given(SEED)
def test_the_program_in_fewer_unknowns_is_the_same(seed: int) -> None:
    """Analytic: every term, ceiling and mass."""
    webs = alike((0, 1, 0, 1, 0, 5), (False,) * WEBS, seed)
    random = np.random.default_rng(seed)
    ones, none = np.ones(WEBS), np.zeros(WEBS)
    limits = Limits(ones, 2 * ones, np.ones(WEBS, bool), ones.astype(complex), none, ones, np.asarray(9.0), webs)
    norms = Norms(points(seed, 1)[0][:2], random.normal(size=(2, WEBS)))
    caps = Ceilings(("c",), Norms(points(seed + 1, 1)[0][:1], random.normal(size=(1, WEBS))), np.ones(1), np.ones(1))
    whole = Statement(
        norms, np.zeros(2, int), np.zeros(1, int), np.zeros(1), caps, limits, Names((Term("c", "co"),) * 2, ("r",))
    )
    together = united(whole, webs)
    w = random.normal(size=3) + 1j * random.normal(size=3)
    u = apart(w, webs)
    assert together.objective(w) == pytest.approx(whole.objective(u), rel=1e-12)
    assert together.ceilings.excess(w) == pytest.approx(whole.ceilings.excess(u), rel=1e-9, abs=1e-12)
    assert together.mass(w) == pytest.approx(whole.mass(u), rel=1e-12)
    assert together.limits.max_mass.tolist() == [6.0, 4.0, 2.0]


@given(ANY, SEED)
def test_masses_and_angles_are_alike_to_the_last_digit(
    group: tuple[tuple[int, ...], tuple[bool, ...]], seed: int
) -> None:
    webs = alike(*group, seed)
    u = webs.nearest(points(seed, 1)[0])
    mass, angle = webs.fitted(np.abs(u), np.mod(np.degrees(np.angle(u)), 360.0))
    assert mass.tolist() == [mass[k] for k in webs.leader]
    assert np.all((angle >= 0) & (angle < 360))
    assert np.allclose(mass * direction(angle), u, rtol=0, atol=1e-12)


def test_some_of_the_webs_and_pieces_of_them() -> None:
    webs = alike((0, 1, 0, 1, 4, 5), (False, False, True, False, False, False), 3)
    some = webs.only(np.array([False, True, False, True, False, True]))
    assert some.leader == (0, 0, 2)
    parts = webs.pieces(np.array([0, 0, 1, 2, 2, 3, 4, 5]))
    assert parts.leader == (0, 1, 2, 0, 1, 2, 6, 7)
    assert parts.mirrored == (False, False, False, True, True, False, False, False)


@given(ANY, SEED, st.integers(0, WEBS - 1), st.floats(-3.0, 3.0))
def test_what_one_web_carries_in_a_direction_tells_those_of_all(
    group: tuple[tuple[int, ...], tuple[bool, ...]], seed: int, web: int, angle: float
) -> None:
    """Analytic: they are the directions of what is carried where that web carries something there."""
    webs = alike(*group, seed)
    exponential = np.exp(1j * webs.angles(web, angle))
    assert np.allclose(exponential[web], np.exp(1j * angle), rtol=0, atol=1e-12)
    assert np.allclose(webs.nearest(exponential), exponential, rtol=0, atol=1e-12)


@pytest.mark.parametrize("group", GROUPS)
def test_alike_webs_make_up_for_a_change_together(group: tuple[tuple[int, ...], tuple[bool, ...]]) -> None:
    """Analytic: the change is taken back, of two programs each by itself; what has no room stays."""
    webs = alike(*group, 5)
    random = np.random.default_rng(5)
    influence = random.normal(size=(2, 1, WEBS))
    room = random.uniform(0.5, 2.0, size=(2, webs.first.size))[:, webs.owner]
    room[1, webs.owner == 0] = 0.0
    ones, (u, moved) = np.ones(WEBS), (webs.nearest(points(seed, 2)) for seed in (6, 7))
    limits = Limits(ones, 100 * ones, ones > 0, ones + 0j, 0 * ones, ones, np.asarray(np.inf), webs)
    values = balanced(limits, influence, u, u + moved, room)
    assert np.allclose(webs.nearest(values), values, rtol=0, atol=1e-12)
    assert np.allclose(values[1, webs.owner == 0], (u + moved)[1, webs.owner == 0], rtol=0, atol=1e-12)
    assert np.allclose(np.sum(influence * (values - u)[:, None, :], axis=-1), 0.0, rtol=0, atol=1e-9)


@given(ANY, SEED)
def test_unknowns_of_webs_that_are_alike_are_within_their_sectors(
    group: tuple[tuple[int, ...], tuple[bool, ...]], seed: int
) -> None:
    """Analytic: the matrix makes of x and y of the first webs what the influence makes of R c (x + j y sin a)."""
    webs, random = alike(*group, seed), np.random.default_rng(seed)
    first, ones = webs.first, np.ones(WEBS)
    centre = direction(np.linspace(0.0, 50.0, WEBS))
    limits = Limits(ones, ones, np.zeros(WEBS, bool), centre, 0.8 * ones, 0.6 * ones, np.asarray(np.inf), webs)
    influence, reach = random.normal(size=(2, WEBS)), random.uniform(0.5, 2.0, WEBS)
    norms = Norms(np.zeros(2, complex), influence, scalar=(False, True))
    x, y = random.normal(size=(2, first.size))
    moved = influence @ webs.carried((reach * centre)[first] * (x + 0.6j * y))
    matrix = scaling._matrix(norms, SimpleNamespace(limits=limits), reach)  # type: ignore[arg-type]
    expected = [*moved.real, moved[0].imag, 0.0]
    np.testing.assert_allclose(matrix @ np.concatenate([x, y]), expected, rtol=1e-12, atol=1e-12)
