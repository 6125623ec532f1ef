"""From a request to its drawings: what is drawn, and where it sits."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from optimizer.analyze import analyze
from optimizer.errors import OutOfRange
from optimizer.optimize import optimize
from schemas.answer.answers import AnalyzeAnswer, OptimizeAnswer
from schemas.answer.counterweights import Counterweight, every_counterweight
from schemas.base.model import FieldProblem
from schemas.machine.reciprocating import balance_shafts
from schemas.request.drawings import DrawingsRequest
from schemas.request.requests import AnalyzeRequest
from service.drawings.outline import Point
from service.drawings.parts import Part, parts
from service.tables.as_built import AsBuilt, as_built


@dataclass(frozen=True)
class DrawingSet:
    """What there is to be made.

    title : of the machine.
    status : of the answer; "given" without an optimisation.
    fitted : all counterweights, also those without a plate, which cannot be drawn.
    built : what is fitted beside the optimum, where the request says so; then `fitted` are those that are built.
    axes : of balance shafts, by the names of their webs, m; all others turn about the origin.
    """

    title: str
    status: str
    parts: tuple[Part, ...]
    fitted: tuple[Counterweight, ...]
    built: AsBuilt | None = None
    axes: Mapping[str, Point] = field(default_factory=dict)


def drawings(request: DrawingsRequest) -> DrawingSet:
    """The parts of the counterweights of the request, or of those that are fitted, or of the best ones.

    Raises
    ------
    MissingInput
        if the machine lacks what the objective needs.
    OutOfRange
        if a counterweight is more than its envelope holds, if there is none within the limits, or none to be drawn.
    """
    answer = _answer(request)
    built = as_built(request, answer) if isinstance(answer, OptimizeAnswer) else None
    every = every_counterweight(answer) if built is None else built.counterweights
    fitted = tuple(counterweight for counterweight in every if counterweight.mass_kg > 0)
    plates = parts(request.machine, fitted)
    if not plates:
        raise OutOfRange(
            [FieldProblem(_origin(request), "no counterweight is cut from a plate: there is none to draw")]
        )
    status = getattr(answer, "status", "given")
    shafts = balance_shafts(request.machine)
    axes = {web.name: (shaft.x_m, shaft.y_m) for shaft in shafts for web in shaft.webs}
    return DrawingSet(request.machine.name or "machine without a name", status, plates, fitted, built, axes)


def _answer(request: DrawingsRequest) -> OptimizeAnswer | AnalyzeAnswer:
    if request.counterweights is not None:
        return analyze(AnalyzeRequest(machine=request.machine, counterweights=request.counterweights))
    optimum = optimize(request, outputs=("residual",))
    if optimum.status == "infeasible":
        message = "no counterweights within the limits keep the ceilings: there are none to draw"
        raise OutOfRange([FieldProblem(("objective",), message)])
    return optimum


def _origin(request: DrawingsRequest) -> tuple[str | int, ...]:
    return ("machine", "webs") if request.counterweights is None else ("counterweights",)
