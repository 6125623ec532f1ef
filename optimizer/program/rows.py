"""Weighted peaks, the rows that they add up to, and the program that makes these small."""

from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import SMALLEST, Real, Reals, total
from optimizer.numerics.records import record
from optimizer.program.ceilings import limited
from optimizer.program.limits import Limits
from optimizer.program.norms import Norms, join
from optimizer.program.statement import PARTS, Names, Statement, Term
from optimizer.responses.response import Response


@record(frozen=True)
class WeightedPeak:
    """One weighted peak over a turn, as a floor and norm terms.

    A single term is the co-rotating vector; of two the second is the counter-rotating one.
    """

    name: str  # of the response
    floor: Real  # (...)
    norms: Norms
    scenario: str | None = None  # whose response it is


def weighted_peak(response: Response, weight: Reals, weight_x: Reals = 1.0, weight_y: Reals = 1.0) -> WeightedPeak:
    """Weighted peak of a response over a turn, exactly (docs/mathematics.md section 3).

    With p = (w_x + w_y)/2 and q = (w_x - w_y)/2 the weighted vector is the pair of phasors
    p f + q conj(b) and p b + q conj(f), so its peak is |p f + q conj b| + |q f + p conj b|; both are
    affine in u with real factors. With equal weights the second is the constant p |b|, if no shaft turns backwards.

    Parameters
    ----------
    weight, weight_x, weight_y : (...) one for each program.
    """
    # of one program mostly numbers, which take a tenth of the time of arrays
    p, q = 0.5 * weight * (weight_x + weight_y), 0.5 * weight * (weight_x - weight_y)
    f, b = response.baseline.co, response.baseline.counter
    against = response.counter_influence
    if against is None and type(p) is float and not q and np.ndarray not in (type(f), type(b)):
        # of one machine in plain numbers
        vector = complex(p * f)
        constant = np.array([vector if abs(vector) > SMALLEST else 0.0], complex)
        norms = Norms(constant, p * response.influence[None])
        return WeightedPeak(response.name, p * np.abs(b), norms, response.scenario)
    if against is None and not (np.count_nonzero(q) if isinstance(q, np.ndarray) else q):
        alone = p * f
        # what is too small to divide by is none, as in `total`
        alone = (alone * (np.abs(alone) > SMALLEST))[..., None]
        factor = p[..., None, None] if isinstance(p, np.ndarray) else p
        norms = Norms(alone, factor * response.influence[..., None, :])
        return WeightedPeak(response.name, p * np.abs(b), norms, response.scenario)
    b = np.conj(b)
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
    # loops, as a comprehension is a function of its own
    parts, floors, shape, count = [], [], [], []
    for group in groups:
        count.append(len(group))
        for row in group:
            value: Reals = 0.0
            peaks = []
            for peak in row.peaks:
                parts.append(peak.norms)
                value = value + peak.floor
                peaks.append((peak.name, peak.scenario, peak.norms.constant.shape[-1]))
            floors.append(value)
            shape.append((row.name, tuple(peaks)))
    norms = join(parts)
    floor = np.empty((*norms.constant.shape[:-1], len(floors)))
    for number, value in enumerate(floors):
        floor[..., number] = value
    places = _places(tuple(count), tuple(shape))
    return Statement(
        norms=norms,
        row=places.row,
        group=places.group,
        floor=floor,
        ceilings=limited(ceilings, norms, limits.radius.shape[-1]),
        limits=limits,
        names=places.names,
    )


class _Places(NamedTuple):
    """Where terms and rows of a program belong, and what they are called; nobody writes to it."""

    row: np.ndarray  # (J,) of each term
    group: np.ndarray  # (rows,)
    names: Names


# of the few shapes that recur
@lru_cache(maxsize=128)
def _places(groups: tuple[int, ...], rows: tuple[tuple[str, tuple[tuple[str, str | None, int], ...]], ...]) -> _Places:
    """Those of one shape.

    Parameters
    ----------
    groups : rows of each.
    rows : their names, and the name, the scenario and the number of terms of each of their peaks.
    """
    owner = [number for number, (_, peaks) in enumerate(rows) for _, _, count in peaks for _ in range(count)]
    terms = (
        Term(name, part, None, scenario)
        for _, peaks in rows
        for name, scenario, count in peaks
        for part in PARTS[:count]
    )
    return _Places(
        np.array(owner, dtype=int),
        np.repeat(np.arange(len(groups)), groups),
        Names(tuple(terms), tuple(name for name, _ in rows)),
    )


def total_mass(limits: Limits, share: float = 0.0, besides: float = 0.0) -> Row:
    """The total mass of the counterweights [kg], a term for each web; without webs one that is 0.

    Parameters
    ----------
    share, besides : by which all terms of the program scatter: by so much these are less, as no mass is meant that is
        off.
    """
    radius = limits.radius
    of_web = np.eye(max(radius.size, 1), radius.size) / (np.where(radius > 0, radius, 1.0) * (1.0 + share))
    nothing = np.zeros(1, dtype=complex)
    return Row(
        "mass",
        tuple(
            WeightedPeak("mass", np.asarray(-besides * np.sum(influence)), Norms(nothing, influence[None]))
            for influence in of_web
        ),
    )
