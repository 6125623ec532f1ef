"""Co- and counter-rotating phasors of one order as an answer holds them: few, and so plain numbers, not arrays."""

import math
from typing import Any

from optimizer.mechanics.inertia import Wrench

#: of force [N] and of moment [N m], each a vector that turns with the shaft and one against it
Vectors = tuple[tuple[complex, complex], tuple[complex, complex]]
PARTS = (("force", "N"), ("moment", "Nm"))


def vectors_of(wrench: Wrench) -> Vectors:
    """Phasors of a wrench of one machine."""
    force, moment = wrench
    return (complex(force.co), complex(force.counter)), (complex(moment.co), complex(moment.counter))


def order_of(number: int, vectors: Vectors) -> dict[str, Any]:
    """Fields of an order (:class:`schemas.answer.outputs.Order`)."""
    found: dict[str, Any] = {"order": number}
    for (name, unit), (co, counter) in zip(PARTS, vectors, strict=True):
        found[name] = {
            "co_rotating": _phasor(co, unit),
            "counter_rotating": _phasor(counter, unit),
            f"peak_{unit}": abs(co) + abs(counter),
        }
    return found


def ellipses_of(vectors: Vectors) -> dict[str, dict[str, float]]:
    """Fields of ellipses (:class:`schemas.answer.first_order.FirstOrder`)."""
    return {name: _ellipse(*pair, unit) for (name, unit), pair in zip(PARTS, vectors, strict=True)}


def _ellipse(co: complex, counter: complex, unit: str) -> dict[str, float]:
    with_shaft, against, mirrored, axis = abs(co), abs(counter), counter.conjugate(), 0.0
    if co and counter:
        axis = math.degrees(0.5 * (_angle(co) + _angle(counter))) % 180.0
    return {
        f"peak_{unit}": with_shaft + against,
        f"minor_{unit}": abs(with_shaft - against),
        # a hair below 0 comes to 180
        "major_axis_deg": axis if axis < 180.0 else 0.0,
        f"peak_x_{unit}": abs(co + mirrored),
        f"peak_y_{unit}": abs(co - mirrored),
        f"co_rotating_{unit}": with_shaft,
        f"counter_rotating_{unit}": against,
    }


def _phasor(vector: complex, unit: str) -> dict[str, float]:
    return {
        f"real_{unit}": vector.real,
        f"imag_{unit}": vector.imag,
        f"magnitude_{unit}": abs(vector),
        "phase_deg": math.degrees(_angle(vector)) if vector else 0.0,
    }


def _angle(vector: complex) -> float:
    return math.atan2(vector.imag, vector.real)
