"""One output: what it means, what it needs, its figure in an answer and its columns in a sweep."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.reading import Reading
from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record
from optimizer.outputs.peaks import Search


@record(frozen=True)
class Columns:
    """What an output comes to in a sweep; names, units and meanings are declared in :mod:`schemas.answer.outputs`.

    values : of a scene of designs and their counterweights (n, webs) kg m, nan where there are none; (n,) by column.
    sampled : whether they are read off the samples of the turn.
    needs : effects whose results they read, where the figure reads others.
    keys : of those in detail (:mod:`schemas.sweep.details`), which are computed only for a sweep with one of them.
    alone : whether a design takes about as long as in a single answer, however many there are.
    readings : of the forces of the rows over the turn that they need.
    """

    values: Callable[[Prepared, Complex], Mapping[str, Real]]
    sampled: bool = False
    needs: tuple[str, ...] | None = None
    keys: tuple[str, ...] = ()
    alone: bool = False
    readings: tuple[Reading, ...] = ()


def _none(_scene: Prepared, _unbalance: Complex | None) -> Iterable[Search]:
    return ()


@record(frozen=True)
class Output:
    """An output.

    name, meaning : a word and a line.
    needs : effects whose results it reads; others are let go before.
    figure : its field of the answer, of a scene and the counterweights (webs,) kg m; None where there are none to show.
    columns : of a sweep; None where a sweep cannot hold it.
    searches : peaks over the turn that its figure shows, which are searched together with those of other outputs.
    """

    name: str
    meaning: str
    needs: tuple[str, ...]
    figure: Callable[[Prepared, Complex | None], Any]
    columns: Columns | None = None
    searches: Callable[[Prepared, Complex | None], Iterable[Search]] = _none

    @property
    def column_needs(self) -> tuple[str, ...]:
        """Effects that a sweep runs for the output."""
        if self.columns is None:
            return ()
        return self.needs if self.columns.needs is None else self.columns.needs


def largest(values: Real | Complex, own: int = 2) -> Real:
    """Largest magnitude over the last ``own`` axes, (...); 0 where there is nothing."""
    result: Real = np.max(np.abs(values), axis=tuple(range(-own, 0)), initial=0.0)
    return result
