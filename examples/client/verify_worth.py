"""What budgets, plates and sectors leave a counterweight of what multipliers pull with."""

from __future__ import annotations

from math import inf
from typing import Optional, Sequence, Tuple

from verify_machine import Machine, Web
from verify_numbers import (
    ZERO,
    Number,
    Place,
    direction,
    largest,
    real,
    total,
)
from verify_plates import Plate


def budget(
    machine: Machine, pulls: dict[str, Number], share: Number, cost: Number, implied: Place, price: Number
) -> Number:
    """A price of the budget at which most is proven, where ``price`` is printed."""
    if any(web.plate for web in machine.webs):
        return spent(machine, pulls, share, cost, implied)
    assert machine.left is not None
    limits = [min(filter(None, (web.limit, machine.left)), key=lambda number: number.high) for web in machine.webs]
    gains = [web.radius * pulls[web.name] * share - cost for web in machine.webs]
    return worth_of_budget(price, list(zip(gains, limits)), machine.left)


def worth_of_budget(price: Number, gains: Sequence[Tuple[Number, Optional[Number]]], left: Number) -> Number:
    """A price of the budget: any proves something, that of the next kilogram that is left out more.

    ``gains``: what a kilogram gains on every web, and how many it may carry.
    """
    below = max((gain.high for gain, _ in gains if gain.high < price.low), default=0)
    lower = Number(max(below, 0), max(below, 0))

    def cost(at: Number) -> int:
        full = total((gain - at) * (carries or left) for gain, carries in gains if gain.high > at.high)
        return (at * left + full).high

    return min(price, lower, key=cost)


def spent(machine: Machine, pulls: dict[str, Number], share: Number, cost: Number, implied: Place) -> Number:
    """A price of the budget beside plates, at which it is spent: any price proves something, this one most.

    What is worth more than it is made in full, of a plate up to the opening that is worth no more. By halving.
    A web without a limit that is worth next to nothing spends no more than what the missing limit implies.
    """
    assert machine.left is not None
    worth = {web.name: max((pulls[web.name] * share).middle().real, 0.0) for web in machine.webs}
    levers = {web.name: web.plate.lever(0.0) if web.plate else float(web.radius) for web in machine.webs}

    def fits(price: float) -> bool:
        mass = 0.0
        for web in machine.webs:
            place = implied / web.name
            limit = min(inf if web.limit is None else float(web.limit), place.double(least=0) if place else inf)
            if web.plate is not None:
                mass += min(web.plate.mass(web.plate.opening(worth[web.name], price + least)), limit)
            elif worth[web.name] * levers[web.name] > price + least:
                mass += limit
        return mass <= float(machine.left)

    least = float(cost)
    low, high = 0.0, max((worth[name] * lever for name, lever in levers.items()), default=0.0)
    if fits(low):
        # what is not spent has no price: the least one, times a budget beyond all need, would cost more than there is
        return ZERO
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (low, middle) if fits(middle) else (middle, high)
    return real(high)


def of_plate(web: Web, plate: Plate, pull: Number, price: Number, implied: Place) -> Number:
    """What is cut from a plate takes off at most, of what a kilogram metre takes off."""
    if pull.high <= 0 or (web.limit is not None and web.limit.high <= 0):
        return ZERO
    limit = min(inf if web.limit is None else float(web.limit), implied.double(least=0) if implied else inf)
    smallest, cheapest = Number(pull.low, pull.low), Number(max(price.low, 0), max(price.low, 0))
    low, _ = plate.worth(max(float(smallest), 0.0), max(float(price), 0.0), limit)
    _, high = plate.worth(float(pull), float(cheapest), limit)
    return Number(real(low).low, real(high).high)


def support(pull: Number, sector: tuple[float, float] | None) -> Number:
    """Largest Re(conj(pull) v) over unit-disc vectors v in the sector, or somewhat more."""
    if sector is None:
        return abs(pull)
    (along, across), (cos, sin) = (pull * direction(sector[0]).conjugate()).parts(), direction(sector[1]).parts()
    across, most = abs(across), abs(pull)
    edge = largest(along * cos + across * sin, ZERO)
    if (along * sin).high <= (across * cos).low:
        return edge
    # what may be inside the sector or beside it is no less than at its edge
    return most if (along * sin).low > (across * cos).high else Number(min(edge.low, most.low), most.high)
