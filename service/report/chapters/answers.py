"""What the answers to an optimisation and to an analysis say, chapter by chapter."""

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from schemas.answer.answers import AnalyzeAnswer, OptimizeAnswer
from schemas.answer.outputs import OutputFields
from schemas.machine.machine import Machine
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from service.report.blocks import Chapter, facts
from service.report.chapters import balance, verdict
from service.report.chapters.alternatives import alternatives
from service.report.chapters.balance_quality import balance_quality
from service.report.chapters.dynamics import OVER_THE_TURN
from service.report.chapters.foundation import foundation_loads
from service.report.chapters.limits import prices
from service.report.chapters.loads import loads
from service.report.chapters.order import workshop_order
from service.report.chapters.orders import orders, two_orders
from service.report.chapters.pins import pin_loads
from service.report.chapters.roll import roll
from service.report.chapters.worst_case import worst_case
from service.report.chapters.worth_knowing import worth_knowing
from service.tables.as_built import as_built
from service.tables.whole_mass import whole_mass

#: chapters of the outputs, in the order in which they stand
CHAPTERS: Mapping[str, Callable[[Machine, Any], Chapter]] = {
    "orders": lambda _machine, output: orders(output),
    "foundation_loads": lambda _machine, output: foundation_loads(output),
    "hodograph": lambda _machine, output: balance.hodograph(output),
    "internal_moment": lambda _machine, output: Chapter(
        "Moment inside the shaft",
        (
            facts(
                "",
                [
                    ("largest first-order moment without counterweights, N m", output.before_Nm),
                    ("with counterweights, N m", output.after_Nm),
                ],
            ),
        ),
    ),
    **OVER_THE_TURN,
    "loads": loads,
    "roll": roll,
    "pin_loads": lambda _machine, output: pin_loads(output),
}


def optimized(request: OptimizeRequest, answer: OptimizeAnswer) -> Iterator[Chapter]:
    """Counterweights, what they leave, and the certificate; or why there are none."""
    built = as_built(request, answer)
    yield verdict.result(request, answer, built)
    yield balance.counterweights(request, answer, built)
    yield from workshop_order(request.machine, answer)
    yield from alternatives(answer)
    yield from worth_knowing(answer)
    yield from worst_case(answer)
    yield from balance_quality(request.machine, answer)
    yield balance.before_and_after(request, answer, built)
    yield verdict.certificate(request, answer)
    yield from prices(answer)
    if answer.stages is not None:
        yield balance.stages(request.machine, answer.stages, ())
    yield from outputs(request.machine, answer)


def analyzed(request: AnalyzeRequest, answer: AnalyzeAnswer) -> Iterator[Chapter]:
    """What the machine does without and with the counterweights of the request."""
    if whole_mass(answer):
        total = facts("", [("total mass of the counterweights, kg", answer.total_mass_kg)])
        own = (*balance.workshop_blocks(request.machine, answer.counterweights), total) if answer.counterweights else ()
        shafts = balance.on_balance_shafts(answer.balance_shafts, answer.balance_shafts_mass_kg)
        yield Chapter("Counterweights", (*own, *shafts))
    yield from worth_knowing(answer)
    yield from balance_quality(request.machine, answer)
    if answer.residual is not None and answer.floor is not None:
        before, after = answer.residual.before, answer.residual.after
        beside = two_orders(answer.residual.orders)
        yield balance.first_order(request.machine, before, after, answer.floor, "with counterweights", beside)
    if answer.stages is not None:
        yield balance.stages(request.machine, answer.stages, ())
    yield from outputs(request.machine, answer)


def outputs(machine: Machine, answer: OutputFields, but: str | None = None) -> Iterator[Chapter]:
    """A chapter for every output of the answer, but for first order and stages, which have their own places.

    Parameters
    ----------
    but : an output that has a place of its own as well.
    """
    for name, chapter in CHAPTERS.items():
        result = getattr(answer, name)
        if result is not None and name != but:
            yield chapter(machine, result)
