"""A statement whose objective is the largest of several sums of groups, as one group of rows.

A row of every group of a sum together is a row that the sum is never below, and the largest of all such rows is the
objective. Of many those are kept that come next to the objective at some points: what is proven of fewer rows holds for
all of them.
"""

import itertools
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.ceilings import Ceilings
from optimizer.program.norms import Norms, scalars
from optimizer.program.statement import Names, Statement

#: rows of a program that is solved often, and of one that is looked at
FEW, MANY = 16, 240
#: rows of several groups together among which these are looked for
_TOGETHER = 20_000


def single_group(
    statement: Statement, case_of: np.ndarray, points: Complex, most: int, kind_of: np.ndarray
) -> Statement:
    """One program with rows of one group, none of them above the objective, and with the ceilings that come next to
    being exceeded.

    Parameters
    ----------
    case_of : (groups,) sum to which a group belongs, in rising order.
    points : (M, K) kg m, at each of which the largest row is kept.
    most : rows, and ceilings, that are kept unless there are more points.
    kind_of : (sums,) kind to which a sum belongs; each kind has its share of the rows, and the largest of it is kept.
    """
    of_terms = statement.norms.sizes(points)
    rows = statement.floor + np.add.reduceat(
        of_terms, np.searchsorted(statement.row, np.arange(statement.group.size)), axis=-1
    )
    level = np.array([np.sum(statement.largest(rows)[:, case_of == case], axis=-1) for case in np.unique(case_of)])
    combinations, slack, kinds = list[tuple[int, ...]](), list[Real](), list[int]()
    for case in np.unique(case_of):
        groups = np.flatnonzero(case_of == case)
        several = [_unlike(statement, np.flatnonzero(statement.group == group)) for group in groups]
        group_share = max(1, int(_TOGETHER ** (1.0 / len(several))))
        nearest = [
            indices[_nearest(np.max(rows[:, indices], axis=-1, keepdims=True) - rows[:, indices], group_share)]
            for indices in several
        ]
        sums = list(itertools.product(*(indices.tolist() for indices in nearest)))
        values = np.sum(rows[:, np.array(sums)], axis=-1)
        of_kind = level[kind_of == kind_of[case]]
        combinations, slack = combinations + sums, [*slack, np.max(of_kind, axis=0)[:, None] - values]
        kinds += [int(kind_of[case])] * len(sums)
    every = np.unique(kinds)
    kind_share = max(most // every.size, len(points))
    places = [np.flatnonzero(np.array(kinds) == kind) for kind in every]
    far = np.concatenate(slack, axis=-1)
    nearest = [place[_nearest(far[:, place], kind_share)] for place in places]
    rows_of_sums = [combinations[n] for n in np.concatenate(nearest).tolist()]
    return replace(_of_rows(statement, rows_of_sums), ceilings=_nearest_ceilings(statement.ceilings, points, most))


def _unlike(statement: Statement, rows: np.ndarray) -> np.ndarray:
    """Rows of a group without those that are nothing but a floor as high as that of another. A response that neither
    is there nor changes has one such row for each cut, and its sums with others are the same."""
    norms = statement.norms
    something = (norms.constant != 0) | np.any(norms.influence != 0, axis=-1)
    bare = rows[~np.isin(rows, statement.row[something])]
    if bare.size <= 1:
        return rows
    _, first = np.unique(statement.floor[bare], return_index=True)
    return np.setdiff1d(rows, np.delete(bare, first))


def _nearest(slack: Real, most: int) -> np.ndarray:
    """Of what is so far below a level at points (M, n) the nearest at each, then the nearest of the others, in order.

    Many equal rows, as those of a load that turns with the shaft, crowd out no other.
    """
    count = slack.shape[-1]
    if count <= most:
        return np.arange(count)
    order = np.argsort(np.min(slack, axis=0), kind="stable")
    first = np.unique(np.argmin(slack, axis=-1))
    return np.sort(np.concatenate([first, order[~np.isin(order, first)]])[:most])


def _of_rows(statement: Statement, sums: Sequence[tuple[int, ...]]) -> Statement:
    """The statement with a row for each of some sums of rows."""
    norms, names = statement.norms, statement.names
    terms = [np.flatnonzero(np.isin(statement.row, rows)) for rows in sums]
    every = np.concatenate(terms)
    scalar = scalars(norms)
    return replace(
        statement,
        norms=Norms(
            norms.constant[every], norms.influence[every], norms.scatter, tuple(scalar[n] for n in every.tolist())
        ),
        row=np.repeat(np.arange(len(sums)), [term.size for term in terms]),
        group=np.zeros(len(sums), int),
        floor=np.array([np.sum(statement.floor[list(rows)]) for rows in sums]),
        names=Names(
            tuple(names.terms[n] for n in every.tolist()),
            tuple(" + ".join(names.rows[r] for r in rows) for rows in sums),
        ),
    )


def _nearest_ceilings(ceilings: Ceilings, points: Complex, most: int) -> Ceilings:
    if len(ceilings.names) <= most:
        return ceilings
    excess = ceilings.excess(points)
    # where some are exceeded those that come next to the largest, so that every point has its own
    slack = np.maximum(np.max(excess, axis=-1, keepdims=True), 0.0) - excess
    nearest = _nearest(slack, max(most, len(points)))
    norms, numbers = ceilings.norms, nearest.tolist()
    angles, scenarios, scalar = ceilings.angles_deg, ceilings.scenarios, scalars(norms)
    return replace(
        ceilings,
        names=tuple(ceilings.names[n] for n in numbers),
        norms=Norms(
            norms.constant[nearest], norms.influence[nearest], norms.scatter, tuple(scalar[n] for n in numbers)
        ),
        cap=ceilings.cap[nearest],
        size=ceilings.size[nearest],
        angles_deg=None if angles is None else tuple(angles[n] for n in numbers),
        scenarios=None if scenarios is None else tuple(scenarios[n] for n in numbers),
    )
