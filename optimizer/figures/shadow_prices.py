"""Shadow prices in the units of a designer: newtons per kilogram."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import NamedTuple, get_args

import numpy as np

from optimizer.formulate import RESPONSES, ceilings
from optimizer.program.sensitivity import ShadowPrices
from schemas.answers import Counterweight, MachineLimit, PriceUnit, ShadowPrice, WebLimit
from schemas.machine import Machine
from schemas.requests import Objective

#: optima may differ by this share of the objective without counterweights: what is worth less holds nothing up
_WORTH = 1e-6
_UNITS: Mapping[str, PriceUnit] = {unit: unit for unit in get_args(PriceUnit)}


class _Priced(NamedTuple):
    limit: WebLimit | MachineLimit
    web: str | None
    price: float  # objective per unit of the limit
    size: float  # of the limit
    unit: str
    touched: bool


def shadow_prices(  # noqa: PLR0913, PLR0917 - the statement in the user's words, and what its prices are told from
    machine: Machine,
    objective: Objective,
    weights: Mapping[str, float],
    prices: ShadowPrices,
    counterweights: Sequence[Counterweight],
    touched: Collection[MachineLimit],
    omega_squared: float,
    gap: float,
    at_rest: float,
) -> tuple[ShadowPrice, ...]:
    """Prices of the limits that are touched, and of those that are not but hold the objective up.

    Parameters
    ----------
    weights : of the peaks, w_F [1/N] and w_M [1/(N m)].
    prices : of one program, in objective over omega^2; ceilings force first.
    touched : limits of the machine that the counterweights touch.
    gap, at_rest : certified gap, and objective without counterweights, over omega^2.
    """
    weight, quantity = next((weights[each.name], each.unit) for each in RESPONSES.values() if weights[each.name] > 0)
    return tuple(
        ShadowPrice(
            limit=each.limit,
            web=each.web,
            # where a whole limit is worth less than the gap its price cannot be told from 0; a limit of 0 has a price
            value=each.price * omega_squared / weight if each.size == 0.0 or each.price * each.size > gap else 0.0,
            unit=_UNITS[f"{quantity}/{each.unit}"],
        )
        for each in _every(machine, objective, prices, counterweights, touched, omega_squared)
        if each.touched or each.price * each.size > _WORTH * at_rest
    )


def _every(
    machine: Machine,
    objective: Objective,
    prices: ShadowPrices,
    counterweights: Sequence[Counterweight],
    touched: Collection[MachineLimit],
    omega_squared: float,
) -> Iterator[_Priced]:
    for k, (web, fitted) in enumerate(zip(machine.webs, counterweights, strict=True)):
        active = fitted.active_limits
        if web.max_mass_kg is not None:
            yield _Priced("max_mass", web.name, float(prices.max_mass[k]), web.max_mass_kg, "kg", "max_mass" in active)
        if web.sector is not None:
            per_degree = float(np.radians(prices.half_angle[k]))
            half_angle = web.sector.half_angle_deg
            yield _Priced("sector", web.name, per_degree, half_angle, "deg", "sector" in active)
    budget = machine.max_total_mass_kg
    if budget is not None:
        price = float(prices.max_total_mass)
        yield _Priced("max_total_mass", None, price, budget, "kg", "max_total_mass" in touched)
    allowed = ceilings(objective)
    given = [each for each in RESPONSES.values() if each.name in allowed]
    for each, price in zip(given, prices.ceiling, strict=True):
        unit = f"({each.unit})" if " " in each.unit else each.unit
        # an objective over omega^2 per ceiling over omega^2
        yield _Priced(each.limit, None, float(price) / omega_squared, allowed[each.name], unit, each.limit in touched)
