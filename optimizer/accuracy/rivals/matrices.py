"""A cone program as matrices, handed to a solver without a modelling layer.

    minimise    cost @ v
    subject to  constant + matrix @ v >= 0            rows
                |vector_i(v)| <= size_i(v)            cones in the plane

The variables begin with the scaled x, y and fraction of every web (:mod:`optimizer.program.reference.modelling`); what
follows belongs to the program at hand.
"""

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from optimizer.arrays import Complex, Real
from optimizer.program.certificate import Multipliers
from optimizer.program.reference.modelling import ScaledData, ScaledSolution
from optimizer.program.scaling import Scaling, natural_reach, scale
from optimizer.program.statement import Statement

#: rows of a second-order cone in the plane: size, real part, imaginary part
_PLANE = 3
#: limits beyond this multiple of the natural reach cannot bind
_REACH = 10.0


@dataclass(frozen=True)
class Point:
    """What a program found, unjudged: the certificate decides what it is worth."""

    unbalance: Complex  # (K,) kg m, within the limits
    multipliers: Multipliers
    claimed: float | None  # objective that the program itself sees, where it shows it


@dataclass(frozen=True)
class NoPoint:
    """A program that found nothing, and why."""

    reason: str


@dataclass(frozen=True)
class Part:
    """Entries of a few columns of some rows."""

    row: np.ndarray
    column: np.ndarray
    value: Real


def dense(column: int, values: Real) -> Part:
    """A dense part (m, n) that begins at a column."""
    row, inside = np.nonzero(values)
    return Part(row, column + inside, values[row, inside])


def diagonal(column: int, values: Real) -> Part:
    """A diagonal part (m,), the first entry at a column."""
    index = np.arange(values.size)
    return Part(index, column + index, values)


class Assembly:
    """Rows and cones put together one after the other."""

    def __init__(self, columns: int) -> None:
        self.columns = columns
        self._parts: list[Part] = []
        self._constants: list[Real] = []
        self._cones: list[tuple[bool, int]] = []  # whether cones in the plane, number of rows
        self._rows = 0

    @property
    def rows(self) -> int:
        return self._rows

    def nonnegative(self, constant: Real, *parts: Part) -> slice:
        """Rows constant + parts @ v >= 0; returns where they stand."""
        return self._add(constant, parts, cones=False)

    def cones(self, size: Real, size_parts: tuple[Part, ...], vectors: Real, vector_parts: tuple[Part, ...]) -> slice:
        """Cones |vector_i| <= size_i; returns where they stand.

        Parameters
        ----------
        size : (count,) constants of the right sides.
        vectors : (2 count,) constants of the vectors; all real parts stand first, as in their parts.
        """
        count = size.size

        def moved(row: np.ndarray, offset: int) -> np.ndarray:
            # the solver wants the rows of a cone together
            row = row + offset
            return _PLANE * (row % count) + row // count

        constant = np.empty(_PLANE * count)
        constant[moved(np.arange(count), 0)] = size
        constant[moved(np.arange(2 * count), count)] = vectors
        parts = [Part(moved(part.row, 0), part.column, part.value) for part in size_parts]
        parts += [Part(moved(part.row, count), part.column, part.value) for part in vector_parts]
        return self._add(constant, parts, cones=True)

    def _add(self, constant: Real, parts: "tuple[Part, ...] | list[Part]", cones: bool) -> slice:
        start = self._rows
        self._parts += [Part(start + part.row, part.column, part.value) for part in parts]
        self._constants.append(constant)
        self._rows += constant.size
        if constant.size:
            self._cones.append((cones, constant.size))
        return slice(start, self._rows)

    def matrix(self) -> sparse.csc_matrix:
        """(rows, columns)."""
        row, column, value = (
            np.concatenate([getattr(part, name) for part in self._parts]) for name in ("row", "column", "value")
        )
        return sparse.csc_matrix((value, (row, column)), shape=(self._rows, self.columns))

    def constant(self) -> Real:
        """(rows,)."""
        return np.concatenate(self._constants)

    def solve(self, cost: Real, tolerance: float, time_limit_s: float) -> tuple[Real, Real] | NoPoint:
        """Solve by clarabel: variables and the multipliers of all rows.

        Parameters
        ----------
        tolerance : of the gap, absolute and relative, and of feasibility, in scaled units.
        time_limit_s : after which the solver gives up.
        """
        import clarabel

        settings = clarabel.DefaultSettings()
        settings.verbose = False
        settings.time_limit = time_limit_s
        settings.tol_gap_abs = settings.tol_gap_rel = settings.tol_feas = tolerance
        cones: list[object] = []
        for plane, rows in self._cones:
            cones += (
                [clarabel.SecondOrderConeT(_PLANE)] * (rows // _PLANE) if plane else [clarabel.NonnegativeConeT(rows)]
            )
        # clarabel: A v + s = b with s in the cones
        quadratic = sparse.csc_matrix((self.columns, self.columns))
        found = clarabel.DefaultSolver(quadratic, cost, -self.matrix(), self.constant(), cones, settings).solve()
        v, dual, status = np.array(found.x), np.array(found.z), clarabel.SolverStatus
        if found.status == status.MaxTime:
            return NoPoint(f"not solved within {time_limit_s:.3g} s")
        if found.status in (status.PrimalInfeasible, status.AlmostPrimalInfeasible):
            return NoPoint("no counterweights keep the ceilings of this program")
        usable = (status.Solved, status.AlmostSolved, status.InsufficientProgress, status.MaxIterations)
        if found.status not in usable or not (np.all(np.isfinite(v)) and np.all(np.isfinite(dual))):
            return NoPoint(f"the solver ended with {found.status}")
        return v, dual


def vector_duals(dual: Real) -> Complex:
    """Multipliers p of |a| <= t as complex numbers: the dual of the cone is (|p|, -p)."""
    _, real, imaginary = dual.reshape(-1, _PLANE).T
    return -(real + 1j * imaginary)


def scaled(statement: Statement, ceiling_margin: float) -> tuple[ScaledData, Scaling]:
    """The scaled first stage of a statement, as the reference solver poses it in its first attempt.

    Parameters
    ----------
    ceiling_margin : share of their size by which ceilings are lowered.
    """
    clip = min(_REACH * float(natural_reach(statement)), float(np.max(statement.limits.reach)))
    return scale(statement, "objective", clip, ceiling_margin)


def add_limits(program: Assembly, data: ScaledData) -> None:
    """Fraction <= 1, sectors and budget; the discs are left to the program."""
    webs = data.shape.webs
    program.nonnegative(np.ones(webs), diagonal(2 * webs, -np.ones(webs)))
    if data.shape.sectors:
        # |y| cosine <= x, with slack where the web is free
        for sign in (1.0, -1.0):
            program.nonnegative(data.slack, diagonal(0, np.ones(webs)), diagonal(webs, sign * data.cosine))
    if data.shape.budget:
        program.nonnegative(np.ones(1), dense(2 * webs, -data.budget[None, :]))


def add_discs(program: Assembly, data: ScaledData) -> None:
    """Discs |(x_k, sine_k y_k)| <= fraction_k."""
    webs = data.shape.webs
    place = diagonal(0, np.concatenate([np.ones(webs), data.sine]))
    program.cones(np.zeros(webs), (diagonal(2 * webs, np.ones(webs)),), np.zeros(2 * webs), (place,))


def add_rows(program: Assembly, statement: Statement, data: ScaledData, norms: int, value: int) -> slice:
    """Rows value >= floor + sum of the norms of the row, from the columns of norms and value."""
    above = np.ones((data.floor.size, 1))
    return program.nonnegative(-data.floor, dense(norms, -statement.membership), dense(value, above))


def point(
    statement: Statement, scaling: Scaling, v: Real, claimed: float, row: Real, term: Complex, ceiling: Complex
) -> Point:
    """Scaled variables and multipliers in physical units; the point is brought into the limits.

    Parameters
    ----------
    claimed : objective that the program sees, scaled.
    """
    webs = scaling.reach.size
    found = ScaledSolution(v[:webs], v[webs : 2 * webs], row, term, ceiling, "")
    unbalance = statement.limits.into(scaling.unbalance(statement, found))
    return Point(unbalance, scaling.multipliers(statement, found), claimed * scaling.objective)


def exact(statement: Statement, tolerance: float, time_limit_s: float) -> Point | NoPoint:
    """The exact cone program of :class:`optimizer.program.reference.modelling.ConeProgram`, first stage, as matrices.

    Parameters
    ----------
    tolerance : of the solver; ceilings are lowered by the same share.
    """
    data, scaling = scaled(statement, tolerance)
    webs, terms, ceilings = data.shape.webs, len(data.shape.rows), data.shape.ceilings
    norms, value = 3 * webs, 3 * webs + terms
    program = Assembly(value + 1)
    rows = add_rows(program, statement, data, norms, value)
    sizes = (diagonal(norms, np.ones(terms)),)
    objective = program.cones(np.zeros(terms), sizes, data.constant.ravel(), (dense(0, data.matrix),))
    caps = program.cones(data.ceiling_cap, (), data.ceiling_constant.ravel(), (dense(0, data.ceiling_matrix),))
    add_limits(program, data)
    add_discs(program, data)
    cost = np.zeros(program.columns)
    cost[value] = 1.0
    found = program.solve(cost, tolerance, time_limit_s)
    if isinstance(found, NoPoint):
        return found
    v, dual = found
    ceiling = vector_duals(dual[caps]) if ceilings else np.zeros(0, complex)
    claimed = v[value] + float(np.max(statement.floor)) / scaling.objective
    return point(statement, scaling, v, claimed, dual[rows], vector_duals(dual[objective]), ceiling)
