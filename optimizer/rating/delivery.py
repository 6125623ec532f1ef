"""Delivery coefficients: the share of its swept volume that a stage takes in."""

from collections.abc import Sequence

from schemas.rating.answer import DeliveryCoefficients
from schemas.rating.request import CompressionStage

#: table 1-3 of the design calculation of the 2D12: up to this suction pressure [Pa], m = 1 + share (k - 1)
_EXPANSION = ((1.5e5, 0.5), (4e5, 0.62), (10e5, 0.75), (30e5, 0.88), (float("inf"), 1.0))

#: section 1.3.2 of the design calculation of the 2D12, ring valves with springs of medium strength:
#: first stage, other stages
_PRESSURE = (0.97, 0.99)


def expansion_exponent(p1: float, k: float) -> float:
    """Exponent m of the re-expansion from suction pressure [Pa] and isentropic exponent, table 1-3.

    The table's bounds belong to the range below them.
    """
    return 1.0 + next(share for limit, share in _EXPANSION if p1 <= limit) * (k - 1.0)


def volumetric_coefficient(clearance: float, ratio: float, m: float) -> float:
    """lam_v = 1 - alpha (eps^(1/m) - 1), (1-5); not positive where the clearance gas fills the whole cylinder."""
    return 1.0 - clearance * (ratio ** (1.0 / m) - 1.0)


def pressure_coefficient(stage: CompressionStage, index: int) -> float:
    """lam_p of the request, or customary for the stage of this index."""
    return _PRESSURE[min(index, 1)] if stage.pressure_coefficient is None else stage.pressure_coefficient


def leakage_coefficients(stages: Sequence[CompressionStage]) -> list[float]:
    """lam_l = 1 / (1 + sum nu) of every stage, (1-6), or that of the request.

    Gas lost through a packing passed every stage before: nu holds the packings of the later stages too.
    """
    results, packings = [], 0.0
    for stage in reversed(stages):
        leaks = stage.relative_leaks
        if leaks is not None:
            packings += leaks.packing
            results.append(1.0 / (1.0 + leaks.valves + leaks.piston_rings + packings))
        elif stage.leakage_coefficient is not None:
            results.append(stage.leakage_coefficient)
    return results[::-1]


def coefficients(volumetric: float, pressure: float, temperature: float, leakage: float) -> DeliveryCoefficients:
    """The four and lam_d = lam_v lam_p lam_T lam_l, (1-4)."""
    return DeliveryCoefficients(
        volumetric=volumetric,
        pressure=pressure,
        temperature=temperature,
        leakage=leakage,
        delivery=volumetric * pressure * temperature * leakage,
    )
