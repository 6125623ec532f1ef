"""From a machine definition to certified counterweights.

What a notebook needs stands here by name, docs/python.md shows it; a request comes from :mod:`schemas`:

    from optimizer import optimize
    from schemas import OptimizeRequest

Everything is loaded when it is first asked for.
"""

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from optimizer.accuracy.measure import accuracy
    from optimizer.analyze import analyze
    from optimizer.catalogue import catalogue
    from optimizer.errors import MissingInput
    from optimizer.matching.match import match
    from optimizer.optimize import optimize
    from optimizer.pareto.pareto import pareto
    from optimizer.pins.answer import pin_loads
    from optimizer.rating.rate import rate
    from optimizer.sweep.whole import sweep_table

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
    "sweep_table",
]

_HOMES = {
    "MissingInput": "optimizer.errors",
    "accuracy": "optimizer.accuracy.measure",
    "analyze": "optimizer.analyze",
    "catalogue": "optimizer.catalogue",
    "match": "optimizer.matching.match",
    "optimize": "optimizer.optimize",
    "pareto": "optimizer.pareto.pareto",
    "pin_loads": "optimizer.pins.answer",
    "rate": "optimizer.rating.rate",
    "sweep_table": "optimizer.sweep.whole",
}


class _Package(ModuleType):
    """A module's own ``__getattr__`` is asked too late here: a file that is loaded takes the name of its function.

    ``import_module("optimizer.optimize")`` and ``from optimizer.optimize import ...`` reach the file.
    """

    def __getattribute__(self, name: str) -> Any:
        home = _HOMES.get(name)
        return super().__getattribute__(name) if home is None else getattr(import_module(home), name)


sys.modules[__name__].__class__ = _Package
