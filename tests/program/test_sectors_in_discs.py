"""The interior point for discs under sectors, budgets and ceilings, against the method for any limits and clarabel."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.program.ceilings import no_ceilings
from optimizer.program.kernel import disc_matrix, disc_peaks, disc_starts, disc_webs, discs
from optimizer.program.kernel.finer_numbers import interpreted
from optimizer.program.limits import Limits
from optimizer.program.methods import compiled
from optimizer.program.methods.compiled import StageSolutions, stage_solutions
from optimizer.program.methods.disc_programs import disc_stages, discs_of, suits_discs
from optimizer.program.methods.optima import optima
from optimizer.program.methods.stage_ends import solve_stages
from optimizer.program.reference.solver import smallest_objective
from optimizer.program.rows import combined, statement, weighted_peak
from optimizer.program.statement import Statement
from optimizer.program.verdict import yardstick
from optimizer.responses.response import Phasors, Response
from tests.program.cases import COMBINATIONS, random_statement, stacked

#: sums alone: the largest of peaks is for the method for any limits
SUMS = tuple(case for case in COMBINATIONS if case[0] == "sum")


def share(problem: Statement) -> np.ndarray:
    return 1e-6 * np.atleast_1d(yardstick(problem))


def in_discs(problem: Statement) -> StageSolutions:
    """Without help: of what is not proven nothing is certified."""
    part = share(problem)
    solved = solve_stages(problem, part, True, compiled._DOUBLE, disc_stages)
    return compiled._judged(problem, part, part, True, solved)


@given(seed=st.integers(0, 10**6), case=st.sampled_from(SUMS))
def test_both_methods_and_clarabel_find_the_same_optimum(seed: int, case: tuple) -> None:
    """Independent: neither point is below a bound of another, and certified masses agree as far as they are proven."""
    problem = random_statement(seed, *case).alone()
    assert suits_discs(problem).all()
    part, unit = share(problem), float(yardstick(problem)[0])
    quick, general = in_discs(problem), compiled._general(problem, part, part, True, np.zeros(1))
    reference = smallest_objective(problem.subset(0), 1e-10 * unit)
    room = (1e-12 + 2e-8 * bool(problem.ceilings.names)) * unit
    assert quick.lower_bound[0] <= reference.objective + room
    if quick.certified[0]:
        assert reference.lower_bound <= quick.objective[0] + room
        if general.certified[0]:
            assert (
                max(quick.lower_bound[0], general.lower_bound[0])
                <= min(quick.objective[0], general.objective[0]) + room
            )
            assert max(quick.mass_lower_bound[0], general.mass_lower_bound[0]) <= min(
                quick.mass[0], general.mass[0]
            ) * (1 + 1e-5) + 1e-9 * float(problem.limits.most.sum())
    u = quick.unbalance[0]
    np.testing.assert_allclose(problem.subset(0).limits.into(u), u, rtol=1e-12, atol=1e-15)


def test_most_random_programs_need_no_other_method() -> None:
    """Regression: fewest where webs stand at the edges of narrow sectors under a budget, two thirds."""
    means = {case: float(np.mean(in_discs(_batch(case)).certified)) for case in SUMS}
    assert min(means.values()) >= 0.4
    assert np.mean(list(means.values())) >= 0.75


def _batch(case: tuple) -> Statement:
    return stacked([random_statement(seed, *case, webs=4) for seed in range(40)])


@pytest.mark.parametrize("case", SUMS)
def test_no_answer_is_worse_for_the_method_for_discs(case: tuple) -> None:
    """Metamorphic: what the method for any limits certifies by itself is certified."""
    batch = _batch(case)
    part = share(batch)
    stages, general = stage_solutions(batch, part, part, True), compiled._general(batch, part, part, True, 0.0 * part)
    assert not np.any(general.certified & ~stages.certified)


# ---- programs that can be solved by hand


def single(half_angle_deg: float, centre_deg: float, largest: float, budget: float = np.inf) -> Statement:
    """20 kg m along x; one web of 1 m radius in its plane."""
    half, towards = np.radians(half_angle_deg), np.exp(1j * np.radians(centre_deg))
    ones = np.ones(1)
    limits = Limits(
        radius=ones,
        max_mass=largest * ones,
        free=np.zeros(1, bool),
        centre=towards * ones,
        half_angle_cos=np.cos(half) * ones,
        half_angle_sin=np.sin(half) * ones,
        max_total_mass=np.asarray(budget),
    )
    force = Response("force", "N", Phasors(np.asarray(20.0 + 0j), np.asarray(0j)), ones)
    return statement(combined([weighted_peak(force, 1.0)], "sum"), [], limits)


@pytest.mark.parametrize(
    ("half_angle", "centre", "largest", "budget", "objective"),
    [
        # straight opposite, more than enough
        (30.0, 180.0, 50.0, np.inf, 0.0),
        # not enough, by its limit or by the budget
        (30.0, 180.0, 5.0, np.inf, 15.0),
        (30.0, 180.0, 50.0, 5.0, 15.0),
        # the nearest edge is 60 degrees off: what is left is across it
        (30.0, 90.0, 50.0, np.inf, 20.0 * np.sin(np.radians(60.0))),
        # away from the unbalance: nothing is better than nothing
        (30.0, 0.0, 50.0, np.inf, 20.0),
        (30.0, 0.0, 50.0, 5.0, 20.0),
        # half a disc, whose edges are one line
        (90.0, 135.0, 50.0, np.inf, 0.0),
        (90.0, 90.0, 5.0, np.inf, 15.0),
    ],
)
def test_one_web(half_angle: float, centre: float, largest: float, budget: float, objective: float) -> None:
    """Analytic: the nearest point of a sector."""
    problem = single(half_angle, centre, largest, budget).alone()
    bound = optima(problem, 1e-6, True)
    assert bound.objective[0] == pytest.approx(objective, abs=1.1e-6 * 20.0)
    assert bound.lower_bound[0] <= objective + 1e-12
    # on an edge that leads 60 degrees off, half of it is along; it may stop short by sqrt(2 * 17.3 * 2e-5)
    lightest = {0.0: 20.0, 15.0: 5.0}.get(objective, 10.0 if objective < 20.0 else 0.0)
    assert bound.mass[0] == pytest.approx(lightest, abs=0.03)


def test_a_budget_of_nothing_leaves_nothing() -> None:
    """Analytic: beside programs that have one, which it does not disturb."""
    rest = single(30.0, 180.0, 50.0, 5.0)
    nothing = replace(rest, limits=replace(rest.limits, max_total_mass=np.asarray(0.0)))
    both = stage_solutions(stacked([nothing, rest]), *[share(rest).repeat(2)] * 2, True)
    alone = in_discs(rest.alone())
    assert both.objective.tolist() == [20.0, alone.objective[0]]
    assert both.mass[0] == 0.0


@pytest.mark.parametrize("room", [1e-3, 1e-6, 1e-9, 0.0])
def test_a_ceiling_that_can_just_be_kept(room: float) -> None:
    """Analytic: on the force, which the budget can bring to 15; the moment pulls the same web the other way."""
    base = single(90.0, 180.0, 50.0, 5.0)
    force, moment = (
        Response(name, "N", Phasors(np.asarray(value + 0j), np.asarray(0j)), np.ones(1))
        for name, value in (("force", 20.0), ("moment", -3.0))
    )
    problem = statement(
        combined([weighted_peak(force, 0.01), weighted_peak(moment, 1.0)], "sum"), [(force, 15.0 + room)], base.limits
    )
    actual_optima = optima(problem.alone(), 1e-6, True)
    assert not actual_optima.unreachable[0]
    assert actual_optima.excess[0] <= 1e-9
    # the web carries 5 - room, and at most what the ceiling leaves
    assert actual_optima.mass[0] == pytest.approx(5.0 - room, abs=1e-5)


def test_a_ceiling_that_rest_keeps_and_the_optimum_does_not() -> None:
    """Analytic: on the moment, 3 without a counterweight, which a kilogram against the force raises by 1."""
    base = single(90.0, 180.0, 50.0, 5.0)
    force, moment = (
        Response(name, "N", Phasors(np.asarray(value + 0j), np.asarray(0j)), np.ones(1))
        for name, value in (("force", 20.0), ("moment", -3.0))
    )
    peaks = combined([weighted_peak(force, 1.0), weighted_peak(moment, 0.01)], "sum")
    for ceiling, load in ((4.0, 1.0), (7.5, 4.5), (8.5, 5.0)):
        bound = optima(statement(peaks, [(moment, ceiling)], base.limits).alone(), 1e-6, True)
        assert bound.excess[0] <= 0.0
        assert bound.mass[0] == pytest.approx(load, abs=1e-4)
        assert bound.objective[0] - bound.lower_bound[0] <= 1e-6 * (20.0 + 0.03)
        # one that is not met has no price
        assert bool(np.any(bound.multipliers.ceiling)) == (ceiling < 8.0)


@pytest.mark.parametrize("case", SUMS)
def test_ceilings_that_no_optimum_meets_change_nothing(case: tuple) -> None:
    """Analytic: beside programs whose ceilings are met."""
    problem = stacked([random_statement(seed, *case, webs=4) for seed in range(12)])
    if not problem.ceilings.names:
        return
    none = replace(problem, ceilings=no_ceilings(problem.floor.shape[:-1], 4))
    far = replace(problem, ceilings=replace(problem.ceilings, cap=problem.ceilings.cap + 1e6 * problem.ceilings.size))
    part, without = share(none), in_discs(none)
    cap = np.where(np.arange(12)[:, None] % 2 == 0, far.ceilings.cap, problem.ceilings.cap)
    both = stage_solutions(replace(problem, ceilings=replace(problem.ceilings, cap=cap)), part, part, True)
    alike = without.certified & (np.arange(12) % 2 == 0)
    assert np.count_nonzero(alike) > 1
    np.testing.assert_allclose(both.objective[alike], without.objective[alike], rtol=1e-6)
    np.testing.assert_allclose(both.mass[alike], without.mass[alike], rtol=2e-5)
    assert both.certified[alike].all()
    # of those that end well without them, which are most
    assert np.mean(np.any(both.multipliers.ceiling[alike], axis=-1)) < 0.5


# ---- which programs it takes, and in which form


def test_thin_sectors_are_for_the_method_for_any_limits() -> None:
    angles = [1e-9, 0.05, 0.06, 90.0]
    taken = suits_discs(stacked([single(angle, 180.0, 5.0) for angle in angles]))
    assert taken.tolist() == [False, False, True, True]


def test_any_optimum_is_left_to_the_lighter_of_both_methods() -> None:
    """Regression: without the least mass this one's were up to three times as heavy in a search over fitted webs."""
    nothing = (False, False, False)
    for sectors, budget, ceilings in (nothing, (True, False, False), (False, True, False), (False, False, True)):
        taken = (sectors, budget, ceilings) == nothing
        problem = random_statement(3, "sum", (1.0, 1.0), sectors, budget, ceilings, webs=4).alone()
        assert suits_discs(problem, least_mass=False).tolist() == [taken]
        assert suits_discs(problem).all()


def test_vectors_of_three_responses_are_for_the_method_for_any_limits() -> None:
    """Analytic: the third is a sum of the others, and no multiple of one."""
    problem = random_statement(3, "sum", (1.0, 1.0), False, False, True, webs=4)
    assert suits_discs(problem.alone()).all()
    norms = problem.ceilings.norms
    mixed = replace(norms, influence=np.stack([norms.influence[0], norms.influence.sum(axis=0)]))
    assert not suits_discs(replace(problem, ceilings=replace(problem.ceilings, norms=mixed)).alone()).any()
    third = replace(problem.ceilings, names=("force", "torque"))
    assert not suits_discs(replace(problem, ceilings=third).alone()).any()


def test_programs_of_different_form_are_solved_apart() -> None:
    """Property: sectors or not, a budget that binds or not; all come back in their order."""
    problems = [
        random_statement(seed, "sum", (1.0, 1.0), sectors, budget, False, webs=4)
        for seed, (sectors, budget) in enumerate([(True, True), (False, False), (True, False), (False, True)])
    ]
    batch = stacked([problems[k] for k in (0, 1, 2, 3, 0)])
    reach, unit = np.minimum(batch.limits.reach, 10.0), np.ones(5)
    forms = discs_of(batch, reach, unit, 0.0)
    assert [np.ravel(indices).tolist() for indices, _, _ in forms] == [[1], [3], [2], [0, 4]]
    assert [budgeted for _, budgeted, _ in forms] == [False, True, False, True]
    ((indices, budgeted, _),) = discs_of(batch.subset(np.array([0, 4])), reach[:2], unit[:2], 0.0)
    assert indices is None
    assert budgeted
    together = in_discs(batch)
    for n, k in enumerate((0, 1, 2, 3, 0)):
        assert np.array_equal(together.unbalance[n], in_discs(problems[k].alone()).unbalance[0])


# ---- the step


def _names(part: Any) -> set[str]:
    return {name for name, value in vars(part).items() if type(value) is int}


def test_no_name_stands_for_two_places() -> None:
    """Both parts are interpreted in one space of names to be counted, where a second meaning would go unseen."""
    shared = _names(disc_webs) & _names(disc_peaks)
    assert all(getattr(disc_webs, name) == getattr(disc_peaks, name) for name in shared)


def _steps(problem: Statement) -> Iterator[tuple[dict[str, Any], dict[str, Any], dict[str, Any], tuple[bool, bool]]]:
    """The numbers of webs, edges and program at each step of the first program, interpreted in one lane."""
    space = interpreted(np, parts=(disc_webs, disc_peaks, disc_matrix, disc_starts, discs))  # type: ignore[arg-type]
    for part in (disc_webs, disc_peaks):
        for name in _names(part):
            space[name] = getattr(part, name) // disc_webs.LANES
    taken, step_webs, step_peaks = [], space["step_webs"], space["step_peaks"]
    webs_of: dict[str, Any] = {}

    def webs(sized: bool, count: int, web: np.ndarray, edge: np.ndarray | None, own: np.ndarray) -> None:
        step_webs(sized, count, web, edge, own)
        webs_of.update(web=web.reshape(count, -1), edge=None if edge is None else edge.reshape(count, -1))

    def peaks(least: bool, budgeted: bool, terms: int, basis: np.ndarray, peak: np.ndarray, own: np.ndarray) -> None:
        step_peaks(least, budgeted, terms, basis, peak, own)
        web, edge = webs_of["web"], webs_of["edge"]
        of_web = {name: web[:, space[name]].copy() for name in _OF_WEB}
        of_edge = {name: edge[:, space[name]].copy() for name in _OF_EDGE}
        of_own = {name: float(own[space[name]]) for name in _OF_OWN}
        of_own["DW"] = own[space["DW"] :][:4].copy()
        taken.append((of_web, of_edge, of_own, (least, budgeted)))

    space["step_webs"], space["step_peaks"] = webs, peaks
    actual_statement = problem.alone()
    reach, unit = np.minimum(actual_statement.limits.reach, 10.0), np.ones(1)
    ((_, budgeted, programs),) = discs_of(actual_statement, reach, unit, 0.0)
    with np.errstate(all="ignore"):
        space["solve"](*programs, budgeted, True, np.full(1, 1e-6), np.full(1, 1e-9), 1e-6)
    yield from taken


_OF_WEB = ("H1", "H2", "COST", "VX", "VY", "X", "Z", "PX", "PY", "R0", "RX", "RY", "RQ")
_OF_WEB += ("DVX", "DVY", "DX", "DZ", "DPX", "DPY")
_OF_EDGE = ("N1X", "N1Y", "N2X", "N2Y", "E1", "E2", "G1", "G2", "Q1", "Q2", "DE1", "DE2", "DG1", "DG2")
_OF_OWN = ("BUDGET", "D_BUDGET", "LEFT", "R_LEFT")


@pytest.mark.parametrize("budget", [False, True])
def test_a_step_solves_the_linearised_equations(budget: bool) -> None:
    """Analytic: of cones, edges, sizes and the budget, while slacks are far above rounding."""
    problem = random_statement(1, "sum", (1.0, 1.0), True, budget, True, webs=4)
    for web, edge, own, (least, budgeted) in list(_steps(problem))[:6]:
        v, dv = web["VX"] + 1j * web["VY"], web["DVX"] + 1j * web["DVY"]
        p, dp = web["PX"] + 1j * web["PY"], web["DPX"] + 1j * web["DPY"]
        x, z, dx, dz, cost = web["X"], web["Z"], web["DX"], web["DZ"], web["COST"]
        r, d_price = web["RX"] + 1j * web["RY"], own["D_BUDGET"]
        sizes = z * (x * dz + z * dx + _dot(v, dp) + _dot(p, dv)) - web["R0"] - _dot(p, r)
        vectors = x * dp + v * dz + z * dv + p * dx - r
        normals = edge["N1X"] + 1j * edge["N1Y"], edge["N2X"] + 1j * edge["N2Y"]
        # the multipliers' steps and right sides are over the multipliers
        turned = edge["G1"] * edge["DG1"] * normals[0] + edge["G2"] * edge["DG2"] * normals[1]
        moved = web["H1"] * (own["DW"][0] + 1j * own["DW"][1]) + web["H2"] * (own["DW"][2] + 1j * own["DW"][3])
        off = [sizes, vectors, dp + moved + turned]
        for e, n in zip("12", normals, strict=True):
            slack, grip = edge[f"E{e}"], edge[f"G{e}"]
            change = slack * (edge[f"DG{e}"] - edge[f"Q{e}"]) + edge[f"DE{e}"]
            off += [grip * change, edge[f"DE{e}"] - _dot(n, dv)]
        if least or budgeted:
            off.append((1.0 - x) * (dz - cost * d_price) - (z - own["BUDGET"] * cost) * dx - web["RQ"])
        if budgeted:
            spent = own["BUDGET"] * np.sum(cost * dx)
            off.append(np.array([own["LEFT"] * d_price - spent - own["R_LEFT"]]))
        assert max(float(np.max(np.abs(distances))) for distances in off) <= 1e-12


def _dot(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    return np.real(first * np.conj(second))
