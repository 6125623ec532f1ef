"""Programs beside each other are as each alone, over two leading axes; and what a statement says, term by term."""

from collections.abc import Callable
from dataclasses import fields, replace
from typing import Any

import numpy as np
import pytest

from optimizer.numerics.arrays import Complex, mapped
from optimizer.program.certificate import (
    Multipliers,
    affine_minorant,
    best_proof,
    budget_price,
    ceiling_allowance,
    mass_lower_bound,
    normalised,
    objective_lower_bound,
    spread,
    tolerance_allowance,
)
from optimizer.program.misplacement import angle_corners, mass_corners, worst_by_angle, worst_by_mass
from optimizer.program.multipliers import resting_multipliers
from optimizer.program.norms import Norms
from optimizer.program.points import points_at
from optimizer.program.rows import combined, statement, weighted_peak
from optimizer.program.scaling import cancelling, natural_reach
from optimizer.program.sensitivity import shadow_prices
from optimizer.program.statement import Statement
from optimizer.program.verdict import claim, mass_resolution, verdict, yardstick
from tests.program.cases import random_limits, random_point, random_responses, random_statement, stacked

LEADING, WEBS = (2, 3), 4


def _program(seed: int, kind: str) -> Statement:
    """Four rows, of groups in twos where there are any; terms scatter, or are scalars, by the kind."""
    rng = np.random.default_rng(seed)
    limits = random_limits(rng, WEBS, sectors="sector" in kind, budget="budget" in kind)
    responses = [response for _ in range(2) for response in random_responses(rng, WEBS)]
    peaks = [weighted_peak(response, 1.0 + n, 1.0, 0.4) for n, response in enumerate(responses)]
    allowed = [(response, 2.0 + n) for n, response in enumerate(responses[:2])] if "ceiling" in kind else []
    actual_statement = statement(combined(peaks, "max"), allowed, limits)
    floor = rng.uniform(0.0, 0.5, actual_statement.floor.shape)
    norms = replace(
        actual_statement.norms,
        scatter=0.1 if "scatter" in kind else 0.0,
        scalar=tuple(n % 3 == 0 for n in range(actual_statement.row.size)) if "scalar" in kind else (),
    )
    group = np.array([0, 0, 1, 1]) if "group" in kind else actual_statement.group
    return replace(actual_statement, floor=floor, norms=norms, group=group)


def _multipliers(seed: int, program: Statement) -> Multipliers:
    rng = np.random.default_rng(seed)
    terms, ceilings = program.row.size, len(program.ceilings.names)
    vectors = rng.normal(size=(terms + ceilings, 2)) @ [1, 1j]
    return Multipliers(vectors[:terms], rng.normal(size=program.floor.size) + 0.7, vectors[terms:])


def _wide(arrays: Any) -> Any:
    return arrays.reshape(*LEADING, *arrays.shape[1:])


KINDS = (
    "plain",
    "sector, budget",
    "ceiling",
    "group",
    "scatter",
    "scalar, ceiling",
    "group, sector, budget, ceiling, scatter",
)
Function = Callable[[Statement, Complex, Multipliers], Any]


def _claimed(program: Statement, u: Complex, multipliers: Multipliers) -> Any:
    bound, mass = 0.9 * program.objective(u), program.mass(u)
    certificate = verdict(claim(program, u, mass, bound, multipliers, 0.7 * mass), 1e-2)
    return [
        certificate.lower_bound,
        certificate.gap,
        certificate.relative_gap,
        certificate.mass_lower_bound,
        certificate.mass_gap,
        certificate.mass_yardstick,
    ]


def _certified(program: Statement, u: Complex, multipliers: Multipliers) -> Any:
    usable, scale = normalised(program, multipliers)
    excess = np.abs(u[..., : len(program.ceilings.names)])
    return [
        objective_lower_bound(program, multipliers),
        mass_lower_bound(program, multipliers, program.objective(u)),
        *affine_minorant(program, multipliers),
        tolerance_allowance(program, multipliers),
        ceiling_allowance(program, multipliers, excess),
        *(budget_price(program, usable, cost) for cost in (0.0, 1.0)),
        usable.term, usable.row, usable.ceiling, scale, multipliers.price(program),
        best_proof(program, [multipliers, *resting_multipliers(program)])[0],
        spread(program, multipliers) + np.zeros(u.shape),
    ]  # fmt: skip


FUNCTIONS: dict[str, Function] = {
    "objective": lambda program, u, _: [
        program.objective(u), program.mass(u), program.rounding(u), program.at_rest, program.single_reach,
        program.rows(program.norms.sizes(u)), program.every_constant, program.every_influence,
    ],
    "limits": lambda program, u, _: [
        program.limits.reach, program.limits.most, program.limits.budget_ends, *program.limits.spent(np.abs(u)),
        *(support(3.0 * u) for support in (program.limits.into, program.limits.support, program.limits.opening)),
    ],
    "excess": lambda program, u, _: [
        program.ceilings.excess(u)[..., : max(1, len(program.ceilings.names))], points_at(program, u).excess,
        program.ceilings.tolerant_cap, program.ceilings.raised(0.1).cap,
    ],
    "certificate": _certified,
    "verdict": _claimed,
    "yardsticks": lambda program, u, _: [
        yardstick(program), mass_resolution(program, yardstick(program)[..., None]),
        natural_reach(program), cancelling(program), cancelling(program, 3),
    ],
    "shadow prices": lambda program, u, multipliers: list(
        vars(shadow_prices(program, u, normalised(program, multipliers)[0])).values()
    ),
    "misplacement": lambda program, u, _: [
        worst_by_mass(program.norms, u, 0.1), worst_by_angle(program.norms, u, 0.1),
        mass_corners(program.norms.influence * u[..., None, :]),
        angle_corners(program.norms.influence * u[..., None, :], 0.1),
    ],
}  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", FUNCTIONS)
def test_programs_together_are_as_each_alone(name: str, kind: str) -> None:
    alone = [_program(seed, kind) for seed in range(6)]
    points = [
        random_point(np.random.default_rng(seed), alone_statement.limits) for seed, alone_statement in enumerate(alone)
    ]
    proofs = [_multipliers(seed, alone_statement) for seed, alone_statement in enumerate(alone)]
    together = stacked(alone)
    wide = replace(
        together,
        norms=mapped(together.norms, _wide),
        floor=_wide(together.floor),
        ceilings=mapped(together.ceilings, _wide),
        limits=mapped(together.limits, _wide),
    )
    proof = Multipliers(
        *(_wide(np.stack(parts)) for parts in zip(*(vars(multipliers).values() for multipliers in proofs), strict=True))
    )
    function = FUNCTIONS[name]
    actual_function = function(wide, _wide(np.stack(points)), proof)
    functions = [function(*arguments) for arguments in zip(alone, points, proofs, strict=True)]
    assert len(actual_function) == len(functions[0]) > 0
    for part, expected in zip(actual_function, zip(*functions, strict=True), strict=True):
        single = np.stack([np.asarray(expectation) for expectation in expected])
        assert np.shape(part) == (*LEADING, *single.shape[1:])
        size = np.max(np.abs(single[np.isfinite(single)]), initial=0.0)
        np.testing.assert_allclose(np.reshape(part, single.shape), single, rtol=1e-10, atol=1e-12 * size)


@pytest.mark.parametrize("kind", KINDS)
def test_an_objective_is_its_definition(kind: str) -> None:
    """Independent: loops over groups, rows, terms and webs."""
    program = _program(7, kind)
    u = random_point(np.random.default_rng(1), program.limits)
    norms, rows = program.norms, program.floor.copy()
    for j, row in enumerate(program.row):
        vector = norms.constant[j] + sum(norms.influence[j, k] * u[k] for k in range(WEBS))
        part = vector.real if norms.scalar and norms.scalar[j] else vector
        rows[row] += abs(part) + norms.scatter * sum(abs(norms.influence[j, k] * u[k]) for k in range(WEBS))
    largest = [max(rows[program.group == group]) for group in range(program.group[-1] + 1)]
    assert program.objective(u) == pytest.approx(sum(largest), rel=1e-13)
    np.testing.assert_allclose(program.largest(rows), largest, rtol=1e-13)
    marked = program.where_largest(rows)
    assert [np.flatnonzero(marked[program.group == g]).tolist() for g in range(len(largest))] == [
        [int(np.argmax(rows[program.group == g]))] for g in range(len(largest))
    ]
    assert np.sum(marked) == len(largest)
    assert program.mass(u) == pytest.approx(sum(abs(u[k]) / program.limits.radius[k] for k in range(WEBS)), rel=1e-13)
    reach = [abs(c) / max(abs(h)) for c, h in zip(program.every_constant, program.every_influence, strict=True)]
    assert program.single_reach == pytest.approx(max(reach), rel=1e-13)


@pytest.mark.parametrize("order", ["in order", "out of order"])
def test_many_rows_are_summed_as_few(order: str) -> None:
    """Independent: a loop; terms of a row need not stand side by side."""
    rng = np.random.default_rng(3)
    program = _program(3, "plain")
    row = np.sort(np.concatenate([np.arange(10), rng.integers(0, 10, 6)]))
    row = row if order == "in order" else rng.permutation(row)
    norms = Norms(rng.normal(size=16) + 0j, rng.normal(size=(16, WEBS)))
    many = replace(program, norms=norms, row=row, group=np.zeros(10, int), floor=rng.uniform(size=(2, 10)))
    sizes = rng.uniform(size=(2, 16))
    expected = many.floor.copy()
    for j, owner in enumerate(row):
        expected[:, owner] += sizes[:, j]
    np.testing.assert_allclose(many.rows(sizes), expected, rtol=1e-14)


@pytest.mark.parametrize("kind", ["scatter", "group, scatter"])
def test_what_scatters_may_be_spelled_out(kind: str) -> None:
    """Property: the same objective everywhere, as terms of single webs; labels and kinds of terms go with them."""
    program = _program(5, kind)
    spelled = program.spelled()
    assert not spelled.norms.scatter
    for seed in range(3):
        u = random_point(np.random.default_rng(seed), program.limits)
        assert spelled.objective(u) == pytest.approx(program.objective(u), rel=1e-13)
    assert len(spelled.names.terms) == spelled.row.size == program.row.size + program.floor.size * WEBS
    assert [spelled.names.terms[j].response for j in range(spelled.row.size)] == [
        program.names.terms[int(np.flatnonzero(program.row == row)[0])].response for row in spelled.row
    ]
    assert _program(5, "plain").spelled().norms.scatter == 0.0


@pytest.mark.parametrize("kind", ["ceiling", "scalar, ceiling"])
def test_a_program_about_a_point_is_the_program_there(kind: str) -> None:
    """Property: what is added to a point comes to what the sum does."""
    program = _program(2, kind)
    points = np.array([random_point(np.random.default_rng(seed), program.limits) for seed in range(3)])
    step = 0.3 * points[::-1]
    about = program.about(points)
    np.testing.assert_allclose(about.objective(step), program.objective(points + step), rtol=1e-12)
    np.testing.assert_allclose(about.ceilings.excess(step), program.ceilings.excess(points + step), rtol=1e-12)


def test_the_program_of_the_excess_is_the_largest_excess() -> None:
    program = _program(4, "ceiling")
    u = random_point(np.random.default_rng(8), program.limits)
    excess = program.excess()
    assert excess.objective(u) == pytest.approx(np.max(program.ceilings.excess(u)), rel=1e-13)
    assert [term.response for term in excess.names.terms] == list(program.ceilings.names)
    assert excess.ceilings.names == ()


def test_one_program_is_the_only_one_of_an_axis() -> None:
    program = _program(4, "ceiling")
    alone, u = program.alone(), random_point(np.random.default_rng(8), program.limits)
    assert (alone.at_rest.tolist(), alone.single_reach.tolist()) == ([program.at_rest], [program.single_reach])
    assert alone.objective(u[None]).tolist() == [program.objective(u)]
    assert alone.subset(0).objective(u) == program.objective(u)


def test_some_webs_make_a_program_of_their_own() -> None:
    program = _program(4, "ceiling, budget")
    some = np.array([True, False, True, True])
    u = random_point(np.random.default_rng(8), program.limits) * some
    part = program.only(some)
    assert part.objective(u[some]) == pytest.approx(program.objective(u), rel=1e-14)
    assert part.mass(u[some]) == pytest.approx(program.mass(u), rel=1e-14)
    np.testing.assert_allclose(part.ceilings.excess(u[some]), program.ceilings.excess(u), rtol=1e-13)


def test_a_function_of_every_array_reaches_all_of_them() -> None:
    """Whatever fields parts of a statement have; what is no array stays as it is."""
    problem = random_statement(1, "sum", (1.0, 2.0), True, True, True, webs=3)
    limits = replace(problem.limits, marginal_radius=problem.limits.radius)
    for part in (problem.norms, problem.ceilings, limits):
        norms = part.mapped(np.copy)
        for field in fields(part):
            own, value = getattr(part, field.name), getattr(norms, field.name)
            assert (value is not own) == isinstance(own, np.ndarray | Norms), field.name
            if isinstance(own, np.ndarray):
                assert np.array_equal(value, own)
