"""What an answer puts on all shafts of a machine, those of balance shafts behind that of the crankshaft."""

from itertools import chain

from schemas.answer.answers import AnalyzeAnswer, OptimizeAnswer
from schemas.answer.counterweights import Counterweight

Answer = OptimizeAnswer | AnalyzeAnswer


def every_counterweight(answer: Answer) -> tuple[Counterweight, ...]:
    """Counterweights on the crankshaft and on the balance shafts."""
    return (*answer.counterweights, *chain.from_iterable(shaft.counterweights for shaft in answer.balance_shafts))


def whole_mass(answer: Answer) -> float | None:
    """Mass of all of them, kg; None where there are none to show."""
    own, beside = answer.total_mass_kg, answer.balance_shafts_mass_kg
    return own if own is None or beside is None else own + beside
