"""What shakes at multiples of the shaft speed."""

from schemas.first_order import ResidualOrders
from schemas.outputs import Order, OrdersComparison
from service.report.blocks import Chapter, Paragraph, Table, table

_HEADS = ["order", "#peak force, N", "#with counterweights, N", "#peak moment, N m", "#with counterweights, N m"]


def two_orders(found: ResidualOrders) -> Table:
    """What shakes once and what shakes twice a turn; counterweights change the first alone."""
    left: tuple[Order | None, ...] = found.after or (None, None)
    names = ("1, once a turn", "2, twice a turn")
    rows = [_row(*each) for each in zip(names, found.before, left, strict=True)]
    return table("Orders 1 and 2", _HEADS, rows)


def orders(found: OrdersComparison) -> Chapter:
    """Forces and moments by multiples of the shaft speed."""
    left = {one.order: one for one in found.after or ()}
    rows = [_row(str(one.order), one, left.get(one.order)) for one in found.before]
    words = "Exact harmonics of the motion; counterweights on the shaft change the first order alone."
    return Chapter("Orders", (Paragraph(words), table("", _HEADS, rows)))


def _row(name: str, was: Order | None, left: Order | None) -> tuple[str | float | None, ...]:
    return (
        name,
        None if was is None else was.force.peak_N,
        None if left is None else left.force.peak_N,
        None if was is None else was.moment.peak_Nm,
        None if left is None else left.moment.peak_Nm,
    )
