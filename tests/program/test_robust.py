"""Programs of several cases, and of counterweights that scatter: what they reach and what they prove."""

from dataclasses import replace

import cvxpy as cp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from optimizer.numerics.arrays import Complex
from optimizer.program.cuts.cut import Scatter
from optimizer.program.cuts.dominance import Group
from optimizer.program.cuts.misplacement import largest_last_goals
from optimizer.program.cuts.optimum import CertifiedOptimum, Conflict, over_turn
from optimizer.program.cuts.semi_infinite import Goal, Problem
from optimizer.program.limits import Limits
from optimizer.program.misplacement import Norms, angle_corners, mass_corners, worst_by_angle, worst_by_mass
from optimizer.program.rows import Row, weighted_peak
from optimizer.responses.response import Phasors, Response
from tests.program.cases import random_limits, random_point
from tests.program.turning import bearings, wide


def responses(rng: np.random.Generator, webs: int, scenario: str | None) -> list[Response]:
    """A force and a moment."""
    quantities = []
    for name, influence in (("force", np.ones(webs)), ("moment", rng.uniform(-1, 1, webs))):
        co, counter = rng.normal(size=(2, 2)) @ [1, 1j]
        pair = Phasors(np.asarray(co), np.asarray(counter))
        quantities.append(Response(name, "N", pair, influence, scenario=scenario))
    return quantities


def several(seed: int, cases: int = 3, webs: int = 4, limits: Limits | None = None) -> Problem:
    """The largest, over some cases, of the peak force plus the peak moment, each a group by itself."""
    rng = np.random.default_rng(seed)
    every = [responses(rng, webs, str(case)) for case in range(cases)]
    groups = tuple(
        Group(rows=(Row(response.name, (weighted_peak(response, 1.0),)),)) for case in every for response in case
    )
    goal = Goal("all", groups, cases=tuple(n for n, case in enumerate(every) for _ in case))
    return Problem((), (goal,), (), (), random_limits(rng, webs, bool(seed % 2), False) if limits is None else limits)


def best(program: Problem, least_mass: bool = False, gap: float = 1e-6) -> CertifiedOptimum:
    optimum = over_turn(program, gap, least_mass)
    assert isinstance(optimum, CertifiedOptimum)
    return optimum


def modelled(program: Problem) -> float:
    """Independent: the same program in the modelling layer, with the scatter as a term of its own."""
    limits, scatter = program.limits, program.scatter
    webs = limits.radius.size
    u = cp.Variable(webs, complex=True)
    sums: dict[int, list[cp.Expression]] = {}
    for group, case in zip(program.groups, program.case_of.tolist(), strict=True):
        rows = []
        for row in group.rows:
            total = 0.0
            for peak in row.peaks:
                off = np.abs(peak.norms.influence[0])
                total = total + peak.floor + cp.abs(peak.norms.constant[0] + peak.norms.influence[0] @ u)
                total = total + scatter.share * off @ cp.abs(u) + scatter.unbalance * np.sum(off)
            rows.append(total)
        sums.setdefault(case, []).append(cp.maximum(*rows, rows[0]))
    turned = cp.multiply(np.conj(limits.centre), u)
    across = cp.multiply(limits.half_angle_cos, cp.abs(cp.imag(turned)))
    within = across - cp.multiply(limits.half_angle_sin, cp.real(turned)) <= np.where(limits.free, 1e3, 0.0)
    rules = [cp.abs(u) / limits.radius <= limits.max_mass, within]
    goal = cp.max(cp.hstack([cp.sum(cp.hstack(single_sum)) for single_sum in sums.values()]))
    return float(cp.Problem(cp.Minimize(goal), rules).solve(solver=cp.CLARABEL))


@pytest.mark.parametrize("share", [0.0, 0.05])
@pytest.mark.parametrize("seed", range(4))
def test_the_largest_of_sums_is_what_the_modelling_layer_finds(seed: int, share: float) -> None:
    program = replace(several(seed), scatter=Scatter(share, 0.02 if share else 0.0))
    optimum, rest = best(program), float(program.yardsticks[0])
    assert optimum.proof.bound == pytest.approx(modelled(program), abs=1e-6 * rest)
    assert optimum.goals[-1].value - optimum.proof.bound <= 1e-6 * rest


@settings(max_examples=15)
@given(seed=st.integers(0, 10**6), share=st.sampled_from([0.0, 1e-6, 0.03, 3.0]), turn=st.booleans())
def test_no_point_is_below_the_bound_whatever_errors_it_suffers(seed: int, share: float, turn: bool) -> None:
    """What is proven of the worst case holds for the worst case of every point, and of no point is more found."""
    rng = np.random.default_rng(seed)
    program = bearings(seed, count=3, webs=3, measure="rms" if seed % 3 == 0 else "peak") if turn else several(seed)
    program = replace(program, scatter=Scatter(share, 0.01))
    optimum = best(program, least_mass=True, gap=1e-4)
    exact = replace(program, scatter=Scatter())
    assert optimum.proof.bound <= optimum.point.values.goals[-1] * (1 + 1e-12)
    for _ in range(4):
        u = random_point(rng, program.limits)
        worst = float(program.values(u, 1e-9).goals[0])
        assert optimum.proof.bound <= worst * (1 + 1e-12)
        off = _errors(rng, u, program.scatter)
        assert float(exact.values(u + off, 1e-9).goals[0]) <= worst * (1 + 1e-9)


def _errors(rng: np.random.Generator, u: Complex, scatter: Scatter) -> Complex:
    """Errors of the largest size that is allowed, in any direction."""
    turns = np.exp(1j * rng.uniform(0, 2 * np.pi, (2, u.size)))
    return scatter.share * np.abs(u) * turns[0] + scatter.unbalance * turns[1]


def test_one_norm_comes_to_what_is_said_at_worst() -> None:
    """Analytic: |1 + u| + share |u| is least at u = -1, where the share remains, or at rest if that is above 1."""
    response = Response("force", "N", Phasors(np.asarray(1.0 + 0j), np.asarray(0j)), np.ones(1))
    program = Problem(
        (), (Goal("all", (Group(rows=(Row("force", (weighted_peak(response, 1.0),)),)),)),), (), (), wide(1)
    )
    for share, at, share_off in ((0.0, -1.0, 0.0), (0.1, -1.0, 0.1), (0.99, -1.0, 0.99), (1.5, 0.0, 1.0)):
        optimum = best(replace(program, scatter=Scatter(share)))
        assert optimum.goals[-1].value == pytest.approx(share_off, abs=1e-6)
        assert optimum.point.unbalance[0] == pytest.approx(at, abs=2e-6)


@pytest.mark.parametrize("share", [1e-9, 0.035])
def test_webs_without_limit_have_a_reach_within_which_the_worst_case_is_as_good(share: float) -> None:
    """Metamorphic: without a limit nothing is better than with one of ten times the mass that is needed."""
    near = replace(several(3, limits=wide(4, 60.0)), scatter=Scatter(share))
    far = replace(near, limits=replace(near.limits, max_mass=np.full(4, np.inf)))
    first, second = best(near), best(far)
    rest = float(near.yardsticks[0])
    assert np.all(np.isfinite(second.limits.max_mass))
    assert second.goals[-1].value == pytest.approx(first.goals[-1].value, abs=1e-6 * rest)
    if share > 1e-3:
        assert second.goals[-1].value - second.proof.bound <= 1e-6 * rest


def test_ceilings_hold_in_the_worst_case() -> None:
    """Analytic: |1 + u| + |u|/10 <= 0.3 is kept from u = -7/9 on; at most 0.09 cannot be."""
    response = Response("force", "N", Phasors(np.asarray(1.0 + 0j), np.asarray(0j)), np.ones(1), scenario="hot")
    goal = Goal("all", (Group(rows=(Row("force", (weighted_peak(response, 1.0),)),)),))
    problem = Problem((), (goal,), ((response, 0.3),), (), wide(1), Scatter(0.1))
    free = replace(response, baseline=Phasors(np.asarray(0j), np.asarray(2.0 + 0j)))
    still = Goal("all", (Group(rows=(Row("force", (weighted_peak(replace(free, influence=np.zeros(1)), 1.0),)),)),))
    optimum = best(replace(problem, goals=(still,)), least_mass=True)
    assert optimum.point.unbalance[0] == pytest.approx(-7 / 9, abs=1e-6)
    assert optimum.mass_proof is not None
    assert optimum.mass_proof.bound == pytest.approx(7 / 9 / 0.2, rel=1e-5)
    unkept = over_turn(replace(problem, ceilings=((response, 0.09),)), 1e-6, True)
    assert isinstance(unkept, Conflict)
    assert unkept.proof.statement.names.terms[0].scenario == "hot"


@pytest.mark.parametrize("webs", [0, 1, 3, 8])
def test_the_worst_of_all_counterweights_off_together(webs: int) -> None:
    """Independent: every corner of the errors of mass; of the angle a fine search over the direction."""
    rng = np.random.default_rng(webs)
    norms = Norms(rng.normal(size=(3, 2)) @ [1, 1j], rng.normal(size=(3, webs)))
    u = rng.normal(size=(webs, 2)) @ [1, 1j]
    signs = np.array(np.meshgrid(*[[-1.0, 1.0]] * webs)).reshape(webs, -1).T if webs else np.zeros((1, 0))
    worst = np.max([np.abs(norms.at(u * (1 + 0.3 * sign))) for sign in signs], axis=0)
    assert worst_by_mass(norms, u, 0.3) == pytest.approx(worst, rel=1e-12)
    corners = mass_corners(norms.influence * u)
    assert np.max(np.abs(norms.at(u)[:, None] + 0.3 * corners), axis=-1) == pytest.approx(worst, rel=1e-12)
    for angle in np.deg2rad([1.0, 25.0]):
        towards = np.linspace(-np.pi, np.pi, 20001)
        vectors = norms.influence * u
        off = np.mod(towards[:, None, None] - np.angle(vectors) + np.pi, 2 * np.pi) - np.pi
        reached = (np.exp(-1j * towards)[:, None] * norms.constant).real
        reached = reached + np.sum(np.abs(vectors) * np.cos(np.maximum(np.abs(off) - angle, 0.0)), axis=-1)
        assert worst_by_angle(norms, u, angle) == pytest.approx(np.max(reached, axis=0), rel=1e-6)
        outline = np.abs(norms.at(u)[:, None] + angle_corners(vectors, angle)) if webs else np.zeros((3, 1))
        about = np.max(outline, axis=-1)
        assert np.all((about >= worst_by_angle(norms, u, angle) * (1 - 1e-12)) | (webs == 0))


@pytest.mark.parametrize("towards", [(0.0, np.pi), (np.pi, 0.0), (-0.0, -np.pi), (0.0, 0.0), (-np.pi, np.pi)])
def test_counterweights_along_the_axis_are_turned_like_all_others(towards: tuple[float, float]) -> None:
    """Analytic: what two opposite vectors and a third that cancels them come to, whichever way their angles round."""
    vectors = np.array([3.0, 1.0]) * np.exp(1j * np.array(towards))
    vectors.imag = [np.copysign(0.0, np.sin(angle)) for angle in towards]
    norms = Norms(np.array([-np.sum(vectors)]), np.ones((1, 2)))
    # both are turned across the axis, either way
    assert worst_by_angle(norms, vectors, 0.01) == pytest.approx(4.0 * 2 * np.sin(0.005), rel=1e-3)


@pytest.mark.parametrize("turning", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_loads_over_the_turn_are_no_worse_than_is_said(seed: int, turning: bool) -> None:
    """Independent: errors of every counterweight, random or all at their largest, where some turn by themselves too."""
    rng = np.random.default_rng(seed)
    program = bearings(seed, count=3, webs=3)
    if turning:
        turned = np.array([0.0, -2.0, 1.0])
        moved = (
            replace(quantity, response=replace(quantity.response, turning=turned)) for quantity in program.quantities
        )
        program = replace(program, quantities=tuple(moved))
    u = random_point(rng, program.limits)
    angle, share = 0.1, 0.05
    by_angle, by_mass = largest_last_goals(program, u, program.values(u, 1e-9).reached, angle, share)
    for _ in range(24):
        errors = np.sign(rng.normal(size=3)) * rng.choice([1.0, rng.uniform()])
        assert float(program.values(u * (1 + share * errors), 1e-9).goals[-1]) <= by_mass * (1 + 1e-9)
        assert float(program.values(u * np.exp(1j * angle * errors), 1e-9).goals[-1]) <= by_angle * (1 + 1e-9)
