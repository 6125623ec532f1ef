"""The same choice as a mixed-integer cone program, by SCIP: an oracle of tests and a rival of benchmarks."""

from typing import NamedTuple

import numpy as np
from pyscipopt import Model, quicksum

from optimizer.discrete.options import Options
from optimizer.program.statement import Statement

#: units of an objective of its yardstick: SCIP keeps squares to 1e-6, which is 1e-3 of a length of next to nothing
_SCALE = 1e3


class Chosen(NamedTuple):
    """What SCIP found."""

    objective: float  # nan where nothing keeps the limits
    lower_bound: float
    nodes: int


def scip(statement: Statement, options: Options, relative_gap: float, yardstick: float, time_limit_s: float) -> Chosen:
    """One program in a thousandth of its yardstick; without limits of the number of part numbers."""
    if options.most_parts is not None:
        raise NotImplementedError("part numbers are not limited here")
    unit_of_all = yardstick / _SCALE
    model = Model()
    model.hideOutput()
    model.setParam("parallel/maxnthreads", 1)
    model.setParam("limits/time", time_limit_s)
    model.setParam("limits/absgap", relative_gap * _SCALE)
    taken = [
        [model.addVar(vtype="B") for _ in range(int(np.sum(options.exists[k])))] for k in range(options.slots)
    ]  # fmt: skip
    for some in taken:
        model.addCons(quicksum(some) == 1)
    fitted = [(k, o, one) for k, some in enumerate(taken) for o, one in enumerate(some) if o > 0]
    if np.isfinite(statement.limits.max_total_mass):
        weighed = quicksum(float(options.mass[k, o]) * one for k, o, one in fitted)
        model.addCons(weighed <= float(statement.limits.max_total_mass))
    if options.most_fitted is not None:
        model.addCons(quicksum(one for _, _, one in fitted) <= options.most_fitted)

    def size(constant: complex, influence: np.ndarray, unit: float) -> object:
        """A variable no smaller than |c + H u| over a unit."""
        length, parts = model.addVar(lb=0.0), []
        for part in (np.real, np.imag):
            value = model.addVar(lb=None)
            effect = {
                (k, o): float(part(influence[k] * options.unbalance[k, o])) / unit for k, o, _ in fitted
            }  # fmt: skip
            model.addCons(value == float(part(constant)) / unit + quicksum(effect[k, o] * one for k, o, one in fitted))
            parts.append(value)
        model.addCons(parts[0] * parts[0] + parts[1] * parts[1] <= length * length)
        return length

    norms, ceilings = statement.norms, statement.ceilings
    lengths = [size(c, h, unit_of_all) for c, h in zip(norms.constant, norms.influence, strict=True)]
    groups = [model.addVar(lb=0.0) for _ in np.unique(statement.group)]
    for r, floor in enumerate(statement.floor.tolist()):
        own = quicksum(length for length, row in zip(lengths, statement.row, strict=True) if row == r)
        model.addCons(groups[statement.group[r]] >= floor / unit_of_all + own)
    for i, unit in enumerate(ceilings.size.tolist()):
        length = size(ceilings.norms.constant[i], ceilings.norms.influence[i], unit / _SCALE)
        model.addCons(length <= _SCALE * float(ceilings.cap[i]) / unit)
    model.setObjective(quicksum(groups), "minimize")
    model.optimize()
    found = model.getObjVal() * unit_of_all if model.getNSols() else np.nan
    return Chosen(found, model.getDualbound() * unit_of_all, int(model.getNTotalNodes()))
