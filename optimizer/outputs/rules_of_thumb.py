"""Classic partial balances of the slides on balancing, to stand beside the optimum.

A rule turns the share k of a reciprocating force by a quarter turn: counterweights that act against the
co-rotating phasor with 2 k |co|. For a single row |co| = |counter| = F0/2, so k F0 is turned across and
(1 - k) F0 stays along the cylinder (the slides, "one row"). A share k = 1/2 removes the co-rotating phasor altogether,
which leaves a circle that turns against the shaft.
"""

import math
from typing import NamedTuple

from optimizer.outputs.ellipses import Ellipse
from schemas.answer.outputs import RuleOfThumb

#: the smaller phasor over the larger one below which the ellipse is a circle, or above 1 minus which it is a line
SHAPE_TOLERANCE = 1e-9
#: planes closer than this are one plane
SAME_PLANE_M = 1e-12


class Rule(NamedTuple):
    """Name, source and transferred share k of a rule."""

    name: str
    source: str
    share: float


#: where the customary shares are from, for those who read the answer
_SOURCE = "lecture slides on balancing (Уравновешивание)"
_HALF_SUM = Rule("half the sum of the extremes", f"{_SOURCE}, V type", 0.5)


def force_rules(first: Ellipse, square: float) -> tuple[RuleOfThumb, ...]:
    """Rules for first-order reciprocating forces, stage III.

    In-line forces, which keep to one direction: 20 % and 30 % where that is nearer the vertical (y), 30 %
    and 50 % where it is nearer the horizontal. Any other ellipse (V type): J_np = (J_max + J_min)/2, which
    is the co-rotating phasor, k = 1/2. None where one of the phasors is zero.

    Parameters
    ----------
    first : first-order reciprocating force of one machine over omega^2, kg m.
    square : omega^2, rad^2/s^2.
    """
    rules: tuple[Rule, ...] = ()
    if _is_line(first):
        vertical = _is_vertical(first)
        rules = tuple(_transfer("force", share, vertical) for share in ((0.2, 0.3) if vertical else (0.3, 0.5)))
    elif not _is_circle(first):
        rules = (_HALF_SUM,)
    return tuple(_figures(rule, first, square, 1.0) for rule in rules)


def moment_rules(first: Ellipse, square: float, span_m: float) -> tuple[RuleOfThumb, ...]:
    """Rules for their moments, stage IV: 15 % and 50 % where nearer the vertical, 50 % where nearer the horizontal.

    Two counterweights on opposite sides of the shaft in planes ``span_m`` apart make the couple
    (the slides, "two rows in line"). They have no rule for moments that do not keep to one plane.

    Parameters
    ----------
    first : first-order reciprocating moment of one machine over omega^2, kg m^2.
    square : omega^2, rad^2/s^2.
    span_m : distance between the two counterweights, m; there is no couple in one plane.
    """
    if span_m <= SAME_PLANE_M or not _is_line(first):
        return ()
    vertical = _is_vertical(first)
    rules = [_transfer("moment", share, vertical) for share in ((0.15, 0.5) if vertical else (0.5,))]
    return tuple(_figures(rule, first, square, 2.0 / span_m) for rule in rules)


def _figures(rule: Rule, first: Ellipse, square: float, iron: float) -> RuleOfThumb:
    """What a rule leaves; ``iron`` is the total mass-radius product for one unit of the response over omega^2."""
    left = (1.0 - 2.0 * rule.share) * first.co
    return RuleOfThumb(
        name=rule.name,
        source=rule.source,
        transferred_share=rule.share,
        total_mass_radius_kg_m=2.0 * rule.share * first.co * iron,
        peak=(abs(left) + first.counter) * square,
        # the major axis is where both phasors point the same way, the minor axis where they are opposed
        peak_along=abs(left + first.counter) * square,
        peak_across=abs(left - first.counter) * square,
    )


def _transfer(quantity: str, share: float, vertical: bool) -> Rule:
    orientation = "vertical" if vertical else "horizontal"
    layout = "single row" if quantity == "force" else "two rows in line, cranks 180 deg apart"
    return Rule(
        f"transfer {100 * share:.0f} % of the first-order {quantity}", f"{_SOURCE}, {layout}, {orientation}", share
    )


def _is_circle(pair: Ellipse) -> bool:
    return min(pair.co, pair.counter) <= SHAPE_TOLERANCE * max(pair.co, pair.counter)


def _is_line(pair: Ellipse) -> bool:
    return pair.peak > 0.0 and pair.minor <= SHAPE_TOLERANCE * pair.peak


def _is_vertical(pair: Ellipse) -> bool:
    """Whether the major axis lies nearer y than x; at 45 degrees it is called horizontal."""
    axis = math.radians(pair.axis_deg)
    return abs(math.sin(axis)) > abs(math.cos(axis)) * (1.0 + SHAPE_TOLERANCE)
