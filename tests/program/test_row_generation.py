"""The largest of several sums as one group of rows: none above the objective, and the largest of each point kept."""

from dataclasses import replace

import numpy as np
import pytest

from optimizer.program.ceilings import Ceilings
from optimizer.program.cuts.row_generation import single_group
from optimizer.program.norms import Norms
from optimizer.program.statement import Names, Statement, Term
from tests.program.turning import wide

WEBS, GROUPS = 3, (2, 3, 2, 4)


def _statement(ceilings: int = 0) -> Statement:
    """Four groups of two to four rows, of a term each."""
    rng = np.random.default_rng(6)
    count = sum(GROUPS)
    norms = Norms(rng.normal(size=(count, 2)) @ [1, 1j], rng.normal(size=(count, WEBS)))
    limited = Norms(rng.normal(size=(ceilings, 2)) @ [1, 1j], rng.normal(size=(ceilings, WEBS)))
    named = tuple(f"c{n}" for n in range(ceilings))
    rows = np.arange(count)
    names = Names(tuple(Term(f"t{n}", "co") for n in rows), tuple(f"r{n}" for n in rows))
    angles = tuple(10.0 * n for n in range(ceilings))
    capped = Ceilings(named, limited, np.full(ceilings, 1.5), np.ones(ceilings), angles_deg=angles, scenarios=named)
    group = np.repeat(np.arange(len(GROUPS)), GROUPS)
    return Statement(norms, rows, group, rng.uniform(size=count), capped, wide(WEBS), names)


def _points(count: int) -> np.ndarray:
    return np.random.default_rng(8).normal(size=(count, WEBS, 2)) @ [1, 1j]


@pytest.mark.parametrize("case_of", [(0, 0, 0, 0), (0, 0, 1, 1), (0, 1, 1, 2)])
@pytest.mark.parametrize("most", [4, 500])
def test_rows_are_sums_of_the_largest_of_groups(case_of: tuple[int, ...], most: int) -> None:
    """Independent: sums of the groups of each case; at the points the largest, elsewhere no more, of all rows equal."""
    statement, cases, points = _statement(), np.array(case_of), _points(4)
    selection = single_group(statement, cases, points, most, np.zeros(cases[-1] + 1, int))
    every = [np.prod([size for size, case in zip(GROUPS, case_of, strict=True) if case == n]) for n in set(case_of)]
    assert selection.floor.size == min(most, int(np.sum(every)))
    assert not np.any(selection.group)

    def largest(u: np.ndarray) -> np.ndarray:
        of_groups = statement.largest(statement.rows(statement.norms.sizes(u)))
        return np.max([np.sum(of_groups[:, cases == n], axis=-1) for n in set(case_of)], axis=0)

    np.testing.assert_allclose(selection.objective(points), largest(points), rtol=1e-12)
    elsewhere = 2.0 * _points(50)
    assert np.all(selection.objective(elsewhere) <= largest(elsewhere) * (1.0 + 1e-12))
    if most == 500:
        np.testing.assert_allclose(selection.objective(elsewhere), largest(elsewhere), rtol=1e-12)
    # a row is called by those that it is the sum of, and has their terms
    for n, name in enumerate(selection.names.rows):
        parts = [int(part[1:]) for part in name.split(" + ")]
        assert [selection.names.terms[j].response for j in np.flatnonzero(selection.row == n)] == [
            f"t{r}" for r in parts
        ]
        assert selection.floor[n] == pytest.approx(np.sum(statement.floor[parts]))


def test_every_kind_of_sum_keeps_its_own_largest() -> None:
    statement, cases, points = _statement(), np.array([0, 0, 1, 1]), _points(3)
    selection = single_group(statement, cases, points, 8, np.array([0, 1]))
    of_groups = statement.largest(statement.rows(statement.norms.sizes(points)))
    sizes = selection.rows(selection.norms.sizes(points))
    first = np.array(["r0" in name.split(" + ") or "r1" in name.split(" + ") for name in selection.names.rows])
    assert np.sum(first) == np.sum(~first) == 4
    for kind, own in ((first, of_groups[:, :2]), (~first, of_groups[:, 2:])):
        np.testing.assert_allclose(np.max(sizes[:, kind], axis=-1), np.sum(own, axis=-1), rtol=1e-12)


def test_the_nearest_ceilings_are_kept() -> None:
    """Property: the largest excess of every point is among them, with its name, its angle and its scenario."""
    statement, points = _statement(12), _points(3)
    ceilings = single_group(statement, np.zeros(4, int), points, 5, np.zeros(1, int)).ceilings
    assert len(ceilings.names) == 5
    excess = statement.ceilings.excess(points)
    np.testing.assert_allclose(np.max(ceilings.excess(points), axis=-1), np.max(excess, axis=-1), rtol=1e-12)
    places = [int(name[1:]) for name in ceilings.names]
    assert places == sorted(places)
    assert ceilings.angles_deg == tuple(10.0 * n for n in places)
    assert ceilings.scenarios == ceilings.names
    slack = np.min(np.maximum(np.max(excess, axis=-1, keepdims=True), 0.0) - excess, axis=0)
    assert set(places) == set(np.argsort(slack, kind="stable")[:5].tolist())
    whole = single_group(statement, np.zeros(4, int), points, 12, np.zeros(1, int)).ceilings
    assert whole is statement.ceilings
    plain = replace(statement, ceilings=replace(statement.ceilings, angles_deg=None, scenarios=None))
    bare = single_group(plain, np.zeros(4, int), points, 5, np.zeros(1, int)).ceilings
    assert (bare.angles_deg, bare.scenarios) == (None, None)
