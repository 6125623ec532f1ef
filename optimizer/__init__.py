"""From a machine definition to certified counterweights.

What a notebook needs stands here by name, docs/python.md shows it; a request comes from :mod:`schemas`:

    from optimizer import optimize
    from schemas import OptimizeRequest

Every name is loaded at its first use.
"""

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from optimizer.analyze import analyze
    from optimizer.errors import MissingInput
    from optimizer.optimize import optimize
    from optimizer.outputs.descriptions import catalogue
    from optimizer.pins.answer import pin_loads
    from optimizer.rating.rate import rate
    from optimizer.studies.accuracy.measure import accuracy
    from optimizer.studies.matching.match import match
    from optimizer.studies.pareto.pareto import pareto
    from optimizer.studies.rounding.round import round_weights
    from optimizer.studies.sweep.whole import sweep_table

__all__ = [
    "MissingInput",
    "accuracy",
    "analyze",
    "catalogue",
    "match",
    "optimize",
    "pareto",
    "pin_loads",
    "rate",
    "round_weights",
    "sweep_table",
]

_HOMES = {
    "MissingInput": "optimizer.errors",
    "accuracy": "optimizer.studies.accuracy.measure",
    "analyze": "optimizer.analyze",
    "catalogue": "optimizer.outputs.descriptions",
    "match": "optimizer.studies.matching.match",
    "optimize": "optimizer.optimize",
    "pareto": "optimizer.studies.pareto.pareto",
    "pin_loads": "optimizer.pins.answer",
    "rate": "optimizer.rating.rate",
    "round_weights": "optimizer.studies.rounding.round",
    "sweep_table": "optimizer.studies.sweep.whole",
}


class _Package(ModuleType):
    """A module's own ``__getattr__`` comes too late here: a file that is loaded takes the name of its function.

    ``import_module("optimizer.optimize")`` and ``from optimizer.optimize import ...`` reach the file.
    """

    def __getattribute__(self, name: str) -> Any:
        home = _HOMES.get(name)
        return super().__getattribute__(name) if home is None else getattr(import_module(home), name)


sys.modules[__name__].__class__ = _Package
