"""Ceilings on components as discs: what keeps the ones keeps the others."""

from dataclasses import replace

import numpy as np
import pytest

from optimizer.program.methods.discs import in_discs
from optimizer.program.norms import Norms
from optimizer.program.rows import combined, statement, weighted_peak
from optimizer.program.statement import Statement
from tests.program.cases import random_limits, random_responses


def along_axes(caps: list[float]) -> tuple[Statement, np.ndarray, np.ndarray]:
    """A program with ceilings on as many components, the largest unbalances, and some within them."""
    rng = np.random.default_rng(3)
    webs = 4
    force, moment = random_responses(rng, webs)
    limits = random_limits(rng, webs, sectors=False, budget=False)
    whole = statement(combined([weighted_peak(force, 1.0)], "sum"), [(moment, cap) for cap in caps], limits)
    towards = np.exp(1j * rng.uniform(0.0, 2.0 * np.pi, len(caps)))
    norms = whole.ceilings.norms
    scalar = Norms(towards * norms.constant, towards[:, None] * norms.influence, scalar=(True,) * len(caps))
    whole = replace(whole, ceilings=replace(whole.ceilings, norms=scalar, cap=np.array(caps)))
    u = rng.uniform(0.0, 1.0, (2000, webs)) * np.exp(1j * rng.uniform(0.0, 2.0 * np.pi, (2000, webs))) * limits.reach
    return whole, limits.reach, u


@pytest.mark.parametrize("caps", [[0.5, 2.0], [1e7, 1.0], [1e12, 1e15]])
def test_discs_hold_what_is_between_the_lines(caps: list[float]) -> None:
    """Metamorphic: by vectors within reach, also under ceilings far above what these come to."""
    whole, reach, u = along_axes(caps)
    feasible = np.all(whole.ceilings.excess(u) <= 0.0, axis=-1)
    wide, narrow = (
        np.all(in_discs(whole, reach, inside).ceilings.excess(u) <= 0.0, axis=-1) for inside in (False, True)
    )
    assert np.any(feasible)
    assert np.all(wide[feasible])
    assert np.all(feasible[narrow])
    assert np.sum(feasible & ~narrow) <= 0.01 * np.sum(feasible)
