"""Rules of thumb beside the optimum: they turn the share k of a reciprocating force by a quarter turn.

Counterweights that act against what turns with the shaft with 2 k |co| leave (1 - 2 k) |co| of it. Which shares are
customary depends on the ellipse: of a line on whether it is nearer x or y, of a force beside on its extremes.
"""

from __future__ import annotations

from typing import List, Optional, Tuple

from verify_claims import EVIDENCE, Claims, figure, same
from verify_ellipses import EXACT, Pair, either, is_nothing
from verify_numbers import ABOUT_ONE, ONE, ZERO, Number, Place, largest, real

#: customary shares of what keeps to a direction, nearer y and nearer x
_LINES = {"force": ((0.2, 0.3), (0.3, 0.5)), "moment": ((0.15, 0.5), (0.5,))}
#: of a force on an ellipse
_HALF = (0.5,)


def rules(claim: str, place: Place, pair: Pair, name: str, square: Number, iron: Optional[Number]) -> Claims:
    """All of a force or a moment.

    ``iron``: total mass times radius for a unit of it over the square of the speed; None where nothing makes it.
    """
    entries = list(place)
    shares = tuple((entry / "transferred_share").double() for entry in entries)
    allowed = [()] if iron is None else customary(pair, name)
    yield claim, place, ONE if shares in allowed else -ONE, ONE
    co, counter = pair.sizes
    for entry, share in zip(entries, shares):
        yield claim, entry / "transferred_share", ONE if shares in allowed else -ONE, ONE
        halved = name == "force" and shares == _HALF
        title = "half the sum of the extremes" if halved else f"transfer {100 * share:.0f} % of the first-order {name}"
        yield same(claim, entry / "name", title)
        # words about where it is from
        yield EVIDENCE, entry / "source", None, ONE
        reduction = real(2 * share) * co
        left = co - reduction
        mass = reduction * (iron or ZERO) * ABOUT_ONE / square
        yield figure(claim, entry / "total_mass_radius_kg_m", mass)
        yield figure(claim, entry / "peak", abs(left) + counter)
        yield figure(claim, entry / "peak_along", abs(left + counter))
        yield figure(claim, entry / "peak_across", abs(left - counter))


def customary(pair: Pair, name: str) -> List[Tuple[float, ...]]:
    """Shares of all rules, one list for each shape that doubles may find."""
    lists: List[Tuple[float, ...]] = []
    line, other = either(pair.minor, pair.peak * real(EXACT))
    if line and not is_nothing(pair):
        lists += [shares for shares, may_be in zip(_LINES[name], upright(pair)) if may_be]
    if not other and pair.peak.low > 0:
        return lists
    if name == "moment":
        return [*lists, ()]
    co, counter = pair.sizes
    smaller = -largest(-co, -counter)
    circle, ellipse = either(smaller, largest(co, counter) * real(EXACT))
    return [*lists, *([()] if circle else []), *([_HALF] if ellipse else [])]


def upright(pair: Pair) -> Tuple[bool, bool]:
    """Whether the major axis may be nearer y, and whether it may be nearer x or between both."""
    product = pair.co * pair.counter
    along, size = product.parts()[0], abs(product) * real(EXACT)
    return along.low < -size.low // 2, along.high >= -2 * size.high
