"""Limits that counterweights touch, and what each costs, in the units of a designer: newtons per kilogram."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple, get_args

import numpy as np

from optimizer.formulation.formulate import RESPONSES, given_ceilings, limited, weights
from optimizer.formulation.limits import MACHINE_LIMITS, TOUCHED, given_limits
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.sensitivity import ShadowPrices
from optimizer.responses.response import Response
from schemas.answer.counterweights import Counterweight
from schemas.answer.limits import MachineLimit, PriceUnit, ShadowPrice, WebLimit
from schemas.machine.machine import Machine
from schemas.request.objective import Objective

#: optima may differ by this share of the objective without counterweights: what is worth less holds nothing up
_WORTH = 1e-6
_UNITS: Mapping[str, PriceUnit] = {unit: unit for unit in get_args(PriceUnit)}


class Priced(NamedTuple):
    """A limit, and what it costs."""

    limit: WebLimit | MachineLimit
    web: str | None
    price: float  # objective per unit of the limit
    size: float  # of the limit
    unit: str


def touched_limits(
    machine: Machine,
    objective: Objective,
    responses: Sequence[Response],
    mass_kg: Real,
    unbalance: Complex,
    omega_squared: float,
) -> tuple[MachineLimit, ...]:
    """Limits of the whole machine, and ceilings, that are touched, in the order of the answer.

    Parameters
    ----------
    mass_kg, unbalance : (K,) kg and kg m, of the counterweights.
    """
    peaks = (each.to(unbalance).peak * omega_squared for each, _ in limited(responses, objective))
    given = zip(given_ceilings(objective), peaks, strict=True)
    return (
        *touched_by_mass(machine, mass_kg),
        *(each.limit for (each, allowed), peak in given if peak >= allowed * (1.0 - TOUCHED)),
    )


def touched_by_mass(machine: Machine, mass_kg: Real) -> tuple[MachineLimit, ...]:
    """Limits of the whole machine that masses (K,) kg touch."""
    nowhere = np.zeros_like(mass_kg)  # the angles of counterweights are no matter of the machine
    return tuple(name for name, limit in MACHINE_LIMITS.items() if limit.touched(machine, mass_kg, nowhere))


class Quantity(NamedTuple):
    """What an objective is told as: the objective over a weight is of this unit."""

    weight: float
    unit: str


def quantity_of(machine: Machine, objective: Objective) -> Quantity | None:
    """Force, or moment where the force has no weight; None where neither has."""
    wanted = weights(machine, objective)
    weighed = (Quantity(float(wanted[each.name]), each.unit) for each in RESPONSES.values() if wanted[each.name] > 0)
    return next(weighed, None)


def shadow_prices(
    machine: Machine,
    quantity: Quantity,
    prices: Iterable[Priced],
    counterweights: Sequence[Counterweight],
    touched: Collection[MachineLimit],
    omega_squared: float,
    gap: float,
    at_rest: float,
) -> tuple[ShadowPrice, ...]:
    """Prices of the limits that are touched, and of those that are not but hold the objective up.

    Parameters
    ----------
    prices : of one program, in objective over omega^2.
    touched : limits of the machine that the counterweights touch.
    gap, at_rest : certified gap, and objective without counterweights, over omega^2.
    """
    active = {each.web: each.active_limits for each in counterweights}
    return tuple(
        ShadowPrice(
            limit=each.limit,
            web=each.web,
            # where a whole limit is worth less than the gap its price cannot be told from 0; a limit of 0 has a price
            value=each.price * omega_squared / quantity.weight
            if each.size == 0.0 or each.price * each.size > gap
            else 0.0,
            unit=_UNITS[f"{quantity.unit}/{each.unit}"],
        )
        for each in prices
        if each.limit in (touched if each.web is None else active[each.web])
        or each.price * each.size > _WORTH * at_rest
    )


def of_limits(machine: Machine, prices: ShadowPrices) -> Iterator[Priced]:
    """What every limit of mass and place costs that is given, web by web, then of the machine."""
    of_webs = {
        name: (limit.unit, size.tolist(), limit.price(machine, prices).tolist())
        for name, (limit, size) in given_limits(machine).items()
    }
    for k, web in enumerate(machine.webs):
        if web.fixed is not None:
            continue
        for name, (unit, size, price) in of_webs.items():
            if size[k] < np.inf:
                yield Priced(name, web.name, price[k], size[k], unit)
    for limit_name, limit in MACHINE_LIMITS.items():
        if limit.size(machine) < np.inf:
            yield Priced(limit_name, None, float(limit.price(machine, prices)), float(limit.size(machine)), limit.unit)


def of_ceilings(objective: Objective, prices: Real, omega_squared: float) -> Iterator[Priced]:
    """What every ceiling of the first order costs that is given.

    Parameters
    ----------
    prices : (M,) of the M ceilings of the first order alone, whatever else a program limits.
    """
    for (each, allowed), price in zip(given_ceilings(objective), prices.tolist(), strict=True):
        # an objective over omega^2 per ceiling over omega^2
        yield Priced(each.limit, None, price / omega_squared, allowed, per(each.unit))


def per(unit: str) -> str:
    """A unit as it stands behind a stroke."""
    return f"({unit})" if " " in unit else unit
