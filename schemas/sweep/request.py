"""What a client asks of a sweep: a base request, axes through it, and what to keep of the results."""

from collections.abc import Iterator
from itertools import combinations
from typing import Annotated, Any, Literal

from pydantic import Field, PrivateAttr, ValidationInfo, field_validator

from schemas.answer.outputs import OUTPUT_COLUMNS, Column
from schemas.base.model import FieldProblem, Model
from schemas.base.quantities import Angle, Count, Flag
from schemas.base.responses import limited
from schemas.base.rules import Path, Rule, Ruled
from schemas.base.target import BadPointer, Target, find_target
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.machine.throws import MAX_THROWS
from schemas.request.objective import OVER_THE_TURN, outputs_about
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from schemas.sweep.alone import MAX_SEARCHED, alone_problems, searched, separate
from schemas.sweep.axes import MAX_DESIGNS, Axis
from schemas.sweep.columns import MULTIPLIERS, result_columns
from schemas.sweep.crank_orders import MAX_ANGLES, MAX_SEQUENCES, CrankOrders, crank_orders
from schemas.sweep.details import key

MAX_AXES = 64
#: parts of a request that an axis may vary
_ROOTS = ("machine", "objective", "counterweights", "tolerances")
#: field of a scenario that makes no throw another one
_OF_ALL_THROWS = "/machine/speed_rpm"

ColumnName = Annotated[str, Field(max_length=512)]


class TopFilter(Model):
    """Keep the best designs only."""

    by: ColumnName = Field(description="numeric column that designs are ranked by", examples=["force_peak_N"])
    count: Count = Field(20, ge=1, le=1_000_000, description="how many designs to keep", examples=[20])
    largest: Flag = Field(False, description="keep the largest values instead of the smallest", examples=[False])


class SweepRequest(Ruled):
    """Thousands to millions of designs of one machine."""

    task: Literal["optimize", "analyze"] = Field(
        "optimize", description="what is done with every design", examples=["optimize"]
    )
    base: OptimizeRequest | AnalyzeRequest = Field(
        description="the request that every design starts from: the body of /v1/optimize or of /v1/analyze, "
        "as the task says",
        examples=[{"machine": {"kind": "reciprocating"}}],
    )
    axes: tuple[Axis, ...] = Field(
        (),
        max_length=MAX_AXES,
        description="the fields that vary, at least one but for crank_orders, which vary the crank angles",
        examples=[[{"path": "/machine/speed_rpm", "values": [400, 500]}]],
    )
    design: Literal["grid", "paired", "latin_hypercube", "crank_orders"] = Field(
        "grid",
        description="every combination (the last axis varies fastest), the axes side by side, a Latin hypercube, or "
        "all orders of crank angles that are different machines",
        examples=["grid"],
    )
    angles_deg: tuple[Angle, ...] | None = Field(
        None,
        max_length=MAX_THROWS,
        description="crank angles of crank_orders, one for each throw",
        examples=[[0, 120, 240]],
    )
    samples: Count | None = Field(
        None, ge=1, le=MAX_DESIGNS, description="number of designs of a Latin hypercube", examples=[10_000]
    )
    seed: Count = Field(
        0,
        ge=0,
        le=2**63 - 1,
        description="seed of a Latin hypercube; the same seed gives the same designs",
        examples=[0],
    )
    columns: tuple[ColumnName, ...] | None = Field(
        None,
        max_length=4096,
        description="columns of the result; null is all. The index, the status, what top and pareto compare and "
        "multipliers that are asked for always come along",
        examples=[["force_peak_N", "total_mass_kg"]],
    )
    top: TopFilter | None = Field(
        None, description="keep the best designs only; null keeps all", examples=[{"by": "force_peak_N", "count": 20}]
    )
    pareto: Annotated[tuple[ColumnName, ...], Field(min_length=2, max_length=8)] | None = Field(
        None,
        description="keep the designs that no other beats in all these columns, each to be small; null keeps all",
        examples=[["force_peak_N", "moment_peak_Nm"]],
    )
    details: Flag = Field(
        False,
        description="every column in detail comes along. It has, by bearing, row and load case, what single answers"
        " have beside the usual columns. Otherwise only those that are named in columns, top or pareto",
        examples=[False],
    )
    multipliers: Flag = Field(
        False,
        description="a column of the multipliers of the certificates, as JSON text; serves only to optimize",
        examples=[False],
    )
    dry_run: Flag = Field(
        False, description="only count the designs and estimate the size of the result", examples=[False]
    )

    _targets: tuple[Target, ...] = PrivateAttr(())
    _crank_orders: CrankOrders | None = PrivateAttr(None)

    @field_validator("base", mode="wrap")
    @classmethod
    def _of_the_task(cls, value: Any, _handler: Any, info: ValidationInfo) -> OptimizeRequest | AnalyzeRequest:
        model = AnalyzeRequest if info.data.get("task") == "analyze" else OptimizeRequest
        if isinstance(value, OptimizeRequest | AnalyzeRequest):
            value = value.model_dump()
        return model.model_validate(value)

    def rules(self) -> Iterator[Rule]:
        # each sees only what passed the checks before
        has_orders = self.design == "crank_orders"
        designs = (self._axis_problems, self._design_problems, self._search_problems)
        varied = (self._order_problems,) if has_orders else designs
        for part in (self._output_problems, self._angle_problems, *varied, self._column_problems):
            problems = list(part())
            yield from (Rule(True, path, message) for path, message in problems)
            if problems:
                return

    @property
    def targets(self) -> tuple[Target, ...]:
        """The field of each axis."""
        return self._targets

    @property
    def crank_orders(self) -> CrankOrders | None:
        """What is put in order along the shaft, if that is the design."""
        return self._crank_orders

    @property
    def total(self) -> int:
        """Number of designs."""
        if self.crank_orders is not None:
            return self.crank_orders.count
        if self.design == "latin_hypercube":
            return self.samples or 0
        levels = [axis.levels or 0 for axis in self.axes]
        if self.design == "paired":
            return levels[0]
        product = 1
        for count in levels:
            product *= count
        return product

    @property
    def over_the_turn(self) -> tuple[str, ...]:
        """Fields of the objective that look at the whole turn and that the base gives or an axis varies."""
        if not isinstance(self.base, OptimizeRequest):
            return ()
        varied = {str(target.path[1]) for target in self.targets if target.path[0] == "objective"}
        fields = self.base.objective.over_the_turn
        return tuple(name for name in OVER_THE_TURN if name in fields or name in varied)

    @property
    def separate(self) -> bool:
        """Whether its designs are no batch: they are searched, cut from plates or alike."""
        return separate(self.base, self.targets)

    @property
    def searched(self) -> bool:
        """Whether the counterweights of its designs are searched among discrete choices."""
        return searched(self.base, self.targets)

    @property
    def always(self) -> tuple[str, ...]:
        """Outputs with columns in every row, whether the request names them or not."""
        return outputs_about(self.over_the_turn)

    @property
    def all_columns(self) -> tuple[Column, ...]:
        """The columns that come along where none are named."""
        return result_columns(self.base, self.targets, self.multipliers, self.always, self.details)

    @property
    def possible_columns(self) -> tuple[Column, ...]:
        """Every column that the result could have, those in detail too."""
        return result_columns(self.base, self.targets, self.multipliers, self.always, True)

    @property
    def column_selection(self) -> tuple[Column, ...]:
        """The columns of the result, in their usual order."""
        usual = [column.name for column in self.all_columns] if self.columns is None else self.columns
        names = {"index", "status", *usual, *(self.pareto or ())}
        if self.top is not None:
            names.add(self.top.by)
        if self.multipliers:
            names.add(MULTIPLIERS)
        return tuple(column for column in self.possible_columns if column.name in names)

    @property
    def column_keys(self) -> frozenset[str]:
        """Names of these, without the parts that they are about: what rows need hold."""
        return frozenset(key(column.name) for column in self.column_selection)

    def _output_problems(self) -> Iterator[FieldProblem]:
        if self.multipliers and self.task != "optimize":
            yield FieldProblem(("multipliers",), "serves only to optimize: what is analyzed has no certificate")
        yield from alone_problems(self.base)
        if isinstance(self.base, OptimizeRequest):
            no_columns = "remove it: a row has no columns for cheaper choices"
            for broken, path, message in self.base.allowance_rules(no_columns):
                if broken:
                    yield FieldProblem(("base", *path), message)
        for j, output in enumerate(self.base.outputs):
            if output not in OUTPUT_COLUMNS:
                yield FieldProblem(("base", "outputs", j), "a sweep has no columns for this output")

    def _angle_problems(self) -> Iterator[FieldProblem]:
        if self.design != "crank_orders" and self.angles_deg is not None:
            yield FieldProblem(("angles_deg",), "serves only crank_orders")
        if self.design != "crank_orders" and not self.axes:
            yield FieldProblem(("axes",), "must hold at least one item")

    def _order_problems(self) -> Iterator[FieldProblem]:
        machine, angles = self.base.machine, self.angles_deg
        if self.axes:
            yield FieldProblem(("axes",), "crank_orders vary the crank angles alone")
        if self.samples is not None:
            yield FieldProblem(("samples",), "serves only a Latin hypercube")
        if not isinstance(machine, ReciprocatingMachine):
            yield FieldProblem(("base", "machine", "kind"), "crank_orders need a machine with throws")
        elif angles is None or len(angles) != len(machine.throws):
            yield FieldProblem(("angles_deg",), f"give one angle for each of the {len(machine.throws)} throws")
        elif len(angles) > MAX_ANGLES:
            yield FieldProblem(("angles_deg",), f"at most {MAX_ANGLES} throws are put in order")
        else:
            fitted = isinstance(self.base, AnalyzeRequest) and bool(self.base.counterweights)
            orders = crank_orders(machine, angles, self._alike_across, fitted, self._changes_parts)
            if orders.sequence_count > MAX_SEQUENCES:
                message = f"at most {MAX_SEQUENCES} sequences are looked through; these angles make more"
                yield FieldProblem(("angles_deg",), message)
            self._crank_orders = orders
            paths = (f"/machine/throws/{t}/crank_angle_deg" for t in range(len(angles)))
            self._targets = tuple(find_target(self.base, path) for path in paths)
            yield from self._search_problems()

    @property
    def _changes_parts(self) -> bool:
        """Whether scenarios change more than the speed, which all throws have in common."""
        cases = self.base.cases if isinstance(self.base, OptimizeRequest) else ()
        return any(change.path != _OF_ALL_THROWS for case in cases for change in case.scenario.changes)

    @property
    def _alike_across(self) -> bool:
        """Whether the objective knows no direction across the shaft."""
        if not isinstance(self.base, OptimizeRequest):
            return True
        goal = self.base.objective
        along = any(ceiling.axis is not None for ceiling in limited(goal))
        return goal.direction_weights.x == goal.direction_weights.y and not along

    def _axis_problems(self) -> Iterator[FieldProblem]:
        targets: dict[int, Target] = {}
        for i, axis in enumerate(self.axes):
            try:
                targets[i] = find_target(self.base, axis.path)
            except BadPointer as error:
                yield FieldProblem(("axes", i, "path"), str(error))
                continue
            if targets[i].path[0] not in _ROOTS:
                message = "only fields of machine, objective, counterweights and tolerances can vary"
                yield FieldProblem(("axes", i, "path"), message)
            yield from _value_problems(i, axis, targets[i])
        for (_, first), (i, second) in combinations(targets.items(), 2):
            common = min(len(first.path), len(second.path))
            if first.path == second.path:
                yield FieldProblem(("axes", i, "path"), "another axis varies this field already")
            elif first.path[:common] == second.path[:common]:
                yield FieldProblem(("axes", i, "path"), "another axis varies a field that holds this one or lies in it")
        self._targets = tuple(targets.values())

    def _design_problems(self) -> Iterator[FieldProblem]:
        if self.design == "latin_hypercube":
            if self.samples is None:
                yield FieldProblem(("samples",), "a Latin hypercube needs the number of samples")
            return
        if self.samples is not None:
            yield FieldProblem(("samples",), "serves only a Latin hypercube")
        levels = [axis.levels for axis in self.axes]
        for i, count in enumerate(levels):
            if count is None:
                yield FieldProblem(("axes", i, "count"), "a range needs the number of its values")
            elif self.design == "paired" and levels[0] is not None and count != levels[0]:
                name = "count" if self.axes[i].values is None else "values"
                yield FieldProblem(("axes", i, name), f"paired axes need equally many values: {levels[0]}")
        if self.design == "grid" and None not in levels and self.total > MAX_DESIGNS:
            yield FieldProblem(("axes",), f"a sweep holds at most {MAX_DESIGNS} designs; these axes make {self.total}")

    def _search_problems(self) -> Iterator[FieldProblem]:
        if self.searched and self.total > MAX_SEARCHED:
            message = f"at most {MAX_SEARCHED} designs are searched one by one; these make {self.total}"
            field = {"latin_hypercube": "samples", "crank_orders": "angles_deg"}.get(self.design, "axes")
            yield FieldProblem((field,), message)

    def _column_problems(self) -> Iterator[FieldProblem]:
        kinds = {column.name: column.kind for column in self.possible_columns}
        for j, name in enumerate(self.columns or ()):
            if name not in kinds:
                yield FieldProblem(("columns", j), "the result has no column of this name")
        compared: list[tuple[Path, str]] = [(("pareto", j), name) for j, name in enumerate(self.pareto or ())]
        if self.top is not None:
            compared.append((("top", "by"), self.top.by))
        for path, name in compared:
            if kinds.get(name) != "number":
                yield FieldProblem(path, "the result has no numeric column of this name")
        if self.pareto is not None and len(set(self.pareto)) < len(self.pareto):
            yield FieldProblem(("pareto",), "a column may be named only once")
        if self.top is not None and self.pareto is not None:
            yield FieldProblem(("pareto",), "give either top or pareto")


def _value_problems(i: int, axis: Axis, target: Target) -> Iterator[FieldProblem]:
    """Values that the field cannot take whatever its range: wrong unit, text, null."""
    entries: list[tuple[Path, Any]]
    if axis.values is not None:
        entries = [(("axes", i, "values", j), value) for j, value in enumerate(axis.values)]
    else:
        entries = [(("axes", i, "start"), axis.start), (("axes", i, "stop"), axis.stop)]
    numbers = []
    for path, value in entries:
        try:
            numbers.append(target.number(value))
        except ValueError as error:
            yield FieldProblem(path, str(error))
    if axis.values is None and axis.spacing == "log" and len(numbers) == len(entries):
        for (path, _), number in zip(entries, numbers, strict=True):
            if number is not None and not number > 0:
                yield FieldProblem(path, "a logarithmic range needs ends above 0")
