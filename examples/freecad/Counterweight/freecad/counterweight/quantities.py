"""Numbers with a unit, such as ``180 mm``, as the service takes them. No CAD."""

from __future__ import annotations

import re
from decimal import Decimal
from typing import Dict, Optional

_PI = Decimal("3.14159265358979323846264338327950288")
#: unit at the end of a field's name -> unit of a text -> how many of the former it is
UNITS: Dict[str, Dict[str, Decimal]] = {
    "m": {
        "m": Decimal(1), "cm": Decimal("0.01"), "mm": Decimal("0.001"),
        "in": Decimal("0.0254"), "ft": Decimal("0.3048"),
    },
    "kg": {"kg": Decimal(1), "g": Decimal("0.001"), "t": Decimal(1000), "lb": Decimal("0.45359237")},
    "deg": {"deg": Decimal(1), "rad": 180 / _PI},
    "rpm": {"rpm": Decimal(1), "rad/s": 30 / _PI, "Hz": Decimal(60)},
    "N": {"N": Decimal(1), "kN": Decimal(1000), "lbf": Decimal("4.4482216152605")},
    "Nm": {"N m": Decimal(1), "N mm": Decimal("0.001"), "lbf ft": Decimal("1.3558179483314004")},
}  # fmt: skip
_QUANTITY = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3})?)\s*([A-Za-z][A-Za-z/ ]*?)\s*", re.ASCII)


def quantity(name: str, text: str) -> Optional[float]:
    """A text in the unit of a field, correctly rounded; None if it is no number with a unit of that kind."""
    units = UNITS.get(name.rpartition("_")[2], {})
    match = _QUANTITY.fullmatch(text) if len(text) <= 48 else None
    factor = units.get(" ".join(match[2].split())) if match else None
    return float(Decimal(match[1]) * factor) if match and factor else None
