"""Curves of coefficients, read off charts: a power law between readings, with the source of each."""

import math
from bisect import bisect_right

from optimizer.numerics.records import record
from schemas.rating.request import RatingRequest

#: where the customary figures are from
SOURCE = "design calculation of the 2D12-90/2-20 compressor"
#: what is said of a figure that the request gives itself
REQUEST = "request"


@record(frozen=True)
class Curve:
    """Readings of a share above 0 over a quantity above 0; beyond the last ones the power law goes on."""

    places: tuple[float, ...]
    values: tuple[float, ...]
    source: str
    largest: float

    def at(self, place: float) -> float:
        """The share at a place, at most the largest that has a meaning."""
        k = min(max(bisect_right(self.places, place) - 1, 0), len(self.places) - 2)
        low, high = self.places[k], self.places[k + 1]
        power = math.log(self.values[k + 1] / self.values[k]) / math.log(high / low)
        # in logarithms: two readings next to each other make a power that no number holds
        logarithm = math.log(self.values[k]) + power * math.log(place / low)
        return math.exp(max(min(logarithm, math.log(self.largest)), -700.0))

    def covers(self, place: float) -> bool:
        """Whether a place lies between the readings."""
        return self.places[0] <= place <= self.places[-1]


#: under (1-24): the losses of its two stages, read off a chart for 3.5 m/s and air; 0.99 leaves some pressure
SUCTION = Curve((0.3e6, 0.79e6), (0.036, 0.028), f"{SOURCE}, under (1-24)", 0.99)
DISCHARGE = Curve((0.79e6, 2.1e6), (0.061, 0.045), f"{SOURCE}, under (1-24)", 0.99)
#: section 1.3.3: one figure for every pressure ratio
TEMPERATURE_COEFFICIENT, TEMPERATURE_SOURCE = 0.96, f"{SOURCE}, 1.3.3"


def suction_losses(request: RatingRequest) -> Curve:
    """The curve for losses at suction: that of the request, or the customary one."""
    readings = request.suction_loss_curve
    return SUCTION if readings is None else Curve(readings.pressure_Pa, readings.relative_loss, readings.source, 0.99)


def discharge_losses(request: RatingRequest) -> Curve:
    """The same at discharge."""
    readings = request.discharge_loss_curve
    return DISCHARGE if readings is None else Curve(readings.pressure_Pa, readings.relative_loss, readings.source, 0.99)


def temperature_coefficients(request: RatingRequest) -> Curve | None:
    """The curve of temperature coefficients over pressure ratios; None where there is none."""
    readings = request.temperature_curve
    return (
        None
        if readings is None
        else Curve(readings.pressure_ratio, readings.temperature_coefficient, readings.source, 1.0)
    )
