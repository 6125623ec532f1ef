"""Programs without the rows that are far below the largest: there the least mass often needs one attempt.

Where the larger of force and moment counts, one may be far below the other at every optimum, as the force of an even
layout is. Then the interior point of the least mass stalls. Without that row it does not. What is proven of the
others is proven of all, and the point is as good where the row is still below.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.certificate import Multipliers
from optimizer.program.methods.compiled import StageSolutions, stage_solutions
from optimizer.program.norms import Norms
from optimizer.program.points import points_at
from optimizer.program.solution import ConeSolution
from optimizer.program.statement import Names, Statement

#: a row that is below the largest by this share of it is far below it
_FAR = 0.5


def settle_without_slack_rows(
    statement: Statement, share: Real, demand: Real, least_mass: bool, stages: StageSolutions
) -> None:
    """Certify in place what both stages left open of N programs of one group, as far as fewer rows do.

    Parameters
    ----------
    share, demand : (N,) as of :func:`optimizer.program.methods.compiled.stage_solutions`.
    """
    if statement.floor.shape[-1] < 2:
        return
    left = np.flatnonzero(~stages.certified)
    if not left.size:
        return
    rows = statement.subset(left).rows(statement.subset(left).norms.sizes(stages.smallest[left]))
    largest = np.max(rows, axis=-1, keepdims=True)
    # never the largest itself, which may be below 0
    far = largest - rows > _FAR * np.abs(largest)
    for pattern in np.unique(far, axis=0):
        programs = left[np.all(far == pattern, axis=-1)]
        if not np.any(pattern):
            continue
        whole, terms = statement.subset(programs), ~pattern[statement.row]
        part = stage_solutions(_of_rows(whole, ~pattern, terms), share[programs], demand[programs], least_mass)
        objective = points_at(whole, part.unbalance).objective
        # no row that was left out has become the largest
        success = part.certified & (objective <= part.objective)
        part = replace(
            part,
            multipliers=_over_all(whole, ~pattern, terms, part.multipliers),
            mass_multipliers=_over_all(whole, ~pattern, terms, part.mass_multipliers),
        )
        stages.put(programs[success], part.subset(success))


class ActiveRows(NamedTuple):
    """One program without the rows that are far below the largest at some point.

    program : of the others.
    rows, terms : (rows,) and (J,) bool, of the whole program, which of them it has.
    """

    program: Statement
    rows: np.ndarray
    terms: np.ndarray

    @classmethod
    def of(cls, statement: Statement, rows: np.ndarray) -> "ActiveRows":
        """Those of some rows (rows,) of one program of one group."""
        terms = rows[statement.row]
        return cls(statement if np.all(rows) else _of_rows(statement, rows, terms), rows, terms)

    def over_all(self, statement: Statement, solution: ConeSolution) -> ConeSolution:
        """What is found of it, as a solution of the whole program: what is proven of some rows is proven of all."""
        of_mass = solution.mass_multipliers
        return replace(
            solution,
            multipliers=_over_all(statement, self.rows, self.terms, solution.multipliers),
            mass_multipliers=None if of_mass is None else _over_all(statement, self.rows, self.terms, of_mass),
        ).with_point(statement, solution.unbalance)


def near_rows(statement: Statement, u: Complex) -> np.ndarray:
    """Rows (rows,) of one program that are not far below the largest at a point (K,) kg m."""
    rows = statement.rows(statement.norms.sizes(u))
    largest = np.max(rows)
    near: np.ndarray = (rows == largest) | (largest - rows <= _FAR * np.abs(largest))
    return near


def _of_rows(statement: Statement, rows: np.ndarray, terms: np.ndarray) -> Statement:
    """The program with some rows and their terms alone."""
    norms, names = statement.norms, statement.names
    return replace(
        statement,
        norms=Norms(
            norms.constant[..., terms],
            norms.influence[..., terms, :].copy(),
            norms.scatter,
            tuple(np.array(norms.scalar)[terms].tolist()) if norms.scalar else (),
        ),
        row=np.cumsum(rows)[statement.row[terms]] - 1,
        group=statement.group[rows],
        floor=statement.floor[..., rows],
        names=Names(
            tuple(name for name, here in zip(names.terms, terms, strict=True) if here),
            tuple(name for name, here in zip(names.rows, rows, strict=True) if here),
        ),
    )


def _over_all(statement: Statement, rows: np.ndarray, terms: np.ndarray, part: Multipliers) -> Multipliers:
    """Multipliers of all rows and terms, 0 of those that were left out."""
    term, row = np.zeros_like(statement.norms.constant), np.zeros_like(statement.floor)
    term[..., terms], row[..., rows] = part.term, part.row
    return replace(part, term=term, row=row)
