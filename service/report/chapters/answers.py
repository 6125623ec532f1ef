"""What the answers to an optimisation and to an analysis say, chapter by chapter."""

from collections.abc import Iterator

from schemas.answers import AnalyzeAnswer, OptimizeAnswer, Outputs
from schemas.machine import Machine
from schemas.requests import AnalyzeRequest, OptimizeRequest
from service.report.blocks import Chapter, facts
from service.report.chapters import balance, verdict
from service.report.chapters.dynamics import dynamics
from service.report.chapters.pins import pin_loads


def optimized(request: OptimizeRequest, answer: OptimizeAnswer) -> Iterator[Chapter]:
    """Counterweights, what they leave, and the certificate; or why there are none."""
    yield verdict.result(request, answer)
    yield balance.counterweights(answer)
    yield balance.before_and_after(request, answer)
    yield verdict.certificate(answer.certificate, answer.infeasibility)
    if answer.stages is not None:
        yield balance.stages(answer.stages, ())
    yield from outputs(request.machine, answer)


def analyzed(request: AnalyzeRequest, answer: AnalyzeAnswer) -> Iterator[Chapter]:
    """What the machine does without and with the counterweights that it was given."""
    if answer.total_mass_kg > 0:
        total = facts("", [("total mass of the counterweights, kg", answer.total_mass_kg)])
        yield Chapter("Counterweights", (balance.places(answer.counterweights), total))
    if answer.residual is not None and answer.floor is not None:
        before, after = answer.residual.before, answer.residual.after
        yield balance.first_order(request.machine, before, after, answer.floor, "with counterweights")
    if answer.stages is not None:
        yield balance.stages(answer.stages, ())
    yield from outputs(request.machine, answer)


def outputs(machine: Machine, answer: Outputs) -> Iterator[Chapter]:
    """A chapter for every output that was asked for, but for first order and stages, which have their own places."""
    if answer.orders is not None:
        yield balance.orders(answer.orders)
    if answer.hodograph is not None:
        yield balance.hodograph(answer.hodograph)
    yield from dynamics(machine, answer)
    if answer.pin_loads is not None:
        yield pin_loads(answer.pin_loads)
