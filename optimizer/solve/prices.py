"""Limits that counterweights touch, and what each costs, in the units of a designer: newtons per kilogram."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import NamedTuple, get_args

import numpy as np

from optimizer.formulation.formulate import RESPONSES, objective_ceilings
from optimizer.formulation.goals import Limited
from optimizer.formulation.limits import MACHINE_LIMITS, limit_sizes
from optimizer.numerics.arrays import Real
from optimizer.program.sensitivity import ShadowPrices
from schemas.answer.limits import CeilingField, MachineLimit, PriceUnit, ShadowPrice, WebLimit
from schemas.base.responses import ceilings
from schemas.machine.machine import Machine
from schemas.request.objective import Objective

#: optima may differ by this share of the objective without counterweights: what is worth less holds nothing up
_WORTH = 1e-6
_UNITS: Mapping[str, PriceUnit] = {unit: unit for unit in get_args(PriceUnit)}
#: units of the ceilings over the turn
_UNIT_OF: Mapping[CeilingField, str] = {
    "bearing_ceiling_N": "N",
    "specific_load_ceiling_Pa": "Pa",
    "bending_ceiling_Nm": "N m",
    **{ceiling.field: ceiling.unit for ceiling in ceilings()},
}


class Priced(NamedTuple):
    """A limit, and what it costs."""

    limit: WebLimit | MachineLimit
    web: str | None
    price: float  # objective per unit of the limit
    size: float  # of the limit
    unit: str


def touched_by_mass(machine: Machine, mass_kg: Real) -> tuple[MachineLimit, ...]:
    """Limits of the whole machine that masses (K,) kg touch."""
    stated = [(name, limit) for name, limit in MACHINE_LIMITS.items() if limit.stated(machine)]
    if not stated:
        return ()
    nowhere = np.zeros(mass_kg.shape)  # the angles of counterweights are no matter of the machine
    return tuple([name for name, limit in stated if limit.touched(machine, mass_kg, nowhere)])


class ObjectiveUnit(NamedTuple):
    """Unit of an objective in an answer: the objective over a weight is of this unit."""

    weight: float
    unit: str


def _quantity(machine: Machine, objective: Objective) -> ObjectiveUnit:
    """Force, moment where the force has no weight, and what else is weighed where neither has."""
    for response in RESPONSES.values():
        weight = float(response.weight(machine, objective))
        if weight > 0:
            return ObjectiveUnit(weight, response.unit)
    if objective.bearing_weight > 0:
        return ObjectiveUnit(objective.bearing_weight, "Pa" if objective.bearing_measure == "specific" else "N")
    return ObjectiveUnit(objective.bending_weight or objective.roll_weight, "N m")


def shadow_prices(
    machine: Machine,
    objective: Objective,
    prices: ShadowPrices,
    cuts: Sequence[tuple[Limited, int]],
    active: Mapping[str | None, Collection[WebLimit | MachineLimit]],
    omega_squared: float,
    gap: float,
    at_rest: float,
) -> tuple[ShadowPrice, ...]:
    """Prices of the limits that are touched, and of those that are not but hold the objective up, of one machine.

    Parameters
    ----------
    prices : of one program, in objective over omega^2; ceilings of the first order first.
    cuts : what is limited over the turn, and how many ceilings of the program are its cuts.
    active : limits that are touched on each web, and by None those of the machine.
    gap, at_rest : certified gap, and objective without counterweights, over omega^2.
    """
    quantity = _quantity(machine, objective)
    first = prices.ceiling.size - sum(count for _, count in cuts)
    limits = (
        *of_limits(machine, prices),
        *(_of_ceilings(objective, prices.ceiling[:first], omega_squared) if first else ()),
        *_of_limited(objective, cuts, prices.ceiling[first:]),
    )
    return tuple(
        [
            ShadowPrice.of_figures(
                {
                    "limit": limit,
                    "web": web,
                    # where a whole limit is worth less than the gap its price counts as 0; a limit of 0 has one
                    "value": price * omega_squared / quantity.weight if size == 0.0 or price * size > gap else 0.0,
                    "unit": _UNITS[f"{quantity.unit}/{unit}"],
                }
            )
            for limit, web, price, size, unit in limits
            if limit in active[web] or price * size > _WORTH * at_rest
        ]
    )


def of_limits(machine: Machine, prices: ShadowPrices) -> Iterator[Priced]:
    """Prices of all limits of mass and place in the request, web by web, then of the machine."""
    of_webs = {
        name: (limit.unit, size.tolist(), limit.price(machine, prices).tolist())
        for name, (limit, size) in limit_sizes(machine).items()
    }
    for k, web in enumerate(machine.webs):
        if web.fixed is not None:
            continue
        for name, (unit, size, price) in of_webs.items():
            if size[k] < np.inf:
                yield Priced(name, web.name, price[k], size[k], unit)
    for limit_name, limit in MACHINE_LIMITS.items():
        if limit.stated(machine):
            yield Priced(limit_name, None, float(limit.price(machine, prices)), float(limit.size(machine)), limit.unit)


def _of_ceilings(objective: Objective, prices: Real, omega_squared: float) -> Iterator[Priced]:
    """Prices of all ceilings of the first order.

    Parameters
    ----------
    prices : (M,) of the M ceilings of the first order alone, whatever else a program limits.
    """
    for (entry, allowed), price in zip(objective_ceilings(objective), prices.tolist(), strict=True):
        # an objective over omega^2 per ceiling over omega^2
        yield Priced(entry.limit, None, price / omega_squared, allowed, _per(entry.unit))


def _of_limited(objective: Objective, cuts: Sequence[tuple[Limited, int]], prices: Real) -> Iterator[Priced]:
    """Every ceiling over the turn: raising it raises the caps of all cuts (M,) of all that it limits."""
    first, totals = 0, dict[CeilingField, tuple[MachineLimit, float]]()
    for entry, count in cuts:
        allowed = getattr(objective, entry.field)
        # of specific loads the area of the bearing
        share = entry.ceiling / allowed if allowed > 0 else 1.0
        of_cuts = float(np.sum(prices[first : first + count])) * share / entry.omega_squared
        first += count
        totals[entry.field] = entry.limit, totals.get(entry.field, (entry.limit, 0.0))[1] + of_cuts
    for field, (limit, price) in totals.items():
        yield Priced(limit, None, price, getattr(objective, field), _per(_UNIT_OF[field]))


def _per(unit: str) -> str:
    """A unit as it stands behind a stroke."""
    return f"({unit})" if " " in unit else unit
