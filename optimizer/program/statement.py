"""The program in physical units: what is to be small, under which limits.

minimise    P(u) = sum_g max_{r in g} ( floor_r + sum_{j in r} |c_j + H_j u| )
subject to  |c_i + H_i u| <= cap_i  for every ceiling i,  u within the limits.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Literal, NamedTuple

import numpy as np

from optimizer.arrays import SMALLEST, Complex, Real, Reals, mapped, spread, total
from optimizer.program.limits import Limits
from optimizer.response import Response

Part = Literal["co", "counter"]

#: a ceiling counts as kept up to this share of its size (``Ceilings.size``)
CEILING_TOLERANCE = 1e-9
#: of a sum, in units of the sum of the magnitudes of its terms
_ROUNDING = 4 * np.finfo(float).eps
#: what a term of a weighted peak is the size of: the vector that turns with the shaft, and the one against it
PARTS: tuple[Part, ...] = ("co", "counter")


@dataclass(frozen=True)
class Norms:
    """Terms |c_j + H_j u|; where counterweights scatter, each the largest of all that they may come to.

    Of a quantity that is no vector, such as a moment about the crankshaft, a term is |Re(c_j + H_j u)|: a norm whose
    multiplier y_j is real, with which all that is proven by Re(conj(y_j) (c_j + H_j u)) stands as it is.
    """

    constant: Complex  # (..., J)
    influence: Real | Complex  # (..., J, K)
    scatter: float = 0.0  # share of its unbalance that every counterweight may be off by, in any direction
    scalar: tuple[bool, ...] = ()  # (J,) terms of which only the real part counts; () is none

    def at(self, u: Complex) -> Complex:
        """Vectors c_j + H_j u, (..., J); of scalars the real part."""
        return self.counting(self.constant + np.add.reduce(self.influence * u[..., None, :], axis=-1))

    def counting(self, vectors: Complex) -> Complex:
        """What counts of vectors (..., J), or of their multipliers."""
        return np.where(self.scalar, np.real(vectors), vectors) if any(self.scalar) else vectors

    def sizes(self, u: Complex) -> Real:
        """Sizes of the terms (..., J), all counterweights off in the direction in which the term grows."""
        sizes = np.abs(self.at(u))
        if not self.scatter:
            return sizes
        return sizes + self.scatter * np.add.reduce(np.abs(self.influence) * np.abs(u)[..., None, :], axis=-1)

    @property
    def largest_influence(self) -> Real:
        """Largest |H_jk| over the webs, (..., J); 1 where no web has any."""
        largest = np.maximum.reduce(np.abs(self.influence), axis=-1, initial=0.0)
        return np.where(largest > 0, largest, 1.0)

    def only(self, webs: np.ndarray) -> "Norms":
        # in the usual order in memory, in which sums are the same to the last bit
        return replace(self, influence=self.influence[..., webs].copy())


def scalars(norms: Norms) -> tuple[bool, ...]:
    """Whether each term of one program is a scalar (J,)."""
    return norms.scalar or (False,) * norms.constant.size


@dataclass(frozen=True)
class WeightedPeak:
    """One weighted peak over a turn, as a floor and norm terms.

    A single term is the co-rotating vector; of two the second is the counter-rotating one.
    """

    name: str  # of the response
    floor: Real  # (...)
    norms: Norms
    scenario: str | None = None  # whose response it is


@dataclass(frozen=True)
class Ceilings:
    """Hard limits |c_i + H_i u| <= cap_i; a cap below 0 cannot be met."""

    names: tuple[str, ...]
    norms: Norms
    cap: Real  # (..., I)
    size: Real  # (..., I) > 0, what an excess is measured by
    tolerance: float = CEILING_TOLERANCE  # up to which they count as kept, as a share of the size
    angles_deg: tuple[float | None, ...] | None = None  # (I,) at which a response is limited; None is over the turn
    scenarios: tuple[str | None, ...] | None = None  # (I,) whose response is limited; None is the machine as given

    def excess(self, u: Complex) -> Real:
        """How far each response is above its ceiling, relative to its size; <= 0 if met."""
        if not self.names:
            return self.cap + np.zeros((*u.shape[:-1], 1))
        return (self.norms.sizes(u) - self.cap) / self.size

    def raised(self, share: float) -> "Ceilings":
        """Every ceiling higher by a share of its size, which is taken from the tolerance."""
        return replace(self, cap=self.cap + share * self.size, tolerance=self.tolerance - share)

    def only(self, webs: np.ndarray) -> "Ceilings":
        return replace(self, norms=self.norms.only(webs))


class Term(NamedTuple):
    """What a norm term of the objective is the size of."""

    response: str
    part: Part
    angle_deg: float | None = None  # of the shaft, where it is the response at one angle
    scenario: str | None = None  # whose response it is; None is the machine as it is given


class Names(NamedTuple):
    """What terms and rows of an objective are called where its proof is told."""

    terms: tuple[Term, ...]  # J
    rows: tuple[str, ...]


@dataclass(frozen=True)
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
    def every_constant(self) -> Complex:
        """Constants of the terms of the objective, then of what is under ceilings (..., J + I)."""
        return np.concatenate([self.norms.constant, self.ceilings.norms.constant], axis=-1)

    @cached_property
    def every_influence(self) -> Real | Complex:
        """The same of the influences (..., J + I, K)."""
        return np.concatenate([self.norms.influence, self.ceilings.norms.influence], axis=-2)

    def objective(self, u: Complex) -> Real:
        """P(u), exact (..., )."""
        return self.objective_of(self.norms.sizes(u))

    def objective_of(self, sizes: Real) -> Real:
        """P (...) for sizes of the terms (..., J)."""
        rows = self.rows(sizes)
        # one group is what is asked most, and a point is evaluated twenty times for an answer
        return np.maximum.reduce(rows, axis=-1) if self.group[-1] == 0 else np.add.reduce(self.largest(rows), axis=-1)

    @cached_property
    def at_rest(self) -> Real:
        """P(0) (...)."""
        return self.objective(np.zeros(self.limits.radius.shape, complex))

    @cached_property
    def first_rows(self) -> np.ndarray:
        """First row of each group (groups,)."""
        return np.searchsorted(self.group, np.arange(self.group[-1] + 1))

    def rows(self, sizes: Real) -> Real:
        """Rows of the objective (..., rows) for sizes of its terms (..., J)."""
        return self.floor + np.add.reduce(self.membership * sizes[..., None, :], axis=-1)

    def largest(self, rows: Real) -> Real:
        """Largest of each group (..., groups) of what rows have (..., rows)."""
        return np.maximum.reduceat(rows, self.first_rows, axis=-1)

    def where_largest(self, rows: Real) -> Real:
        """1 at the first of the largest rows of each group, 0 elsewhere (..., rows)."""
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
        names = Names(tuple(Term(name, "co") for name in called), called)
        rows = np.arange(size.shape[-1])
        return Statement(norms, rows, np.zeros_like(rows), -self.ceilings.cap / size, none, self.limits, names)

    def about(self, points: Complex) -> "Statement":
        """The programs in what is added to points (N, K) kg m, under the same limits; of one program N of them."""
        nodes = points.shape[:-1]

        def spread(array: np.ndarray, last: int) -> np.ndarray:
            return np.broadcast_to(array, (*nodes, *array.shape[array.ndim - last :]))

        def moved(norms: Norms) -> Norms:
            constant = norms.constant + np.sum(norms.influence * points[..., None, :], axis=-1)
            return replace(norms, constant=constant, influence=spread(norms.influence, 2))

        each = self.ceilings
        each = replace(each, norms=moved(each.norms), cap=spread(each.cap, 1), size=spread(each.size, 1))
        return replace(self, norms=moved(self.norms), floor=spread(self.floor, 1), ceilings=each)

    def alone(self) -> "Statement":
        """One program as the only one of a leading axis (1,)."""
        return self._mapped(lambda array: array[None])

    def chosen(self, programs: "int | tuple[int, ...] | np.ndarray") -> "Statement":
        """Some of the programs by their leading axes."""
        return self._mapped(lambda array: array[programs])

    def only(self, webs: np.ndarray) -> "Statement":
        """The program with some of the webs (K,) bool."""
        return replace(
            self, norms=self.norms.only(webs), ceilings=self.ceilings.only(webs), limits=self.limits.only(webs)
        )

    def _mapped(self, function: Callable[[Any], Any]) -> "Statement":
        """A function of every array that has the leading axes."""
        return replace(
            self,
            norms=mapped(self.norms, function),
            floor=function(self.floor),
            ceilings=mapped(self.ceilings, function),
            limits=mapped(self.limits, function),
        )


def weighted_peak(response: Response, weight: Reals, weight_x: Reals = 1.0, weight_y: Reals = 1.0) -> WeightedPeak:
    """Weighted peak of a response over a turn, exactly (docs/mathematics.md section 3).

    With p = (w_x + w_y)/2 and q = (w_x - w_y)/2 the weighted vector is the pair of phasors
    p f + q conj(b) and p b + q conj(f), so its peak is |p f + q conj b| + |q f + p conj b|; both are
    affine in u with real factors. With equal weights the second is the constant p |b|, if no shaft turns backwards.

    Parameters
    ----------
    weight, weight_x, weight_y : (...) one for each program.
    """
    p = np.asarray(0.5 * weight * (weight_x + weight_y))
    q = np.asarray(0.5 * weight * (weight_x - weight_y))
    f, b = response.baseline.co, np.conj(response.baseline.counter)
    against = response.counter_influence
    if not q.any() and against is None:
        alone = total((p * f)[..., None, None])
        norms = Norms(alone, p[..., None, None] * response.influence[..., None, :])
        return WeightedPeak(response.name, p * np.abs(b), norms, response.scenario)
    terms = np.broadcast_arrays(p * f, q * b, q * f, p * b)
    constant = total(np.stack(terms, axis=-1).reshape(*terms[0].shape, 2, 2))
    influence = np.stack([p, q], axis=-1)[..., None] * response.influence[..., None, :]
    if against is not None:
        influence = influence + np.stack([q, p], axis=-1)[..., None] * against[..., None, :]
    return WeightedPeak(response.name, np.zeros_like(p), Norms(constant, influence), response.scenario)


class Row(NamedTuple):
    """A sum of weighted peaks."""

    name: str
    peaks: tuple[WeightedPeak, ...]


def combined(peaks: Sequence[WeightedPeak], combine: str) -> tuple[tuple[Row, ...], ...]:
    """The "sum" or the "max" of weighted peaks, at least one, as the only group of an objective."""
    if combine == "max":
        return (tuple(Row(peak.name, (peak,)) for peak in peaks),)
    return ((Row(combine, tuple(peaks)),),)


def statement(groups: Sequence[Sequence[Row]], ceilings: Sequence[tuple[Response, Reals]], limits: Limits) -> Statement:
    """Put a program together, or many of one shape.

    Parameters
    ----------
    groups : what is to be small, at least one: their sum, each the largest of its rows.
    ceilings : responses with the largest peak allowed (...), in the units of the response.
    """
    rows = [row for group in groups for row in group]
    peaks = [peak for row in rows for peak in row.peaks]
    terms = [peak.norms.constant.shape[-1] for peak in peaks]
    owner = [number for number, row in enumerate(rows) for _ in row.peaks]
    norms = _join([peak.norms for peak in peaks])
    leading = norms.constant.shape[:-1]
    floor = np.empty((*leading, len(rows)))
    for number, row in enumerate(rows):
        floor[..., number] = sum(peak.floor for peak in row.peaks)
    return Statement(
        norms=norms,
        row=np.array([number for number, count in zip(owner, terms, strict=True) for _ in range(count)], dtype=int),
        group=np.array([number for number, group in enumerate(groups) for _ in group], dtype=int),
        floor=floor,
        ceilings=limited(ceilings, norms, limits.radius.shape[-1]),
        limits=limits,
        names=Names(
            tuple(Term(peak.name, part) for peak, count in zip(peaks, terms, strict=True) for part in PARTS[:count]),
            tuple(row.name for row in rows),
        ),
    )


def limited(ceilings: Sequence[tuple[Response, Reals]], objective: Norms, webs: int) -> Ceilings:
    """Ceilings on responses beside an objective."""
    leading = objective.constant.shape[:-1]
    none = Norms(np.zeros((*leading, 0), complex), np.zeros((*leading, 0, webs)))
    terms = [Norms(response.baseline.co[..., None], response.influence[..., None, :]) for response, _ in ceilings]
    norms = _join([none, *terms])
    # Peak = |f| + |b| <= ceiling is |f| <= ceiling - |b|
    cap = np.zeros((*leading, len(ceilings)))
    for index, (response, ceiling) in enumerate(ceilings):
        cap[..., index] = ceiling - np.abs(response.baseline.counter)
    size = np.maximum(np.abs(norms.constant), np.abs(cap))
    # where both vanish: what the unbalance that the objective calls for does to the response
    called_for = np.maximum.reduce(np.abs(objective.constant) / objective.largest_influence, axis=-1, initial=0.0)
    size = np.where(size > SMALLEST, size, norms.largest_influence * called_for[..., None])
    size, scenarios = np.where(size > SMALLEST, size, 1.0), tuple(response.scenario for response, _ in ceilings)
    return Ceilings(tuple(response.name for response, _ in ceilings), norms, cap, size, scenarios=scenarios)


def _join(norms: Sequence[Norms]) -> Norms:
    """All terms side by side, (..., J) and (..., J, K)."""
    leading = np.broadcast_shapes(
        *(part.constant.shape[:-1] for part in norms), *(part.influence.shape[:-2] for part in norms)
    )
    constant = [spread(part.constant, (*leading, part.constant.shape[-1])) for part in norms]
    influence = [spread(part.influence, (*leading, *part.influence.shape[-2:])) for part in norms]
    joined = np.concatenate(influence, axis=-2)
    # what is too small to divide by has no influence, as in `total`
    return Norms(np.concatenate(constant, axis=-1), np.where(np.abs(joined) > SMALLEST, joined, 0.0))
