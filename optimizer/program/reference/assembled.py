"""The cone program as matrices, handed to clarabel without a modelling layer.

    minimise    cost @ v
    subject to  constant + matrix @ v >= 0            rows
                |vector_i(v)| <= size_i(v)            cones in the plane

The variables begin with the scaled x, y and fraction of every web (:mod:`optimizer.program.reference.modelling`); what
follows belongs to the program at hand.
"""

from collections.abc import Sequence
from functools import cache, lru_cache
from typing import ClassVar, NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record
from optimizer.program.reference.boost import Boost
from optimizer.program.scaled_program import ScaledData, ScaledSolution

#: of the solver, by default
REGULARIZATION = 1e-8
#: rows of a second-order cone in the plane: size, real part, imaginary part
_PLANE = 3


@record(frozen=True)
class NoPoint:
    """A program that ended without a point, and why."""

    reason: str


@record(frozen=True)
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
        # the solver wants the rows of a cone together
        of_sizes, of_vectors = _places(size.size)
        constant = np.empty(_PLANE * size.size)
        constant[of_sizes], constant[of_vectors] = size, vectors
        parts = [Part(of_sizes[part.row], part.column, part.value) for part in size_parts]
        parts += [Part(of_vectors[part.row], part.column, part.value) for part in vector_parts]
        return self._add(constant, parts, cones=True)

    def _add(self, constant: Real, parts: Sequence[Part], cones: bool) -> slice:
        start = self._rows
        self._parts += [Part(start + part.row, part.column, part.value) for part in parts]
        self._constants.append(constant)
        self._rows += constant.size
        if constant.size:
            self._cones.append((cones, constant.size))
        return slice(start, self._rows)

    def matrix(self) -> Real:
        """(rows, columns); dense, as cuts fill most of it."""
        array = np.zeros((self._rows, self.columns))
        for part in self._parts:
            array[part.row, part.column] += part.value
        return array

    def constant(self) -> Real:
        """(rows,)."""
        return np.concatenate(self._constants)

    def solve(
        self,
        cost: Real,
        tolerance: float,
        time_limit_s: float,
        about: Real | None = None,
        regularization: float = REGULARIZATION,
    ) -> tuple[Real, Real] | NoPoint:
        """Solve by clarabel: variables and the multipliers of all rows.

        Parameters
        ----------
        tolerance : of the gap, absolute and relative, and of feasibility, in scaled units.
        time_limit_s : after which the solver gives up.
        about : (columns,) variables near an optimum, by which the cones are boosted.
        regularization : that the solver adds to what it factors; with less it sees more digits, or none.
        """
        import clarabel

        settings = clarabel.DefaultSettings()
        settings.verbose = False
        settings.time_limit = time_limit_s
        settings.static_regularization_constant = regularization
        settings.tol_gap_abs = settings.tol_gap_rel = settings.tol_feas = tolerance
        matrix, constant = self.matrix(), self.constant()
        boost = None
        if about is not None:
            boost = Boost.about(constant + matrix @ about, self._first_rows())
            matrix, constant = boost.of(matrix), boost.of(constant)
        cones: list[object] = []
        for plane, rows in self._cones:
            cones += (
                [clarabel.SecondOrderConeT(_PLANE)] * (rows // _PLANE) if plane else [clarabel.NonnegativeConeT(rows)]
            )
        # clarabel: A v + s = b with s in the cones
        result = clarabel.DefaultSolver(
            _nothing(self.columns), cost, _by_columns(-matrix), constant, cones, settings
        ).solve()
        v, dual, status = np.array(result.x), np.array(result.z), clarabel.SolverStatus
        if boost is not None:
            dual = boost.of(dual)
        if result.status == status.MaxTime:
            return NoPoint(f"not solved within {time_limit_s:.3g} s")
        if result.status in (status.PrimalInfeasible, status.AlmostPrimalInfeasible):
            return NoPoint("no counterweights keep the ceilings of this program")
        usable = (status.Solved, status.AlmostSolved, status.InsufficientProgress, status.MaxIterations)
        if result.status not in usable or not (np.all(np.isfinite(v)) and np.all(np.isfinite(dual))):
            return NoPoint(f"the solver ended with {result.status}")
        return v, dual

    def _first_rows(self) -> np.ndarray:
        """First row of every cone in the plane."""
        places, start = [np.zeros(0, dtype=int)], 0
        for plane, rows in self._cones:
            if plane:
                places.append(np.arange(start, start + rows, _PLANE))
            start += rows
        return np.concatenate(places)


@lru_cache(maxsize=64)
def _places(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Rows of so many cones that stand together: of the sizes, and of the vectors; nobody writes to it."""
    first = _PLANE * np.arange(count)
    return first, np.concatenate([first + 1, first + 2])


@record(frozen=True)
class _Columns:
    """Entries of a matrix, column by column, with the names that clarabel reads.

    It takes a matrix of scipy.sparse. For these names alone that would be imported: 60 ms of a service's start, half a
    second of the first one, which has no bytecode yet.
    """

    has_canonical_format: ClassVar = True
    shape: tuple[int, ...]
    data: Real
    indices: np.ndarray  # rows of the entries
    indptr: np.ndarray  # first entry of each column, and their number


@cache
def _nothing(columns: int) -> _Columns:
    """No quadratic part of a cost."""
    return _by_columns(np.zeros((columns, columns)))


def _by_columns(matrix: Real) -> _Columns:
    """Entries of a dense matrix that are not 0, as the solver wants them."""
    column, row = np.nonzero(matrix.T)
    start = np.concatenate([[0], np.cumsum(np.bincount(column, minlength=matrix.shape[1]))])
    return _Columns(matrix.shape, matrix[row, column], row, start)


def vector_duals(dual: Real) -> Complex:
    """Multipliers p of |a| <= t as complex numbers: the dual of the cone is (|p|, -p)."""
    _, real, imaginary = dual.reshape(-1, _PLANE).T
    return -(real + 1j * imaginary)


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


class GroupLimit(NamedTuple):
    """A sum of groups that is not to exceed a level."""

    groups: np.ndarray  # (groups,) bool
    most: float  # scaled, above the highest floors of the groups


class Assembled(NamedTuple):
    """A point before its verdict, with the prices of the targets."""

    solution: ScaledSolution
    level: Real  # (groups,) above the highest floor of each
    price: Real  # (targets,) multipliers
    variables: Real


def solved(
    data: ScaledData,
    tolerance: float,
    time_limit_s: float,
    weighed: np.ndarray | None = None,
    targets: Sequence[GroupLimit] = (),
    sums: Sequence[GroupLimit] = (),
    about: Real | None = None,
    regularization: float = REGULARIZATION,
) -> Assembled | NoPoint:
    """Solve a scaled program of any groups, with its multipliers in the form of :class:`ConeProgram`.

    A row of one term needs no variable for it: the cone is |a| <= level - floor, whose size has the row's multiplier.

    Parameters
    ----------
    data : stage "objective" minimises levels, stage "mass" the mass.
    weighed : (groups,) bool, those whose levels are minimised in stage "objective"; all by default.
    targets : what other groups may come to.
    sums : sums of groups, the largest of which is minimised where there are several: the most that each may come to
        is above its own by the same.
    about : variables near an optimum, of a program that may have other rows of one term.
    regularization : of the solver.
    """
    shape = data.shape
    webs, groups = shape.webs, shape.groups[-1] + 1
    row, group = np.array(shape.rows, dtype=int), np.array(shape.groups, dtype=int)
    alone = (np.bincount(row, minlength=group.size) == 1)[row]
    together = np.flatnonzero(~alone)
    norms, levels = 3 * webs, 3 * webs + together.size
    most_of_sums = levels + groups
    program = Assembly(most_of_sums + (len(sums) > 1))
    # all rows of one term: |a_j| <= level_g - floor_r
    single, twice = np.flatnonzero(alone), np.concatenate([alone, alone])
    above = np.zeros((single.size, groups))
    above[np.arange(single.size), group[row[single]]] = 1.0
    direct = program.cones(
        -data.floor[row[single]],
        (dense(levels, above), dense(2 * webs, -data.spread[single])),
        data.constant[:, alone].ravel(),
        (dense(0, data.matrix[twice]),),
    )
    # the others: |a_j| <= t_j, level_g >= floor_r + sum t_j
    summed = np.setdiff1d(np.arange(group.size), row[single])
    membership = (row[together][None, :] == summed[:, None]).astype(float)
    above = np.zeros((summed.size, groups))
    above[np.arange(summed.size), group[summed]] = 1.0
    rows = program.nonnegative(
        -data.floor[summed],
        dense(norms, -membership),
        dense(levels, above),
        dense(2 * webs, -membership @ data.spread[together]),
    )
    cones = program.cones(
        np.zeros(together.size),
        (diagonal(norms, np.ones(together.size)),),
        data.constant[:, ~alone].ravel(),
        (dense(0, data.matrix[~twice]),),
    )
    off = (dense(2 * webs, -data.ceiling_spread),)
    caps = program.cones(data.ceiling_cap, off, data.ceiling_constant.ravel(), (dense(0, data.ceiling_matrix),))
    add_limits(program, data)
    add_discs(program, data)
    if targets:
        most = np.array([target.most for target in targets])
        charged = program.nonnegative(most, dense(levels, -_membership(targets)))
    cost = np.zeros(program.columns)
    if shape.stage == "mass":
        cost[2 * webs : 3 * webs] = data.mass
    else:
        cost[levels:most_of_sums] = 1.0 if weighed is None else weighed.astype(float)
    if len(sums) > 1 and shape.stage == "objective":
        cost[levels:most_of_sums], cost[most_of_sums] = 0.0, 1.0
        most = np.array([limit.most for limit in sums])
        program.nonnegative(most, dense(levels, -_membership(sums)), dense(most_of_sums, np.ones((len(sums), 1))))
    result = program.solve(cost, tolerance, time_limit_s, about, regularization)
    if isinstance(result, NoPoint):
        return result
    v, dual = result
    row_multiplier, term = np.zeros(group.size), np.zeros(row.size, complex)
    row_multiplier[row[single]], row_multiplier[summed] = dual[direct][::_PLANE], dual[rows]
    term[single], term[together] = vector_duals(dual[direct]), vector_duals(dual[cones])
    solution = ScaledSolution(v[:webs], v[webs : 2 * webs], row_multiplier, term, vector_duals(dual[caps]), "assembled")
    return Assembled(solution, v[levels:most_of_sums], dual[charged] if targets else np.zeros(0), v)


def _membership(sums: Sequence[GroupLimit]) -> Real:
    """(sums, groups) 1 where a group belongs to a sum."""
    return np.stack([limit.groups for limit in sums]).astype(float)
