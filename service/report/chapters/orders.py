"""What shakes at multiples of the shaft speed."""

from collections.abc import Iterator
from functools import partial

from schemas.answer.first_order import ResidualOrders
from schemas.answer.outputs import ForceOrder, MomentOrder, Order, OrdersComparison
from service.report.blocks import Cell, Chapter, Figure, Paragraph, Table, figure_beside, table
from service.report.charts import COUPLE_AXES, FORCE_AXES, after, before, hodograph

#: an order whose force and moment are below this share of the largest is neither listed nor drawn
_SMALL = 1e-3
#: minor over major axis of an ellipse that is a line
_LINE = 1e-6
_HEADS = ["order", "#peak force, N", "#with counterweights, N", "#peak moment, N m", "#with counterweights, N m"]


def two_orders(residual: ResidualOrders) -> Table:
    """What shakes once and what shakes twice a turn; counterweights change the first alone."""
    left: tuple[Order | None, ...] = residual.after or (None, None)
    names = ("1, once a revolution", "2, twice a revolution")
    scale = residual.before[0]
    rows = [_row(*pair, scale) for pair in zip(names, residual.before, left, strict=True)]
    return table("Orders 1 and 2", _HEADS, rows)


def orders(comparison: OrdersComparison) -> Chapter:
    """Forces and moments by multiples of the shaft speed: orders that are more than small, and their ellipses."""
    left = {order.order: order for order in comparison.after or ()}
    entries = _notable(comparison)
    rows = [_row(str(order.order), order, left.get(order.order), comparison.before[0]) for order in entries]
    words = ["Exact harmonics of the motion; counterweights on the shaft change the first order alone."]
    small = [
        str(order.order)
        for order in comparison.before
        if order not in entries and (order.force.peak_N or order.moment.peak_Nm)
    ]
    if small:
        words.append(f"Of order {', '.join(small)} force and moment are below a thousandth of the largest.")
    # the first order has its hodographs already
    ellipses = [order for order in entries if order.order > 1 and not _straight(order)]
    lines = [str(order.order) for order in entries if order.order > 1 and order not in ellipses]
    if lines:
        words.append(f"The vectors of order {', '.join(lines)} run along straight lines, which are not drawn.")
    figures = [_hodographs(order, left.get(order.order)) for order in ellipses]
    pictures = [figure for figure in figures if figure is not None]
    return Chapter("Orders", (Paragraph(" ".join(words)), table("", _HEADS, rows), *pictures))


def _notable(comparison: OrdersComparison) -> list[Order]:
    """Orders whose force or moment is more than small beside the largest of its kind."""
    largest = {
        kind: max((_peak(order, kind) for order in comparison.before), default=0.0) for kind in ("force", "moment")
    }
    return [
        order
        for order in comparison.before
        if any(_peak(order, kind) > _SMALL * most for kind, most in largest.items())
    ]


def _straight(order: Order) -> bool:
    """Whether force and moment both move to and fro along a line."""
    ellipses = (_ellipse(order.force, "N"), _ellipse(order.moment, "N m"))
    return all(minor <= _LINE * major for major, minor, _ in ellipses)


def order_hodographs(comparison: OrdersComparison) -> Iterator[Figure]:
    """The ellipses of every order that has any worth a drawing."""
    left = {order.order: order for order in comparison.after or ()}
    for order in _notable(comparison):
        picture = _hodographs(order, left.get(order.order))
        if picture is not None:
            yield picture


def _peak(order: Order, kind: str) -> float:
    return order.force.peak_N if kind == "force" else order.moment.peak_Nm


def _hodographs(was: Order, left: Order | None) -> Figure | None:
    """The ellipses of force and moment of one order; None where there is neither."""
    drawings = []
    for kind, unit, axes in (("force", "N", FORCE_AXES), ("moment", "N m", COUPLE_AXES)):
        parts = [(before, was)] + ([] if left is None else [(partial(after, "with counterweights"), left)])
        ellipses = [make(*_ellipse(getattr(order, kind), unit)) for make, order in parts]
        if any(ellipse.major > 0.0 for ellipse in ellipses):
            drawings.append(hodograph(f"the {kind} of order {was.order}", unit, ellipses, axes=axes))
    times = "once" if was.order == 1 else f"{was.order} times"
    caption = f"Order {was.order}: the tip of the vector runs along its ellipse {times} a revolution."
    return Figure(tuple(drawings), caption) if drawings else None


def _ellipse(order: ForceOrder | MomentOrder, unit: str) -> tuple[float, float, float]:
    """Semi-axes and direction of the major one, degrees."""
    short = unit.replace(" ", "")
    sizes = [getattr(phasor, f"magnitude_{short}") for phasor in (order.co_rotating, order.counter_rotating)]
    axis = 0.5 * (order.co_rotating.phase_deg + order.counter_rotating.phase_deg)
    return sum(sizes), abs(sizes[0] - sizes[1]), axis


def _row(name: str, was: Order | None, left: Order | None, scale: Order | None) -> tuple[Cell, ...]:
    """A line; what rounding leaves beside the first order without counterweights is 0."""
    force, moment = (0.0, 0.0) if scale is None else (scale.force.peak_N, scale.moment.peak_Nm)
    return (
        name,
        figure_beside(None if was is None else was.force.peak_N, force),
        figure_beside(None if left is None else left.force.peak_N, force),
        figure_beside(None if was is None else was.moment.peak_Nm, moment),
        figure_beside(None if left is None else left.moment.peak_Nm, moment),
    )
