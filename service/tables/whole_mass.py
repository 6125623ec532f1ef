"""The mass that an answer puts on all shafts of a machine."""

from schemas.answer.answers import AnalyzeAnswer, OptimizeAnswer


def whole_mass(answer: OptimizeAnswer | AnalyzeAnswer) -> float | None:
    """Mass on the crankshaft and on the balance shafts, kg; None where there are none to show."""
    own, beside = answer.total_mass_kg, answer.balance_shafts_mass_kg
    return own if own is None or beside is None else own + beside
