"""From numbers of designs to columns of the result: axes, validity, mechanics, program, outputs."""

import logging
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from itertools import chain
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from optimizer.errors import NotComputable
from optimizer.formulation.counterweights import too_heavy
from optimizer.formulation.placement import on_webs
from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.memoization import remembered
from optimizer.outputs.registry import columns, input_rules
from optimizer.outputs.requirements import missing
from optimizer.studies.sweep.counterweights import fixed_columns, optimal, shape_keys
from optimizer.studies.sweep.designs import axis_values
from optimizer.studies.sweep.singles import single_optima
from optimizer.studies.sweep.work import work_per_design
from schemas.base.rules import Path, Rule, all_rules
from schemas.base.target import pointer
from schemas.base.variation import with_fields
from schemas.request.objective import outputs_about
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from schemas.sweep.request import SweepRequest

_LOG = logging.getLogger(__name__)
Designs = NDArray[np.int64]
Base = TypeVar("Base", OptimizeRequest, AnalyzeRequest)
#: rows times angles that are worked on at once, which bounds the memory
_AT_ONCE = 400_000


class Rows:
    """Columns of a range of designs, filled group by group; nan and None stand for what is not there."""

    def __init__(self, request: SweepRequest, start: int, stop: int) -> None:
        self._count = stop - start
        self._blank = _blank_columns(request)
        self._columns: dict[str, Any] = {"index": np.arange(start, stop, dtype=np.int64)}
        #: columns that whoever computed them holds too, to which nothing is written
        self._shared = set[str]()
        self._labels = {"index", *(pointer(target.path) for target in request.targets)}
        self._faults: dict[str, tuple[list[int], Exception]] = {}

    @property
    def columns(self) -> dict[str, Any]:
        """All of them by name; those of one value for all designs take no memory."""
        return {name: self._columns[name] if name in self._columns else self._missing(name) for name in self._blank}

    def put(self, designs: Designs, columns: dict[str, Any]) -> None:
        """Columns of some designs; those that the result does not have are left out."""
        # all of them stand in their order
        whole = designs.size == self._count
        for name, column in columns.items():
            if name not in self._blank:
                continue
            if whole:
                # most are as long as they shall be: to see that takes less than numpy's own look
                long = isinstance(column, np.ndarray) and column.shape == (self._count,)
                self._columns[name] = column if long else np.broadcast_to(column, (self._count,))
                self._shared.add(name)
            else:
                self._own(name)[designs] = column

    def infeasible(self, designs: Designs) -> NDArray[np.bool_]:
        """Which designs have no counterweights, as nothing keeps their ceilings."""
        status = self._columns["status"]
        return np.asarray((status if designs.size == self._count else status[designs]) == "infeasible")

    def refuse(self, designs: Designs, rule: Rule) -> None:
        """Designs that are no valid requests."""
        self._own("status")[designs] = "invalid"
        self._own("message")[designs] = f"{pointer(rule.path)}: {rule.message}"

    def fail(self, design: int, error: Exception) -> None:
        """A design whose computation failed: its row shows no figures of before the failure."""
        for name in self._blank:
            if name not in self._labels:
                self._own(name)[design] = self._blank[name]
        self._own("status")[design] = "failed"
        text = f"{type(error).__name__}: {error}"
        self._own("message")[design] = f"internal fault: {text}"
        self._faults.setdefault(text, ([], error))[0].append(int(self._columns["index"][design]))

    def tell_faults(self) -> None:
        """Log what designs broke down for, once for all that say the same."""
        for text, (designs, error) in self._faults.items():
            _LOG.error(
                "%d design(s) of a sweep broke down, %d first: %s", len(designs), designs[0], text, exc_info=error
            )

    def _missing(self, name: str) -> NDArray[Any]:
        """A column of which nothing is there."""
        blank = self._blank[name]
        return np.broadcast_to(np.array(blank, dtype=object if blank is None else float), self._count)

    def _own(self, name: str) -> NDArray[Any]:
        """A column to write to."""
        if name not in self._columns or name in self._shared:
            column = self._columns[name] if name in self._columns else self._missing(name)
            self._columns[name] = np.array(column, dtype=object if self._blank[name] is None else float)
            self._shared.discard(name)
        own: NDArray[Any] = self._columns[name]
        return own


@remembered
def _blank_columns(request: SweepRequest) -> dict[str, float | None]:
    """Columns by name, with what stands where a design has none."""
    columns = (*request.all_columns, *request.column_selection)
    return {column.name: np.nan if column.kind == "number" else None for column in columns}


@remembered
def _column_keys(request: SweepRequest) -> frozenset[str]:
    return request.column_keys


def rows(request: SweepRequest, start: int, stop: int) -> dict[str, Any]:
    """Every column of the designs start..stop-1, by name.

    A design that is no valid request is a row that says which field is wrong; it ends nothing. Nor does one that
    computing breaks down for, by whatever exception: its row says so, and the exception is logged.

    Raises
    ------
    MemoryError
        as fewer rows at a time may fit.
    """
    values = axis_values(request, start, stop)
    table = Rows(request, start, stop)
    table.put(np.arange(stop - start), {pointer(t.path): v for t, v in zip(request.targets, values, strict=True)})
    ranges = (rule for target, column in zip(request.targets, values, strict=True) for rule in target.rules(column))
    inside = _refuse(table, np.arange(stop - start), ranges)
    for designs in _same_nulls(values, inside):
        _fill_or_fail(table, _fill(request, values, table), designs)
    table.tell_faults()
    return table.columns


class Group(Generic[Base]):
    """The varied requests of a range of designs.

    base : of the sweep, which every design starts from.
    """

    def __init__(self, request: SweepRequest, base: Base, values: Sequence[Real]) -> None:
        self._base: Base = base
        self._targets, self._values = request.targets, values
        self.multipliers, self.always = request.multipliers, request.always
        self.column_keys = _column_keys(request)
        #: by an output that all hold, designs without it: their goals are not about it, and their machines lack what it
        #: needs
        self.bare: dict[str, set[int]] = {output: set() for output in self.always}
        #: whether the objective of some design may look at the whole turn
        self.turns = bool(request.over_the_turn)
        self._last: tuple[Designs, Base] | None = None

    def of(self, designs: Designs) -> Base:
        """Some designs, with the same fields null in all, as one request of columns.

        Of the very same array it is the very same request, of whose machine much is remembered.
        """
        if self._last is None or self._last[0] is not designs:
            self._last = designs, self._columns(designs)
        return self._last[1]

    def _columns(self, designs: Designs) -> Base:
        contents: dict[Path, Any] = {}
        for target, column in zip(self._targets, self._values, strict=True):
            values = column[designs]
            contents[target.path] = None if np.isnan(values[0]) else values
        return with_fields(self._base, contents)

    def single(self, design: int) -> Base:
        """One design as a request of numbers."""
        contents: dict[Path, Any] = {}
        for target, column in zip(self._targets, self._values, strict=True):
            number = float(column[design])
            contents[target.path] = None if np.isnan(number) else int(number) if target.integer else number
        # an axis may ask for a search, of which another gap is usual
        return with_fields(self._base, contents).with_usual_gap


AnyGroup = Group[OptimizeRequest] | Group[AnalyzeRequest]


def _fill(request: SweepRequest, values: Sequence[Real], table: Rows) -> Callable[[Designs], None]:
    """Fills rows of some designs that have the same fields null."""
    base = request.base
    if isinstance(base, AnalyzeRequest):
        return partial(_fill_analyzed, table, Group(request, base, values))
    fill = _fill_singles if request.separate else _fill_optima
    return partial(fill, table, Group(request, base, values))


def _fill_or_fail(table: Rows, fill: Callable[[Designs], None], designs: Designs) -> None:
    """Rows of some designs; where computing breaks down, of halves of them, until the designs at fault are alone."""
    try:
        fill(designs)
    except MemoryError:
        raise
    except Exception as error:
        if designs.size == 1:
            table.fail(int(designs[0]), error)
            return
        for half in np.array_split(designs, 2):
            _fill_or_fail(table, fill, half)


def _fill_analyzed(table: Rows, group: Group[AnalyzeRequest], designs: Designs) -> None:
    """Rows of designs with counterweights in the request."""
    designs = _refuse(table, designs, all_rules(group.of(designs)))
    designs = _with_inputs(table, group, designs, {})
    if designs.size:
        columns, unbalance = fixed_columns(on_webs(group.of(designs)), designs.size)
        table.put(designs, columns)
        _fill_outputs(table, group, designs, unbalance)


def _over_the_turn(group: Group[OptimizeRequest], designs: Designs) -> dict[int, OptimizeRequest]:
    """Those designs whose objective looks at the whole turn, each by itself."""
    alone = ((design, group.single(design)) for design in (designs.tolist() if group.turns else ()))
    return {design: request for design, request in alone if request.objective.over_the_turn}


def _fill_optima(table: Rows, group: Group[OptimizeRequest], designs: Designs) -> None:
    """Rows of designs of which those of the first order are many programs of one shape."""
    designs = _refuse(table, designs, all_rules(group.of(designs)))
    turning = _over_the_turn(group, designs)
    for design, alone in turning.items():
        lacking = next(missing(alone.machine, alone.objective), None)
        if lacking is not None:
            table.refuse(np.array([design]), Rule(True, *lacking))
            designs = designs[designs != design]
    designs = _with_inputs(table, group, designs, turning)
    if not designs.size:
        return
    if not turning:
        _fill_first_order(table, group, designs)
        return
    cut = np.isin(designs, list(turning))
    if np.any(cut):
        results, unbalance = single_optima([turning[int(design)] for design in designs[cut]], group.multipliers)
        table.put(designs[cut], results)
        _fill_outputs(table, group, designs[cut], unbalance)
    if not np.all(cut):
        _fill_first_order(table, group, designs[~cut])


def _fill_singles(table: Rows, group: Group[OptimizeRequest], designs: Designs) -> None:
    """Rows of designs that are searched, cut from plates or alike: as single answers are."""
    unbalances: dict[int, Complex] = {}
    for design in designs.tolist():
        alone, at = group.single(design), np.array([design])
        if not _refuse(table, at, all_rules(alone)).size:
            continue
        lacking = missing(alone.machine, alone.objective) if alone.objective.over_the_turn else ()
        refusal = next(chain(lacking, too_heavy(alone.machine, alone.fitted, "fitted")), None)
        if not _refuse(table, at, [Rule(True, *refusal)] if refusal else []).size:
            continue
        if not _with_inputs(table, group, at, {design: alone}).size:
            continue
        try:
            columns, unbalance = single_optima([alone], group.multipliers)
        except NotComputable as error:
            table.refuse(at, Rule(True, *error.problems[0]))
            continue
        table.put(at, columns)
        unbalances[design] = unbalance[0]
    if unbalances:
        _fill_outputs(table, group, np.array(list(unbalances)), np.array(list(unbalances.values())))


def _fill_first_order(table: Rows, group: Group[OptimizeRequest], designs: Designs) -> None:
    """Rows of designs whose objective is about the first order, those of one shape of program together."""
    keys = shape_keys(group.of(designs), designs.size)
    for key in keys[:1] if (keys == keys[:1]).all() else np.unique(keys):
        alike = _among(designs, keys == key)
        results, unbalance = optimal(group.of(alike), alike.size, group.multipliers)
        table.put(alike, results)
        _fill_outputs(table, group, alike, unbalance)


def _with_inputs(table: Rows, group: AnyGroup, designs: Designs, turning: Mapping[int, OptimizeRequest]) -> Designs:
    """The designs whose machines give what their outputs need; the others say what is missing.

    Parameters
    ----------
    turning : by itself every design whose goals may be about what all rows hold.
    """
    if designs.size:
        request = group.of(designs)
        designs = _refuse(table, designs, input_rules(request.machine, request.outputs))
    for output in group.always if designs.size else ():
        rules = list(input_rules(group.of(designs).machine, (output,)))
        lacking = np.any([np.broadcast_to(rule.broken, designs.shape) for rule in rules], axis=0) if rules else False
        about = [design for design, alone in turning.items() if output in outputs_about(alone.objective.over_the_turn)]
        bare = lacking & ~np.isin(designs, about)
        group.bare[output].update(designs[bare].tolist())
        designs = np.sort(np.concatenate([designs[bare], _refuse(table, designs, rules, ~bare)]))
    return designs


def _fill_outputs(table: Rows, group: AnyGroup, designs: Designs, unbalance: Complex) -> None:
    """Columns of the outputs, of designs that hold the same ones together."""
    if not any(group.bare.values()):
        _fill_columns(table, group, designs, unbalance, group.always)
        return
    lacks = np.stack([np.isin(designs, list(bare)) for bare in group.bare.values()], axis=-1)
    for pattern in np.unique(lacks, axis=0):
        mask = (lacks == pattern).all(axis=-1)
        outputs = tuple(output for output, without in zip(group.bare, pattern.tolist(), strict=True) if not without)
        _fill_columns(table, group, designs[mask], unbalance[mask], outputs)


def _fill_columns(table: Rows, group: AnyGroup, designs: Designs, unbalance: Complex, always: tuple[str, ...]) -> None:
    """The same of some designs, in blocks that fit into memory."""
    # without counterweights there is nothing with them
    none = table.infeasible(designs)
    fitted = np.where(none[:, None], np.nan, unbalance) if none.any() else unbalance
    size = max(1, _AT_ONCE // max(work_per_design(group.of(designs), always, group.column_keys), 1))
    for first in range(0, designs.size, size):
        block = designs[first : first + size] if size < designs.size else designs
        part = group.of(block)
        outputs = ("residual", *always) if isinstance(part, OptimizeRequest) else ()
        part = on_webs(part) if isinstance(part, AnalyzeRequest) else part
        table.put(block, columns(part, fitted[first : first + size], outputs, group.column_keys))


def _refuse(table: Rows, designs: Designs, rules: Iterable[Rule], among: NDArray[np.bool_] | None = None) -> Designs:
    """The designs that break no rule; the others say which they break first.

    Parameters
    ----------
    among : (n,) of which designs; None is all.
    """
    valid = np.ones(designs.size, dtype=bool) if among is None else among.copy()
    for rule in rules:
        # most hold for all designs, whatever varies
        if rule.broken is not False:
            broken = valid & rule.broken
            if np.any(broken):
                table.refuse(designs[broken], rule)
                valid &= ~broken
    return _among(designs, valid)


def _among(designs: Designs, mask: NDArray[np.bool_]) -> Designs:
    """Some of the designs; of all of them the very same array."""
    return designs if mask.all() else designs[mask]


def _same_nulls(values: Sequence[Real], designs: Designs) -> Iterator[Designs]:
    """The designs in groups that have the same fields null."""
    nulls = np.stack([np.isnan(column[designs]) for column in values], axis=-1)
    if not np.any(nulls):
        groups = [designs] if designs.size else []
    else:
        patterns, inverse = np.unique(nulls, axis=0, return_inverse=True)
        groups = [designs[inverse.reshape(-1) == k] for k in range(len(patterns))]
    yield from groups
