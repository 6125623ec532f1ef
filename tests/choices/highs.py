"""The same choice as a mixed-integer linear program, polygons in place of circles, by HiGHS: a rival of benchmarks."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy import sparse
from scipy.optimize import Bounds, LinearConstraint, milp

from optimizer.choices.discrete.options import Options
from optimizer.program.statement import Statement
from tests.choices.scip import Chosen

#: of every polygon: with N sides it is off by 1 - cos(pi/N)
SIDES = 32


def highs(statement: Statement, options: Options, relative_gap: float, yardstick: float, time_limit_s: float) -> Chosen:
    """One program without ceilings and numbers of castings; what is found is judged by the circles.

    Polygons stand inside the circles of the norms, so that the bound is one of the circles too.
    """
    if statement.ceilings.names or options.most_parts is not None or options.most_fitted is not None:
        raise NotImplementedError("ceilings and numbers are not posed here")
    exists = options.exists
    slots, count = exists.shape[0], int(np.sum(exists))
    slot, option = np.nonzero(exists)
    norms, groups = statement.norms, np.unique(statement.group)
    terms, levels = norms.constant.size, groups.size
    effect = norms.influence[:, slot] * options.unbalance[slot, option] / yardstick  # (J, V)
    side = np.exp(2j * np.pi * np.arange(SIDES) / SIDES)
    along = np.real(np.conj(side)[None, :, None] * effect[:, None, :]).reshape(-1, count)
    lengths = np.repeat(np.eye(terms), SIDES, axis=0)
    constant = np.real(np.conj(side) * norms.constant[:, None] / yardstick).ravel()
    of_row = (statement.row[None, :] == np.arange(statement.floor.size)[:, None]).astype(float)
    of_group = (statement.group[:, None] == groups[None, :]).astype(float)
    rows: list[Any] = [
        # one option of every slot, lengths above their polygons, levels above floors and lengths, the budget
        (sparse.csr_matrix((np.ones(count), (slot, np.arange(count))), (slots, count)), None, None, 1.0, 1.0),
        (sparse.csr_matrix(-along), sparse.csr_matrix(lengths), None, constant, np.inf),
        (None, sparse.csr_matrix(-of_row), sparse.csr_matrix(of_group), statement.floor / yardstick, np.inf),
    ]
    if np.isfinite(statement.limits.max_total_mass):
        mass = sparse.csr_matrix(options.mass[slot, option][None])
        rows.append((mass, None, None, -np.inf, float(statement.limits.max_total_mass)))
    solution = milp(
        np.concatenate([np.zeros(count + terms), np.ones(levels)]),
        integrality=np.concatenate([np.ones(count), np.zeros(terms + levels)]),
        bounds=Bounds(
            np.concatenate([np.zeros(count + terms), np.full(levels, -np.inf)]),
            np.concatenate([np.ones(count), np.full(terms + levels, np.inf)]),
        ),
        constraints=[_constraint(parts, (count, terms, levels), low, high) for *parts, low, high in rows],
        options={"time_limit": time_limit_s, "mip_rel_gap": relative_gap},
    )
    bound = -np.inf if solution.mip_dual_bound is None else float(solution.mip_dual_bound) * yardstick
    if solution.x is None:
        return Chosen(np.nan, bound, int(solution.mip_node_count or 0))
    taken = np.zeros(exists.shape)
    taken[slot, option] = solution.x[:count]
    chosen = np.argmax(taken, axis=-1)
    objective = float(statement.objective(options.carried(chosen)))
    return Chosen(objective, bound, int(solution.mip_node_count or 0), chosen)


def _constraint(parts: Sequence[Any], widths: tuple[int, int, int], low: Any, high: Any) -> LinearConstraint:
    height = next(part.shape[0] for part in parts if part is not None)
    blocks = [
        sparse.csr_matrix((height, width)) if part is None else part for part, width in zip(parts, widths, strict=True)
    ]
    return LinearConstraint(sparse.hstack(blocks, format="csr"), low, high)
