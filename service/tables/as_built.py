"""What is fitted beside the optimum: counterweights, what they leave, and the tolerance that they bear.

Figures are recomputed by the mechanics from the masses and angles that are fitted; nothing is certified of them.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from optimizer.analyze import analyze
from optimizer.errors import OutOfRange
from schemas.answer.answers import OptimizeAnswer
from schemas.answer.counterweights import Counterweight, every_counterweight
from schemas.answer.first_order import FirstOrder
from schemas.base.model import FieldProblem
from schemas.machine.fitted import GivenCounterweight
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from service.tables.lines import Cell, Lines
from service.tables.whole_mass import whole_mass

#: share of the objective without counterweights that what is off may cost
ALLOWANCE = 0.01
#: errors up to which the rise of a convex objective is at most in proportion to them [deg, per cent]
_LARGEST_ERROR = 1.0

HEADS = (
    "web", "optimum, kg", "as built, kg", "difference, kg", "tolerance, +- kg",
    "optimum, deg", "as built, deg", "difference, deg", "tolerance, +- deg",
)  # fmt: skip
RESIDUAL_HEADS = ("first-order peak", "without counterweights", "optimum", "as built", "difference")


class Tolerance(NamedTuple):
    """Errors that all counterweights may have together, each alone; None if undetermined."""

    share: float | None
    angle_deg: float | None


class Pair(NamedTuple):
    """A web with its optimum and what is fitted."""

    web: str
    optimum: Counterweight | None
    built: Counterweight | None

    @property
    def masses(self) -> tuple[float, float]:
        return _mass(self.optimum), _mass(self.built)

    @property
    def rotation_deg(self) -> float | None:
        """From the optimum to what is fitted, in [-180, 180); None where one of them is none."""
        if self.optimum is None or self.built is None or not all(self.masses):
            return None
        return (self.built.angle_deg - self.optimum.angle_deg + 180.0) % 360.0 - 180.0


@dataclass(frozen=True)
class AsBuilt:
    """What is fitted, evaluated.

    counterweights : on the crankshaft and the balance shafts.
    left : first-order force and moment with them.
    tolerance : about the optimum.
    """

    counterweights: tuple[Counterweight, ...]
    left: FirstOrder
    total_mass_kg: float
    pairs: tuple[Pair, ...]
    tolerance: Tolerance


def as_built(request: OptimizeRequest, answer: OptimizeAnswer) -> AsBuilt | None:
    """What a request says is fitted; None where it says nothing."""
    if not request.fitted:
        return None
    counterweights = tuple(GivenCounterweight(**counterweight.model_dump()) for counterweight in request.fitted)
    analysis = analyze(AnalyzeRequest(machine=request.machine, counterweights=counterweights, outputs=("residual",)))
    assert analysis.residual is not None  # the request names it
    assert analysis.residual.after is not None
    built, optimum, mass = every_counterweight(analysis), every_counterweight(answer), whole_mass(analysis)
    assert mass is not None  # of the counterweights as built
    pairs = tuple(_pairs(optimum, built))
    return AsBuilt(built, analysis.residual.after, mass, pairs, tolerance(answer))


def _pairs(optimum: Sequence[Counterweight], built: Sequence[Counterweight]) -> Iterator[Pair]:
    best, fitted = ({counterweight.web: counterweight for counterweight in weights} for weights in (optimum, built))
    for web in dict.fromkeys((*best, *fitted)):
        yield Pair(web, best.get(web), fitted.get(web))


def tolerance(answer: OptimizeAnswer) -> Tolerance:
    """What the counterweights of an answer bear, from its sensitivity."""
    rise, proof = answer.sensitivity, answer.certificate
    if rise is None or proof is None:
        return Tolerance(None, None)
    room = ALLOWANCE * proof.yardstick
    share, angle = (
        min(room / per, _LARGEST_ERROR) if per > 0.0 else _LARGEST_ERROR
        for per in (rise.objective_rise_per_percent, rise.objective_rise_per_deg)
    )
    return Tolerance(share / 100.0, angle)


def _mass(counterweight: Counterweight | None) -> float:
    return 0.0 if counterweight is None else counterweight.mass_kg


def lines(comparison: AsBuilt) -> Lines:
    """Headings, and a line for each web."""
    return [[*HEADS], *(line(pair, comparison.tolerance) for pair in comparison.pairs)]


def line(pair: Pair, tolerance: Tolerance) -> list[Cell]:
    """Cells under :data:`HEADS`."""
    best, built = pair.masses
    off = None if tolerance.share is None else tolerance.share * best
    angles = (_angle(pair.optimum), _angle(pair.built), pair.rotation_deg)
    return [pair.web, best, built, built - best, off, *angles, tolerance.angle_deg if best else None]


def _angle(counterweight: Counterweight | None) -> float | None:
    return counterweight.angle_deg if counterweight is not None and counterweight.mass_kg else None


def residual(answer: OptimizeAnswer, comparison: AsBuilt) -> Lines:
    """Peaks without counterweights, at the optimum, as built; cells under :data:`RESIDUAL_HEADS`, heads left out."""
    was, best, now = answer.residual.before, answer.residual.after, comparison.left
    rows: Lines = []
    for name, values in (
        ("force, N", [peaks.force.peak_N if peaks else None for peaks in (was, best, now)]),
        ("moment, N m", [peaks.moment.peak_Nm if peaks else None for peaks in (was, best, now)]),
        ("total mass, kg", [0.0, whole_mass(answer), comparison.total_mass_kg]),
    ):
        before, optimum, built = values
        rows.append([name, before, optimum, built, None if optimum is None or built is None else built - optimum])
    return rows


def required(request: OptimizeRequest, answer: OptimizeAnswer) -> AsBuilt:
    """The same for a document about nothing else.

    Raises
    ------
    OutOfRange
        if the request says nothing of it.
    """
    result = as_built(request, answer)
    if result is None:
        raise OutOfRange([FieldProblem(("fitted",), "say what is fitted: there is nothing to set beside the optimum")])
    return result
