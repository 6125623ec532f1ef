"""Columns in detail, by output; names, units and meanings are declared in :mod:`schemas.sweep.details`.

A single answer has these figures of every bearing, row and load case; a sweep computes only the columns in its list.
"""

from optimizer.outputs.details.bearings import BEARINGS
from optimizer.outputs.details.first_order import FIRST_ORDER
from optimizer.outputs.details.loads import LOADS
from optimizer.outputs.details.rows import FLYWHEEL, GAS, PISTONS, RODS, TORQUE
from optimizer.outputs.output import Columns

DETAILED: dict[str, tuple[Columns, ...]] = {
    "residual": FIRST_ORDER,
    "gas": GAS,
    "piston_force": PISTONS,
    "rod_loads": RODS,
    "torque": TORQUE,
    "flywheel": FLYWHEEL,
    "loads": LOADS,
    "main_bearings": BEARINGS,
}
