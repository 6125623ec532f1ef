"""The program in physical units: what is to be small, under which limits.

minimise    P(u) = sum_g max_{r in g} ( floor_r + sum_{j in r} |c_j + H_j u| )
subject to  |c_i + H_i u| <= cap_i  for every ceiling i,  u within the limits.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import Any, Literal, NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.program.ceilings import Ceilings, no_ceilings
from optimizer.program.compiled_evaluation import Flat, Reaches, flat
from optimizer.program.limits import Limits
from optimizer.program.norms import Norms, scalars

#: of a sum, in units of the sum of the magnitudes of its terms
_ROUNDING = 4 * np.finfo(float).eps
#: rows from which on they are summed one after the other
_MANY = 8
#: what a term of a weighted peak is the size of: the vector that turns with the shaft, and the one against it
Part = Literal["co", "counter"]
PARTS: tuple[Part, ...] = ("co", "counter")


class Term(NamedTuple):
    """What a norm term of the objective is the size of."""

    response: str
    part: Part
    angle_deg: float | None = None  # of the shaft, where it is the response at one angle
    scenario: str | None = None  # whose response it is; None is the unchanged machine
    share: float | None = None  # of the response in the norm of a root mean square: of what counterweights move


class Names(NamedTuple):
    """Names of terms and rows of an objective in its proof."""

    terms: tuple[Term, ...]  # J
    rows: tuple[str, ...]


@record(frozen=True)
class Statement:
    """A program to solve."""

    norms: Norms
    row: np.ndarray  # (J,) row of the objective to which a term belongs
    group: np.ndarray  # (rows,) group of the objective to which a row belongs, in rising order from 0
    floor: Real  # (..., rows)
    ceilings: Ceilings
    limits: Limits
    names: Names

    @cached_property
    def membership(self) -> Real:
        """(rows, J) matrix that sums the terms of a row."""
        return (self.row[None, :] == np.arange(self.floor.shape[-1])[:, None]).astype(float)

    @cached_property
    def _many_in_order(self) -> bool:
        """Whether rows are so many that a matrix of them costs more than it saves, and their terms are side by side."""
        if self.floor.shape[-1] <= _MANY:
            return False
        step = np.diff(self.row, prepend=-1)
        return bool(np.all((step == 0) | (step == 1)))

    @cached_property
    def every_constant(self) -> Complex:
        """Constants of the terms of the objective, then of what is under ceilings (..., J + I)."""
        if not self.ceilings.names:
            return self.norms.constant
        return np.concatenate([self.norms.constant, self.ceilings.norms.constant], axis=-1)

    @cached_property
    def every_influence(self) -> Real | Complex:
        """The same of the influences (..., J + I, K)."""
        if not self.ceilings.names:
            return self.norms.influence
        return np.concatenate([self.norms.influence, self.ceilings.norms.influence], axis=-2)

    @cached_property
    def constant_sizes(self) -> Real:
        """Sizes of these constants (..., J + I); of a scalar too that of the vector."""
        return np.abs(self.every_constant)

    @cached_property
    def constant_sum(self) -> Real:
        """What the sizes of the constants of the terms sum to (...)."""
        return np.add.reduce(self.constant_sizes[..., : self.row.size], axis=-1)

    @cached_property
    def flat(self) -> Flat:
        """The same for compiled loops."""
        norms, limited = self.norms, self.ceilings
        scalar = np.zeros(self.every_constant.shape[-1], bool)
        if any(norms.scalar) or any(limited.norms.scalar):
            every = [part.scalar or (False,) * part.constant.shape[-1] for part in (norms, limited.norms)]
            scalar = np.array([*every[0], *every[1]])
        return flat(
            (self.row, self.group),
            scalar,
            (norms.scatter, limited.norms.scatter),
            self.every_constant,
            self.every_influence,
            self.floor,
            (limited.cap, limited.tolerant_cap if limited.names else limited.cap, limited.size),
            self.limits,
        )

    def objective(self, u: Complex) -> Real:
        """P(u), exact (..., )."""
        return self.objective_of(self.norms.sizes(u))

    def objective_of(self, sizes: Real) -> Real:
        """P (...) for sizes of the terms (..., J)."""
        rows = self.rows(sizes)
        # one group is the common case
        return np.maximum.reduce(rows, axis=-1) if self.group[-1] == 0 else np.add.reduce(self.largest(rows), axis=-1)

    @cached_property
    def at_rest(self) -> Real:
        """P(0) (...)."""
        if any(self.norms.scalar):
            return self.objective_of(np.abs(self.norms.counting(self.norms.constant)))
        if self.floor.shape[-1] == 1:
            return (self.floor[..., 0] if self.floor.ndim > 1 else self.floor[0]) + self.constant_sum
        return self.objective_of(self.constant_sizes[..., : self.row.size])

    @cached_property
    def reaches(self) -> Reaches:
        """What terms and limited responses call for one by one."""
        return self.flat.single_reaches(self.constant_sizes)

    @property
    def single_reach(self) -> Real:
        """The largest unbalance that one term or one limited response calls for by itself, kg m (...)."""
        return self.reaches.single

    @cached_property
    def first_rows(self) -> np.ndarray:
        """First row of each group (groups,)."""
        return np.searchsorted(self.group, np.arange(self.group[-1] + 1))

    @cached_property
    def _first_terms(self) -> np.ndarray:
        """First term of each row (rows,), where terms of a row are side by side."""
        return np.searchsorted(self.row, np.arange(self.row[-1] + 1))

    def rows(self, sizes: Real) -> Real:
        """Rows of the objective (..., rows) for sizes of its terms (..., J)."""
        if self.floor.shape[-1] == 1:
            return self.floor + np.add.reduce(sizes, axis=-1, keepdims=True)
        if self._many_in_order:
            return self.floor + np.add.reduceat(sizes, self._first_terms, axis=-1)
        return self.floor + np.add.reduce(self.membership * sizes[..., None, :], axis=-1)

    def largest(self, rows: Real) -> Real:
        """Largest of each group (..., groups) of what rows have (..., rows)."""
        return np.maximum.reduceat(rows, self.first_rows, axis=-1)

    def where_largest(self, rows: Real) -> Real:
        """1 at the first of the largest rows of each group, 0 elsewhere (..., rows)."""
        if rows.shape[-1] == 1:
            return np.ones(rows.shape)
        if self.group[-1] == 0:
            return (np.arange(rows.shape[-1]) == np.argmax(rows, axis=-1)[..., None]).astype(float)
        largest = np.zeros(rows.shape)
        for group, first in enumerate(self.first_rows):
            place = first + np.argmax(rows[..., self.group == group], axis=-1)
            np.put_along_axis(largest, place[..., None], 1.0, axis=-1)
        return largest

    def rounding(self, u: Complex) -> Real:
        """What the objective may change by where masses and angles are rounded (...)."""
        size = np.add.reduce(np.abs(self.norms.influence) * np.abs(u)[..., None, :], axis=(-2, -1))
        size = (1.0 + self.norms.scatter) * size
        return _ROUNDING * (size + np.add.reduce(np.abs(self.norms.constant), axis=-1))

    def spelled(self) -> "Statement":
        """One program in which nothing scatters: what a row grows by for a web is a term |s sum |H_jk| u_k| of its own.

        It is the same program: a term of one web is as large as what scatters with that web. Its ceilings do not
        scatter, as a ceiling is on one term.
        """
        norms = self.norms
        if not norms.scatter:
            return self
        assert not (self.ceilings.names and self.ceilings.norms.scatter)
        size = norms.scatter * (self.membership @ np.abs(norms.influence))
        rows, webs = np.nonzero(size)
        row = np.concatenate([self.row, rows])
        order = np.argsort(row, kind="stable")
        own = np.zeros((rows.size, size.shape[-1]))
        own[np.arange(rows.size), webs] = size[rows, webs]
        first = np.searchsorted(self.row, rows)
        terms = (*self.names.terms, *(self.names.terms[n] for n in first.tolist()))
        scalar = (*scalars(norms), *(False for _ in first))
        return replace(
            self,
            norms=Norms(
                np.concatenate([norms.constant, np.zeros(rows.size)])[order],
                np.concatenate([norms.influence, own])[order],
                scalar=tuple(scalar[n] for n in order.tolist()),
            ),
            row=row[order],
            names=self.names._replace(terms=tuple(terms[n] for n in order.tolist())),
        )

    def mass(self, u: Complex) -> Real:
        """Total counterweight mass, kg."""
        return np.add.reduce(np.abs(u) / self.limits.radius, axis=-1)

    def excess(self) -> "Statement":
        """The program of the smallest largest excess over the ceilings; its sign tells whether they can be kept."""
        size, constant = self.ceilings.size, self.ceilings.norms.constant
        norms = replace(
            self.ceilings.norms, constant=constant / size, influence=self.ceilings.norms.influence / size[..., None]
        )
        none = Ceilings((), Norms(constant[..., :0], norms.influence[..., :0, :]), size[..., :0], size[..., :0])
        called = self.ceilings.names
        scenarios = self.ceilings.scenarios or (None,) * len(called)
        terms = (Term(name, "co", None, scenario) for name, scenario in zip(called, scenarios, strict=True))
        names = Names(tuple(terms), called)
        rows = np.arange(size.shape[-1])
        return Statement(norms, rows, np.zeros_like(rows), -self.ceilings.cap / size, none, self.limits, names)

    def about(self, points: Complex) -> "Statement":
        """The programs in what is added to points (N, K) kg m, under the same limits; of one program N of them."""
        nodes = points.shape[:-1]

        def broadcast(array: np.ndarray, last: int) -> np.ndarray:
            return np.broadcast_to(array, (*nodes, *array.shape[array.ndim - last :]))

        def shifted(norms: Norms) -> Norms:
            constant = norms.constant + np.sum(norms.influence * points[..., None, :], axis=-1)
            return replace(norms, constant=constant, influence=broadcast(norms.influence, 2))

        ceilings = self.ceilings
        ceilings = replace(
            ceilings, norms=shifted(ceilings.norms), cap=broadcast(ceilings.cap, 1), size=broadcast(ceilings.size, 1)
        )
        return replace(self, norms=shifted(self.norms), floor=broadcast(self.floor, 1), ceilings=ceilings)

    def alone(self) -> "Statement":
        """One program as the only one of a leading axis (1,)."""
        webs = self.limits.radius.shape[-1]
        none = self.ceilings is no_ceilings((), webs)
        program = Statement(
            self.norms.mapped(_first),
            self.row,
            self.group,
            self.floor[None],
            no_ceilings((1,), webs) if none else self.ceilings.mapped(_first),
            self.limits.mapped(_first),
            self.names,
        )
        # properties of the original are copied, and not computed again
        attributes = vars(program)
        for name in ("constant_sizes", "constant_sum", "at_rest"):
            attributes[name] = getattr(self, name)[None]
        vars(program.limits)["all_free"] = self.limits.all_free
        attributes["reaches"] = self.reaches._replace(single=self.single_reach[None])
        attributes["flat"] = Flat((1,), self.flat.programs)
        return program

    def subset(self, programs: "int | tuple[int, ...] | np.ndarray") -> "Statement":
        """Some of the programs by their leading axes."""
        return self._mapped(lambda array: array[programs])

    def only(self, webs: np.ndarray) -> "Statement":
        """The program with some of the webs, as of :meth:`optimizer.program.limits.Limits.only`."""
        return replace(
            self, norms=self.norms.only(webs), ceilings=self.ceilings.only(webs), limits=self.limits.only(webs)
        )

    def permutation(self, webs: np.ndarray) -> "Statement":
        """The program with its webs in another order (K,), none of them alike."""
        limits = replace(self.limits, alike=None)
        ceilings = replace(self.ceilings, norms=self.ceilings.norms.permutation(webs))
        return replace(self, norms=self.norms.permutation(webs), ceilings=ceilings, limits=limits.permutation(webs))

    def _mapped(self, function: Callable[[Any], Any]) -> "Statement":
        """A function of every array that has the leading axes."""
        return Statement(
            self.norms.mapped(function),
            self.row,
            self.group,
            function(self.floor),
            self.ceilings.mapped(function),
            self.limits.mapped(function),
            self.names,
        )


def _first(array: np.ndarray) -> np.ndarray:
    """The same numbers as the first of a leading axis (1,)."""
    return array[None]
