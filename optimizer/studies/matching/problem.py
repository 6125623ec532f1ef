"""Parts on rows as arrays: what a row is worth, what a part weighs, and what is to be small.

The weighted vectors of force and moment are v = v_0 + V m, with a mass m at every place; what is to be small is the
largest of some convex functions of v, minorants: constant + Re(conj(slope) v) + sum_j weight_j |v_j|.
"""

from dataclasses import replace
from itertools import pairwise

import numpy as np

from optimizer.formulation.balance_shafts import design_space, in_program
from optimizer.formulation.counterweights import unbalance
from optimizer.formulation.formulate import responses, weights
from optimizer.mechanics.inertia import reciprocating, rotating
from optimizer.mechanics.layout import Layout, layout, spread, stacked, web_radii
from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record
from optimizer.responses.response import Response
from schemas.machine.machine import Machine
from schemas.match.request import MatchRequest


@record(frozen=True)
class Minorants:
    """Convex functions of the vectors v (J,), K of them; the largest is what counts."""

    constant: Real  # (K,)
    slope: Complex  # (K, J)
    weight: Real  # (K, J) >= 0

    def at(self, v: Complex) -> Real:
        """The largest of them (...) at vectors (..., J)."""
        if self.constant.size == 1 and not np.any(self.slope):
            plain: Real = self.constant[0] + np.abs(v) @ self.weight[0]
            return plain
        flat = np.real(v @ np.conj(self.slope).T) + np.abs(v) @ self.weight.T
        return np.max(self.constant + flat, axis=-1)

    def plus(self, other: "Minorants") -> "Minorants":
        """These and others."""
        return Minorants(*(np.concatenate([getattr(self, n), getattr(other, n)]) for n in vars(self)))

    def singles(self) -> "list[Minorants]":
        """One by one, and of several their mean."""
        ones = [Minorants(*(getattr(self, n)[k : k + 1] for n in vars(self))) for k in range(self.constant.size)]
        mean = Minorants(*(np.mean(getattr(self, n), axis=0, keepdims=True) for n in vars(self)))
        return ones if len(ones) == 1 else [*ones, mean]


@record(frozen=True)
class Places:
    """Where the parts of one class may lie: its rows, and of nuts as many places beside the machine.

    As many parts lie there as there are places; a row without a nut has one that weighs nothing.
    """

    kind: str
    names: tuple[str | None, ...]  # of the parts, None of one that weighs nothing
    mass: Real  # (n,) kg, of the parts as they are listed, place by place
    row: np.ndarray  # (n,) row of the machine, -1 beside it


@record(frozen=True)
class Problem:
    """Which part goes on which row, over omega squared."""

    start: Complex  # (J,) vectors without the parts
    of_row: Complex  # (J, rows) what a kilogram on a row adds to them
    classes: tuple[Places, ...]
    peaks: Minorants  # the weighted peaks
    terms: np.ndarray  # (J,) of a vector that counterweights change: which term of the program it is; -1 of a floor
    row: np.ndarray  # (J,) which row of the program's objective it belongs to
    start_size: Real  # (J,) what the vectors without the parts are sums of, as lengths: along one axis they cancel
    size_of_row: Real  # (J, rows) the same of what a kilogram on a row adds

    @property
    def rows(self) -> int:
        return int(self.of_row.shape[1])

    @property
    def input_order(self) -> Real:
        """Masses as they are listed (T,), class by class."""
        return np.concatenate([group.mass for group in self.classes])

    @property
    def of_place(self) -> Complex:
        """What a kilogram at a place adds to the vectors (J, T); nothing beside the machine."""
        place = np.concatenate([group.row for group in self.classes])
        return np.where(place >= 0, self.of_row[:, np.maximum(place, 0)], 0.0)

    @property
    def slices(self) -> tuple[slice, ...]:
        """The places of every class among all."""
        ends = np.cumsum([0, *(group.mass.size for group in self.classes)]).tolist()
        return tuple(slice(*pair) for pair in pairwise(ends))

    def vectors(self, mass: Real) -> Complex:
        """The vectors (..., J) of masses at places (..., T)."""
        return self.start + mass @ self.of_place.T

    def row_masses(self, mass: Real) -> Real:
        """What the rows get (..., rows) of masses at places (..., T)."""
        result = np.zeros((*mass.shape[:-1], self.rows))
        for group, part in zip(self.classes, self.slices, strict=True):
            on = group.row >= 0
            result[..., group.row[on]] += mass[..., part][..., on]
        return result

    @property
    def rounding(self) -> float:
        """Rounding error of a value, wherever the parts are: a nut may be on any row, or beside them."""
        heaviest = np.zeros(self.rows)
        for group in self.classes:
            heaviest[group.row[group.row >= 0]] += np.max(group.mass)
        most = self.start_size + self.size_of_row @ heaviest
        return 8 * np.finfo(float).eps * self.input_order.size * float(np.max(self.peaks.weight @ most))


def stated(request: MatchRequest, machine: Machine, fitted: Real, angle_deg: Real) -> Problem:
    """The problem of a request.

    Parameters
    ----------
    machine : with the radii of what is cut from its plates.
    fitted, angle_deg : (K + S,) kg and deg, counterweights that are on the machine, those of balance shafts behind the
        others.
    """
    goal = request.objective
    plan = layout(machine)
    u = unbalance(fitted, angle_deg, web_radii(design_space(machine, goal).machine))
    u = in_program(machine, goal, u)
    response_weights, across = weights(machine, goal), goal.direction_weights
    base = responses(plan, rotating(plan).plus(reciprocating(plan, 1)), goal)
    unit = responses(plan, reciprocating(_per_kilogram(plan), 1), goal)
    weighed = [k for k, response in enumerate(base) if response_weights[response.name] > 0]
    p, q = 0.5 * (across.x + across.y), 0.5 * (across.x - across.y)
    start, of_row, start_size, size_of_row, terms, row = [], [], [], [], [], []
    for number, k in enumerate(weighed):
        weight = response_weights[base[k].name]
        (f, b), (f_unit, b_unit) = _pair(base[k], u), _pair(unit[k], None)
        start.append(weight * _vectors(f, b, p, q))
        of_row.append(weight * _vectors(f_unit, b_unit, p, q))
        start_size.append(weight * _vectors(np.abs(f), np.abs(b), p, abs(q)).real)
        size_of_row.append(weight * _vectors(np.abs(f_unit), np.abs(b_unit), p, abs(q)).real)
        is_paired = q != 0 or base[k].counter_influence is not None
        terms += [2 * number, 2 * number + 1] if is_paired else [number, -1]
        row += [number if goal.combine == "max" else 0] * 2
    owner = np.array(row)
    membership = (owner == np.arange(owner[-1] + 1)[:, None]).astype(float)
    peaks = Minorants(np.zeros(len(membership)), np.zeros(membership.shape, complex), membership)
    return Problem(
        np.concatenate(start),
        np.concatenate(of_row, axis=-1).T,
        _classes(request),
        peaks,
        np.array(terms),
        owner,
        np.concatenate(start_size),
        np.concatenate(size_of_row, axis=-1).T,
    )


def _pair(response: Response, u: Complex | None) -> tuple[Complex, Complex]:
    """What goes round with the shaft and against it (...), both counted the same way."""
    pair = response.baseline if u is None else response.to(u)
    return pair.co, np.conj(pair.counter)


def _vectors(f: Complex | Real, b: Complex | Real, p: float, q: float) -> Complex:
    """The two weighted vectors whose lengths add up to the peak (..., 2): section 3 of the mathematics."""
    return np.stack([p * f + q * b, q * f + p * b], axis=-1)


def _per_kilogram(plan: Layout) -> Layout:
    """The machine as often as it has rows, with one kilogram on one row each."""
    rows = plan.reciprocating.mass.shape[-1]
    many = spread(plan, (rows,))
    return replace(many, reciprocating=replace(many.reciprocating, mass=np.eye(rows)))


def _classes(request: MatchRequest) -> tuple[Places, ...]:
    number = {place: i for i, place in enumerate(request.places)}
    results = [
        Places(
            part.kind,
            part.names,
            stacked(part.masses_kg),
            np.array([number[place] for place in (request.places if part.rows is None else part.rows)]),
        )
        for part in request.parts
    ]
    nuts = request.balance_nuts_kg
    if nuts:
        rows = np.arange(len(number))
        names = (*(None for _ in rows), *(str(k) for k in range(1, len(nuts) + 1)))
        beside = np.full(len(nuts), -1)
        results.append(
            Places("balance_nut", names, np.array([*(0.0 for _ in rows), *nuts]), np.concatenate([rows, beside]))
        )
    return tuple(results)
