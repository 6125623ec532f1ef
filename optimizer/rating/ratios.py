"""Pressures and temperatures of the stages."""

from collections.abc import Sequence

from schemas.rating.answer import StageState


def equal_split(p1: float, p2: float, stages: int) -> tuple[float, ...]:
    """Pressures [Pa] before, between and after stages of equal ratio eps = (p2/p1)^(1/z), (1-1) and (1-2)."""
    ratio = (p2 / p1) ** (1.0 / stages)
    return (p1, *(p1 * ratio**i for i in range(1, stages)), p2)


def split(p1: float, p2: float, stages: int, between: Sequence[float] | None) -> tuple[float, ...]:
    """Pressures [Pa] before, between and after the stages: of the request, or of equal ratio."""
    return equal_split(p1, p2, stages) if between is None else (p1, *between, p2)


def discharge_temperature(T1: float, ratio: float, n: float) -> float:
    """T2 = T1 eps^((n-1)/n) [K], (1-3) and (1-26)."""
    return T1 * ratio ** ((n - 1.0) / n)


def stage_state(p1: float, p2: float, T1: float, n: float) -> StageState:
    """Compression from p1 to p2 [Pa], beginning at T1 [K]."""
    return StageState(
        suction_pressure_Pa=p1,
        discharge_pressure_Pa=p2,
        pressure_ratio=p2 / p1,
        discharge_temperature_K=discharge_temperature(T1, p2 / p1, n),
    )
