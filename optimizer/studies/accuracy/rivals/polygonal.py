"""The program with polygons in place of the circles: linear, for HiGHS.

Limits and ceilings take polygons with their corners on the circle, so that every point of the linear program
is within the true limits: Re(v e^{-j phi_i}) <= cos(pi/N) radius for N directions phi_i. The norms of the
objective take the polygon around the circle, |a| >= max_i Re(a e^{-j phi_i}) >= cos(pi/N) |a|, whose
multipliers are multipliers of the true norm. With N sides either is off by 1 - cos(pi/N), about 5/N^2.
"""

import numpy as np
from scipy.optimize import linprog

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.reference.assembled import Assembly, NoPoint, Part, add_limits, dense
from optimizer.program.statement import Statement
from optimizer.studies.accuracy.rivals.matrices import RivalPoint, add_rows, point, scaled

#: ceilings are lowered by this share of their size: the feasibility tolerance of HiGHS
_CEILING_MARGIN = 1e-7
_TIME_LIMIT, _INFEASIBLE = 1, 2


def directions(sides: int, position: float) -> Complex:
    """Normals of the sides, unit vectors (sides,).

    Parameters
    ----------
    position : of the polygon, as a share of the angle between two sides; 0 has the first corner on the axis.
    """
    return np.exp(2j * np.pi * (np.arange(sides) + 0.5 + position) / sides)


def polygonal(statement: Statement, sides: int, position: float, time_limit_s: float) -> RivalPoint | NoPoint:
    """Solve the linear program.

    Parameters
    ----------
    sides, position : the polygon, as in :func:`directions`.
    """
    data, scaling = scaled(statement, _CEILING_MARGIN)
    webs, terms, ceilings = data.shape.webs, len(data.shape.rows), data.shape.ceilings
    norms, value = 3 * webs, 3 * webs + terms
    normal, inner = directions(sides, position), np.cos(np.pi / sides)
    program = Assembly(value + 1)
    rows = add_rows(program, statement, data, norms, value)
    matrix, constant = _along(normal, data.matrix, data.constant)
    sizes = dense(norms, np.repeat(np.eye(terms), sides, axis=0))
    around = program.nonnegative(-constant, dense(0, -matrix), sizes)
    matrix, constant = _along(normal, data.ceiling_matrix, data.ceiling_constant)
    caps = program.nonnegative(inner * np.repeat(data.ceiling_cap, sides) - constant, dense(0, -matrix))
    add_limits(program, data)
    program.nonnegative(np.zeros(webs * sides), _discs(normal, inner, data.sine))

    cost = np.zeros(program.columns)
    cost[value] = 1.0
    result = linprog(
        cost,
        A_ub=-program.matrix(),
        b_ub=program.constant(),
        bounds=(None, None),
        method="highs",
        options={"time_limit": time_limit_s},
    )
    if result.status == _TIME_LIMIT:
        return NoPoint(f"not solved within {time_limit_s:.3g} s")
    if result.status == _INFEASIBLE:
        return NoPoint("no counterweights keep the ceilings of this program")
    if result.x is None:
        return NoPoint(f"the solver ended with: {result.message}")
    dual = -result.ineqlin.marginals
    term = dual[around].reshape(terms, sides) @ normal
    ceiling = dual[caps].reshape(ceilings, sides) @ normal
    claimed = result.x[value] + float(np.max(statement.floor)) / scaling.objective
    return point(statement, scaling, result.x, claimed, dual[rows], term, ceiling)


def _along(normal: Complex, matrix: Real, constant: Real) -> tuple[Real, Real]:
    """Components Re(a_j e^{-j phi_i}) of vectors, the sides of one vector together: (J N, 2 K), (J N,).

    Parameters
    ----------
    matrix : (2 J, 2 K), the real parts first.
    constant : (2, J).
    """
    count = constant.shape[1]
    real, imaginary = matrix[:count], matrix[count:]
    rows = normal.real[:, None] * real[:, None, :] + normal.imag[:, None] * imaginary[:, None, :]
    fixed = normal.real * constant[0][:, None] + normal.imag * constant[1][:, None]
    return rows.reshape(count * normal.size, matrix.shape[1]), fixed.ravel()


def _discs(normal: Complex, inner: float, sine: Real) -> Part:
    """Polygons inside the discs |(x_k, sine_k y_k)| <= fraction_k, the sides of one web together."""
    webs, sides = sine.size, normal.size
    rows, web = np.arange(webs * sides), np.repeat(np.arange(webs), sides)
    across = np.repeat(sine, sides) * np.tile(normal.imag, webs)
    return Part(
        np.tile(rows, 3),
        np.concatenate([web, webs + web, 2 * webs + web]),
        np.concatenate([-np.tile(normal.real, webs), -across, np.full(rows.size, inner)]),
    )
