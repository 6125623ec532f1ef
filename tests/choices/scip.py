"""The same choice as a mixed-integer cone program, by SCIP: an oracle of tests and a rival of benchmarks."""

from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
from pyscipopt import Model, quicksum

from optimizer.choices.discrete.options import Options
from optimizer.program.statement import Statement
from optimizer.studies.matching.problem import Problem

#: units of an objective of its yardstick: SCIP keeps squares to 1e-6, which is 1e-3 of a length of next to nothing
_SCALE = 1e3


class Chosen(NamedTuple):
    """What SCIP found."""

    objective: float  # nan where nothing keeps the limits
    lower_bound: float
    nodes: int
    selection: np.ndarray | None = None  # (K,) the options that it took, where those are asked for


def scip(statement: Statement, options: Options, relative_gap: float, yardstick: float, time_limit_s: float) -> Chosen:
    """One program in a thousandth of its yardstick; without limits of the number of part numbers."""
    if options.most_parts is not None:
        raise NotImplementedError("part numbers are not limited here")
    unit_of_all = yardstick / _SCALE
    model = _model(relative_gap, time_limit_s)
    taken = [
        [model.addVar(vtype="B") for _ in range(int(np.sum(options.exists[k])))] for k in range(options.slots)
    ]  # fmt: skip
    for some in taken:
        model.addCons(quicksum(some) == 1)
    fitted = [(k, o, chance) for k, some in enumerate(taken) for o, chance in enumerate(some) if o > 0]
    if np.isfinite(statement.limits.max_total_mass):
        weighed = quicksum(float(options.mass[k, o]) * chance for k, o, chance in fitted)
        model.addCons(weighed <= float(statement.limits.max_total_mass))
    if options.most_fitted is not None:
        model.addCons(quicksum(chance for _, _, chance in fitted) <= options.most_fitted)

    def size(constant: complex, influence: np.ndarray, unit: float) -> object:
        """A variable no smaller than |c + H u| over a unit."""
        effects = [(complex(influence[k] * options.unbalance[k, o]) / unit, chance) for k, o, chance in fitted]
        return _length(model, complex(constant) / unit, effects)

    norms, ceilings = statement.norms, statement.ceilings
    lengths = [size(c, h, unit_of_all) for c, h in zip(norms.constant, norms.influence, strict=True)]
    groups = [model.addVar(lb=0.0) for _ in np.unique(statement.group)]
    for r, floor in enumerate(statement.floor.tolist()):
        own = quicksum(length for length, row in zip(lengths, statement.row, strict=True) if row == r)
        model.addCons(groups[statement.group[r]] >= floor / unit_of_all + own)
    for i, unit in enumerate(ceilings.size.tolist()):
        length = size(ceilings.norms.constant[i], ceilings.norms.influence[i], unit / _SCALE)
        model.addCons(length <= _SCALE * float(ceilings.cap[i]) / unit)
    solution = _solved(model, quicksum(groups), unit_of_all)
    if not model.getNSols():
        return solution
    return solution._replace(
        selection=np.array([np.argmax([model.getVal(chance) for chance in some]) for some in taken])
    )


def scip_matched(problem: Problem, relative_gap: float, yardstick: float, time_limit_s: float) -> Chosen:
    """Parts on rows, each part a permutation matrix of its class; peaks are sums of lengths, or the largest of two."""
    unit = yardstick / _SCALE
    model, effects = _model(relative_gap, time_limit_s), []
    for places, part in zip(problem.classes, problem.slices, strict=True):
        count, added = places.mass.size, problem.of_place[:, part] / unit
        goes = [[model.addVar(vtype="B") for _ in range(count)] for _ in range(count)]
        for k in range(count):
            model.addCons(quicksum(goes[k]) == 1)
            model.addCons(quicksum(values[k] for values in goes) == 1)
        effects += [(added[:, t] * places.mass[k], goes[k][t]) for k in range(count) for t in range(count)]
    lengths = [
        _length(model, complex(start) / unit, [(complex(effect[j]), chance) for effect, chance in effects])
        for j, start in enumerate(problem.start)
    ]
    peak = model.addVar(lb=0.0)
    for constant, weight in zip(problem.peaks.constant, problem.peaks.weight, strict=True):
        own = quicksum(float(w) * length for w, length in zip(weight, lengths, strict=True))
        model.addCons(peak >= float(constant) / unit + own)
    return _solved(model, peak, unit)


def _model(relative_gap: float, time_limit_s: float) -> Any:
    """An empty program on one core."""
    model = Model()
    model.hideOutput()
    model.setParam("parallel/maxnthreads", 1)
    # of the processor
    model.setParam("timing/clocktype", 1)
    model.setParam("limits/time", time_limit_s)
    model.setParam("limits/absgap", relative_gap * _SCALE)
    return model


def _length(model: Any, constant: complex, effects: Iterable[tuple[complex, Any]]) -> Any:
    """A variable no smaller than |constant + sum of effects|, each taken as often as its variable says."""
    length, parts, listed = model.addVar(lb=0.0), [], list(effects)
    for part in ("real", "imag"):
        component = model.addVar(lb=None)
        model.addCons(
            component == getattr(constant, part) + quicksum(getattr(e, part) * chance for e, chance in listed)
        )
        parts.append(component)
    model.addCons(parts[0] * parts[0] + parts[1] * parts[1] <= length * length)
    return length


def _solved(model: Any, objective: Any, unit: float) -> Chosen:
    """What is found until the gap or the time is reached."""
    model.setObjective(objective, "minimize")
    model.optimize()
    obj_val = model.getObjVal() * unit if model.getNSols() else np.nan
    return Chosen(obj_val, model.getDualbound() * unit, int(model.getNTotalNodes()))
