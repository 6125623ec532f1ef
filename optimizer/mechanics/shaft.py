"""The shaft of a machine between its main bearings, as the fidelity asks for it."""

from optimizer.mechanics.bearings import continuous_beam_influence, simple_spans_influence
from optimizer.mechanics.layout import stacked
from optimizer.mechanics.shaft_curves import Influence
from optimizer.numerics.arrays import Real
from schemas.machine.machine import Machine

#: loads of the bearings, by the model of the shaft
INFLUENCES: dict[str, Influence] = {
    "simple_spans": simple_spans_influence,
    "continuous": continuous_beam_influence,
}


def bearing_places(machine: Machine) -> Real:
    """Planes of the main bearings (..., B) m."""
    return stacked([bearing.position_m for bearing in machine.bearings])
