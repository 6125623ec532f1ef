"""Pictures for pages that show a machine beside something of their own: the drawings of the report, one at a time."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from optimizer.errors import OutOfRange
from optimizer.optimize import optimize
from schemas.answer.answers import OptimizeAnswer
from schemas.answer.outputs import OutputName
from schemas.base.model import FieldProblem
from schemas.request.picture import PictureRequest, PictureStyle
from schemas.request.requests import OptimizeRequest
from schemas.scroll.pin_loads import PinLoads
from service.drawings.front import front as drawn_front
from service.drawings.layout import Layout, layout_of
from service.drawings.side import side as drawn_side
from service.drawings.svg import Drawing, beside, shortened
from service.report.chapters.balance import best_set, best_set_label, carried
from service.report.chapters.bearing_loci import loci
from service.report.chapters.orders import order_hodographs
from service.report.chapters.pins import pin_figure
from service.report.first_order import hodographs
from service.report.indicator import indicators
from service.report.stage_scheme import stage_scheme
from service.tables.as_built import as_built

#: what a picture without a page around it is written in
_FONT = "sans-serif"
#: room for a title, and of a letter of it [px]
_TITLE, _LETTER = 28.0, 8.0


@dataclass(frozen=True)
class Picture:
    """A picture: called with a request, it is drawn with the best counterweights, or with the best compromise.

    outputs : what the answer must hold.
    draw : request, answer -> drawing.

    Raises
    ------
    MissingInput
        if the machine lacks what the picture, or the objective, needs.
    OutOfRange
        if there is nothing to draw.
    """

    outputs: tuple[OutputName, ...]
    draw: Callable[[OptimizeRequest, OptimizeAnswer], Drawing]

    def __call__(self, request: OptimizeRequest) -> Drawing:
        drawing = self.draw(request, optimize(request, outputs=self.outputs))
        return styled(drawing, request.picture) if isinstance(request, PictureRequest) else drawing


def styled(drawing: Drawing, style: PictureStyle) -> Drawing:
    """The drawing in the size of a style, on a ground, under a title."""
    if style == PictureStyle():
        return drawing
    above = 0.0 if style.title is None else _TITLE
    result = Drawing(drawing.width, drawing.height + above, drawing.label)
    if style.width_px is not None:
        result.scale = style.width_px / drawing.width
    if not style.transparent:
        result.area([(0, 0), (result.width, 0), (result.width, result.height), (0, result.height)], "white")
    if style.title is not None:
        most = int(drawing.width / _LETTER)
        result.text((0.5 * result.width, 18.0), shortened(style.title, most), "middle", 14.0)
    result.inset(drawing, (0.0, above))
    return result


def _layout(request: OptimizeRequest, answer: OptimizeAnswer) -> Layout:
    built = as_built(request, answer)
    return layout_of(request.machine, carried(answer), () if built is None else built.counterweights)


def _hodograph(number: int, request: OptimizeRequest, answer: OptimizeAnswer) -> Drawing:
    left, built = best_set(answer)[1], as_built(request, answer)
    filed = None if built is None else built.left
    return hodographs(request.machine, answer.residual.before, left, answer.floor, best_set_label(answer), filed)[
        number
    ]


def _bearings(request: OptimizeRequest, answer: OptimizeAnswer) -> Drawing:
    result = answer.main_bearings
    pictures = [] if result is None else loci(request.machine, result)
    words = "loads of the main bearings as the shaft sees them, each with its smallest circle"
    return _grid(words, pictures, "there are no loads of main bearings to draw")


def _indicator(request: OptimizeRequest, answer: OptimizeAnswer) -> Drawing:
    pictures = [] if answer.gas is None else list(indicators(request.machine, answer.gas))
    return _grid("indicator diagrams", pictures, "no row has a chamber whose pressure could be drawn", "throws")


def _orders(_request: OptimizeRequest, answer: OptimizeAnswer) -> Drawing:
    figures = [] if answer.orders is None else order_hodographs(answer.orders)
    pictures = [drawing for figure in figures for drawing in figure.drawings]
    words = "hodographs of force and moment, order by order"
    return _grid(words, pictures, "no order has a force or a moment to draw")


def _grid(label: str, pictures: list[Drawing], nothing: str, *field: str) -> Drawing:
    if not pictures:
        raise OutOfRange([FieldProblem(("machine", *field), nothing)])
    return beside(label, pictures)


def _pin_loads(_request: OptimizeRequest, answer: OptimizeAnswer) -> Drawing:
    if answer.pin_loads is None:
        raise OutOfRange([FieldProblem(("machine",), "there are no pins: only a scroll has them")])
    return pin_figure(answer.pin_loads).drawings[0]


front = Picture(("residual",), lambda request, answer: drawn_front(_layout(request, answer)))
side = Picture(("residual",), lambda request, answer: drawn_side(_layout(request, answer), dimensions=True))
force = Picture(("residual",), partial(_hodograph, 0))
moment = Picture(("residual",), partial(_hodograph, 1))
bearings = Picture(("main_bearings",), _bearings)
indicator = Picture(("gas",), _indicator)
stages = Picture(("stages",), lambda request, answer: stage_scheme(request.machine, answer.stages or ()))
orders = Picture(("orders",), _orders)
pin_loads = Picture(("pin_loads",), _pin_loads)


def pins_svg(loads: PinLoads) -> bytes:
    """The loads of the pins over a revolution, in UTF-8."""
    return svg(pin_figure(loads).drawings[0])


def svg(drawing: Drawing) -> bytes:
    """The picture, in UTF-8."""
    return drawing.svg(_FONT).encode()
