"""The compiled entry that judges both stages does what its parts do one by one, to the last bit (independent)."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.numerics.arrays import Complex
from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.program.certificate import Multipliers, best_proof, mass_lower_bound
from optimizer.program.compiled_evaluation import Shares
from optimizer.program.methods.rounding import HEAVIER, RUNGS, has_dust, snap_to_limits
from optimizer.program.multipliers import resting_multipliers
from optimizer.program.points import Points, points_at
from optimizer.program.solution import CEILING_ROUNDING
from optimizer.program.statement import Statement
from tests.program.cases import random_point, stacked
from tests.program.test_leading_axes import WEBS, _multipliers
from tests.program.test_loops import KINDS, program

SHARES = Shares(1.0 - 1e-7, 1e-2, 1e-5, HEAVIER, CEILING_ROUNDING, CEILING_TOLERANCE)


def _separately(
    statement: Statement,
    share: float,
    demand: float,
    ends: list[Complex],
    dual: Multipliers,
    of_mass: Multipliers | None,
) -> list[Any]:
    """Of a program that is the only one of an axis: as the lightest optimum is defined."""
    lower, proof = best_proof(statement, [dual, *resting_multipliers(statement)])
    rest, first, light = (points_at(statement, u[None]) for u in (np.zeros(WEBS, complex), *ends))
    pair = first.excess <= CEILING_TOLERANCE, rest.excess <= CEILING_TOLERANCE
    if pair[0] and pair[1]:
        best = first if first.objective < rest.objective else rest
    else:
        best = first if pair[0] or (not pair[1] and first.excess < rest.excess) else rest
    target = np.maximum(best.objective, lower + SHARES.target * share - best.rounding)
    counted, chosen, bound = np.maximum(best.objective, lower) + share, best, np.zeros(1)
    if of_mass is not None:
        excess = min(max(float(light.excess[0]), CEILING_ROUNDING), CEILING_TOLERANCE)
        over, fall = light.objective - target + best.rounding, light.objective - best.objective
        points = [light, rest]
        if over > 0 and fall > over:
            points.insert(1, points_at(statement, light.unbalance + over / fall * (best.unbalance - light.unbalance)))
        for point in points:
            if point.mass < chosen.mass and point.objective <= target and point.excess <= excess:
                chosen = point
        bound = mass_lower_bound(statement, of_mass, counted)
    loose = demand > share and chosen.objective - lower <= demand
    certified = (loose or best.objective - lower <= SHARES.enough * share) and chosen.excess <= CEILING_ROUNDING
    if of_mass is not None:
        certified = certified and best.excess <= CEILING_ROUNDING
        certified = certified and chosen.mass - bound <= SHARES.mass_enough * chosen.mass
    most = target if of_mass is not None else lower + SHARES.enough * share
    final: Points = snap_to_limits(statement, chosen, most, bound if of_mass is not None else None)
    clean = ~has_dust(statement.limits, final.unbalance)
    return [best.unbalance, *final, *proof.parts, lower, bound, counted, np.array([certified]).reshape(1), clean]


@given(seeds=st.lists(st.integers(0, 10**6), min_size=1, max_size=3, unique=True), kind=KINDS, least=st.booleans())
def test_what_is_judged_together_is_what_is_judged_one_by_one(seeds: list[int], kind: Any, least: bool) -> None:
    programs = [program(seed, kind) for seed in seeds]
    # what is common to a batch is alike in all
    programs = programs if kind[2] is None else programs[:1]
    rng, count = np.random.default_rng(seeds), len(programs)
    whole = stacked(programs)
    at_rest = whole.at_rest
    share, demand = at_rest * rng.choice([1e-3, 0.3, 2.0], count), at_rest * rng.choice([1e-4, 1.0, 4.0], count)
    ends = [
        np.array([rng.choice([0.0, 0.3, 1.0]) * random_point(rng, statement.limits) for statement in programs])
        for _ in range(2)
    ]
    duals = [
        [_multipliers(seed + more, statement) for seed, statement in zip(seeds, programs, strict=False)]
        for more in (0, 1)
    ]
    proof, of_mass = (
        Multipliers(*(np.stack(parts) for parts in zip(*(multiplier.parts for multiplier in some), strict=True)))
        for some in duals
    )
    judgement = whole.flat.judge(
        share,
        demand,
        whole.constant_sizes,
        SHARES,
        (ends[0], ends[1]),
        proof.parts,
        of_mass.parts if least else None,
        RUNGS,
    )
    for n, first_program in enumerate(programs):
        expected = _separately(
            first_program.alone(),
            share[n],
            demand[n],
            [end[n] for end in ends],
            _alone(proof, n),
            _alone(of_mass, n) if least else None,
        )
        mine = [judgement.smallest, judgement.unbalance, *judgement.figures, *judgement.proof, *judgement[4:]]
        for part, second in zip(mine, expected, strict=True):
            np.testing.assert_array_equal(part[n], np.reshape(second, part[n : n + 1].shape)[0])


def _alone(several: Multipliers, n: int) -> Multipliers:
    return several.subset(np.array([n]))


@pytest.mark.parametrize("least", [False, True])
def test_a_point_that_is_no_number_is_not_taken(least: bool) -> None:
    """Analytic: rest is what is left, and nothing heavier is certified."""
    statement = program(4, (False, {"ceiling"}, None))
    actual_statement, dual = statement.alone(), tuple(part[None] for part in _multipliers(1, statement).parts)
    nowhere, first = np.full((1, WEBS), np.nan + 0j), np.ones(1)
    judgement = actual_statement.flat.judge(
        first, first, actual_statement.constant_sizes, SHARES, (nowhere, nowhere), dual, dual if least else None, RUNGS
    )
    assert not np.any(judgement.smallest)
    assert not np.any(judgement.unbalance)
    assert judgement.figures[0] == pytest.approx(actual_statement.at_rest)
