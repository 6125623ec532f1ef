"""The machine with its counterweights, drawn: no terminal loads what draws."""

from itertools import chain

from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import OptimizeRequest
from service.drawings.front import front
from service.drawings.layout import Layout, layout_of
from service.drawings.side import side
from service.report.blocks import Chapter, Figure
from service.report.chapters.balance import best_set, carried, workshop_blocks
from service.tables.as_built import AsBuilt


def layout(request: OptimizeRequest, answer: OptimizeAnswer, built: AsBuilt | None) -> Chapter:
    """The machine with its counterweights, drawn."""
    fitted, _ = best_set(answer)
    plan = layout_of(request.machine, carried(answer), () if built is None else built.counterweights)
    return Chapter(
        "Layout",
        (
            *(() if built is None else workshop_blocks(request.machine, fitted)),
            Figure(
                (front(plan),),
                "Front view from +z at shaft angle 0, to scale: cranks black, axes of rows dash-dotted, "
                f"{_words(answer, plan)}, angles that a web allows as green wedges." + _shafts(plan) + _as_built(plan),
            ),
            Figure(
                (side(plan, dimensions=True),),
                "Side view along the shaft, heights along the direction of the first crank; the reference plane of "
                "the moments green and dash-dotted. Below: places z and distances of the webs in mm; R is the radius "
                "of a centre of mass. Along and across the shaft the scales differ." + _as_built(plan),
            ),
        ),
    )


def _words(answer: OptimizeAnswer, plan: Layout) -> str:
    """How counterweights are drawn."""
    subject = "counterweights of the best compromise" if answer.infeasibility is not None else "counterweights"
    if all(weight.shape is not None for weight in chain(plan.best, *(shaft.best for shaft in plan.balance))):
        return f"{subject} blue and true to shape, with their centres of mass as dots"
    return (
        f"{subject} blue with their centres of mass as dots; a dashed disc stands for one of unknown shape, and its "
        "area is as its mass"
    )


def _shafts(plan: Layout) -> str:
    words = (
        " Balance shafts stand in their places, as they are at their shaft angle 0; n is the speed of the crankshaft."
    )
    return words if plan.balance else ""


def _as_built(plan: Layout) -> str:
    built = plan.built or any(shaft.built for shaft in plan.balance)
    return " As built: dashed, without a ground." if built else ""
