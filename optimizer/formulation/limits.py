"""The limits that a machine states, a small entry each; several largest masses of a web are a minimum.

The program sees none of them by name: it gets the smallest of the masses, one sector and one budget.
Fields may hold columns, as in :func:`optimizer.mechanics.layout.layout`.
"""

from collections.abc import Callable
from functools import lru_cache, reduce
from typing import NamedTuple, Protocol

import numpy as np

from optimizer.formulation.groups import alike_webs
from optimizer.mechanics.angles import direction
from optimizer.mechanics.fixed_weights import any_fixed, fixed_mass, fixed_webs
from optimizer.mechanics.layout import stacked, web_radii
from optimizer.mechanics.shapes import plates
from optimizer.numerics.arrays import Complex, Real, Reals, all_true, any_true, mapped, spread
from optimizer.numerics.memoization import remembered
from optimizer.numerics.records import record
from optimizer.program.limits import Limits
from optimizer.program.sensitivity import ShadowPrices
from schemas.answer.limits import MachineLimit, WebLimit
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import balance_shafts

#: a limit counts as touched when the quantity is nearer to it than this share of it. Optima may differ by
#: 1e-6 of the objective, which is more than that of a mass
TOUCHED = 1e-4
#: a larger limit is none, kg
_NO_LIMIT = 1e30
#: degrees of no sector
_NO_CENTRE, _HALF = np.zeros(1), np.array([90.0])


def _unit(_: Machine) -> Reals:
    """Kilograms of a kilogram."""
    return 1.0


class Limit(Protocol):
    """A limit in the unit of the answer; (..., K) of every web, (...) of the machine."""

    @property
    def unit(self) -> str: ...

    def stated(self, machine: Machine) -> bool:
        """Whether there is one anywhere."""
        ...

    def size(self, machine: Machine) -> Real:
        """The limit in its unit; inf where there is none."""
        ...

    def touched(self, machine: Machine, mass_kg: Real, angle_deg: Real) -> np.ndarray:
        """Whether counterweights (..., K) stand at it."""
        ...

    def price(self, machine: Machine, prices: ShadowPrices) -> Real:
        """Fall of the smallest objective per unit by which it is raised."""
        ...


@record(frozen=True)
class MassLimit:
    """What a counterweight may have at most of something that grows with its mass."""

    unit: str
    largest: Callable[[Machine], Real]  # (..., K), in the unit; inf where a web has no such limit
    per_kg: Callable[[Machine], Reals]  # (..., K), in the unit
    presence: Callable[[Machine], bool] | None = None  # whether any web has one; None where its sizes tell

    def stated(self, machine: Machine) -> bool:
        if self.presence is not None:
            return self.presence(machine)
        return any_true(self.largest(machine) < np.inf)

    def mass(self, machine: Machine) -> Real:
        """Largest mass of every web, kg."""
        largest = self.largest(machine)
        return largest if self.per_kg is _unit else largest / self.per_kg(machine)

    def size(self, machine: Machine) -> Real:
        return self.largest(machine)

    def touched(self, machine: Machine, mass_kg: Real, angle_deg: Real) -> np.ndarray:
        return mass_kg >= self.mass(machine) * (1.0 - TOUCHED)

    def price(self, machine: Machine, prices: ShadowPrices) -> Real:
        # of several the smallest mass is the one that binds
        mass, smallest = self.mass(machine), largest_mass(machine)
        price = prices.max_mass if self.per_kg is _unit else prices.max_mass / self.per_kg(machine)
        return price if mass is smallest else np.where(mass <= smallest, price, 0.0)


class _Sector:
    unit = "deg"

    def stated(self, machine: Machine) -> bool:
        free, _, _ = sectors(machine)
        return not all_free(free)

    def size(self, machine: Machine) -> Real:
        free, _, half_angle = sectors(machine)
        return np.where(free, np.inf, half_angle)

    def touched(self, machine: Machine, mass_kg: Real, angle_deg: Real) -> np.ndarray:
        free, centre, half_angle = sectors(machine)
        off = np.abs(np.mod(angle_deg - centre + 180.0, 360.0) - 180.0)
        return ~free & (mass_kg > 0) & (off >= half_angle * (1.0 - TOUCHED))

    def price(self, machine: Machine, prices: ShadowPrices) -> Real:
        # a sector is opened to both sides
        return np.radians(prices.half_angle)


class _Budget:
    unit = "kg"

    def stated(self, machine: Machine) -> bool:
        return machine.max_total_mass_kg is not None

    def size(self, machine: Machine) -> Real:
        budget = machine.max_total_mass_kg
        return np.asarray(np.inf if budget is None else budget, dtype=float)

    def touched(self, machine: Machine, mass_kg: Real, angle_deg: Real) -> np.ndarray:
        return np.asarray(np.add.reduce(mass_kg, axis=-1) >= self.size(machine) * (1.0 - TOUCHED))

    def price(self, machine: Machine, prices: ShadowPrices) -> Real:
        return prices.max_total_mass


def _largest_unbalances(machine: Machine) -> Real:
    """What the envelopes of the webs hold (K,), kg m; inf where there is none."""
    most, cut = np.full(len(machine.webs), np.inf), plates(machine)
    if cut is not None:
        most[cut.webs] = cut.unbalance(cut.most)
    return most


def _largest_force(machine: Machine) -> Real:
    """Largest centrifugal force of every web (..., K), N."""
    forces = (web.max_centrifugal_force_N for web in machine.webs)
    return stacked([np.inf if force is None else force for force in forces])


def _force_per_kg(machine: Machine) -> Real:
    """Centrifugal force of a kilogram on every web (..., K) at the highest speed of its shaft, N."""
    fastest = machine.speed_rpm if machine.overspeed_rpm is None else machine.overspeed_rpm
    omega = np.asarray(fastest) * (np.pi / 30.0)
    return web_radii(machine) * (np.square(omega)[..., None] * np.square(_speed_ratios(machine)))


@remembered
def _speed_ratios(machine: Machine) -> Real:
    """Turns of every web (K,) for one of the crankshaft: wherever a web of a balance shaft stands, by its name."""
    ratios = {web.name: float(shaft.speed_ratio) for shaft in balance_shafts(machine) for web in shaft.webs}
    return np.array([ratios.get(web.name, 1.0) for web in machine.webs])


#: of every web, as the answer calls them and in its order; one more is one more entry
WEB_LIMITS: dict[WebLimit, Limit] = {
    "max_mass": MassLimit(
        "kg",
        largest=remembered(
            lambda machine: stacked([np.inf if web.max_mass_kg is None else web.max_mass_kg for web in machine.webs])
        ),
        per_kg=_unit,
        presence=lambda machine: any(web.max_mass_kg is not None for web in machine.webs),
    ),
    "envelope": MassLimit(
        "(kg m)",
        largest=_largest_unbalances,
        per_kg=web_radii,
        presence=lambda machine: plates(machine) is not None,
    ),
    "max_centrifugal_force": MassLimit(
        "N",
        _largest_force,
        _force_per_kg,
        presence=lambda machine: any(web.max_centrifugal_force_N is not None for web in machine.webs),
    ),
    "sector": _Sector(),
}
#: of the machine
MACHINE_LIMITS: dict[MachineLimit, Limit] = {"max_total_mass": _Budget()}


class LimitSize(NamedTuple):
    """A limit of the webs that is stated at all."""

    limit: Limit
    size: Real  # (..., K) in its unit; inf where a web has no such limit


@remembered
def limit_sizes(machine: Machine) -> dict[WebLimit, LimitSize]:
    """Limits that some web of a machine states, in the order of the answer; no other is touched, or has a price."""
    return {name: LimitSize(limit, limit.size(machine)) for name, limit in WEB_LIMITS.items() if limit.stated(machine)}


@remembered
def largest_mass(machine: Machine) -> Real:
    """Largest mass of every web (..., K), the smallest of what its limits allow, kg; inf where there is none."""
    entries = (size.limit for size in limit_sizes(machine).values())
    allowed = [limit.mass(machine) for limit in entries if isinstance(limit, MassLimit)]
    mass = reduce(np.minimum, allowed) if allowed else np.full(len(machine.webs), np.inf)
    if any_fixed(machine):
        # their counterweights are no variables
        mass = np.where(fixed_webs(machine), 0.0, mass)
    # null, or more than can be multiplied
    many = mass > _NO_LIMIT
    return np.where(many, np.inf, mass) if any_true(many) else mass


def least_fitted(machine: Machine) -> Real:
    """Least mass of what is fitted on every web (..., K), kg; 0 where there is none."""
    return stacked([web.min_fitted_mass_kg or 0.0 for web in machine.webs])


def limits(machine: Machine, leading: tuple[int, ...] = ()) -> Limits:
    """Limits of the counterweights on the webs of a machine, or of many (*leading, K)."""
    webs = machine.webs
    free, towards, half_angle = sectors(machine)
    if all_free(free):
        centre, cosine, sine = _half_planes(len(webs))
    else:
        centre, edge = direction(towards), direction(half_angle)
        cosine, sine = edge.real, edge.imag
    shape, alike = (*leading, len(webs)), alike_webs(machine)
    # a number where there are no more axes
    left = MACHINE_LIMITS["max_total_mass"].size(machine)[()]
    if any_fixed(machine):
        left = left - fixed_mass(machine)
    radius, most = web_radii(machine), largest_mass(machine)
    if not leading:
        return Limits(radius, most, free, centre, cosine, sine, left, alike)
    return Limits(
        radius=spread(radius, shape),
        max_mass=spread(most, shape),
        free=spread(free, shape),
        centre=spread(centre, shape),
        half_angle_cos=spread(cosine, shape),
        half_angle_sin=spread(sine, shape),
        max_total_mass=spread(left, leading),
        alike=None if alike is None else mapped(alike, lambda array: spread(array, shape)),
    )


@remembered
def sectors(machine: Machine) -> tuple[np.ndarray, Real, Real]:
    """Which webs have no sector (K,); centres and half-angles [deg] (..., K), 0 and 90 where there is none."""
    webs = machine.webs
    present = [web.sector is not None for web in webs]
    if not any(present):
        return _without(len(webs))
    return (
        ~np.array(present, dtype=bool),
        stacked([web.sector.centre_deg if web.sector else 0.0 for web in webs]),
        stacked([web.sector.half_angle_deg if web.sector else 90.0 for web in webs]),
    )


def all_free(free: np.ndarray) -> bool:
    """Whether no web has a sector, by the first of what :func:`sectors` has."""
    return free is _without(free.size)[0] or all_true(free)


@lru_cache(maxsize=32)
def _without(count: int) -> tuple[np.ndarray, Real, Real]:
    """What so many webs without sectors have; nobody writes to it."""
    return np.ones(count, bool), _NO_CENTRE.repeat(count), _HALF.repeat(count)


@lru_cache(maxsize=32)
def _half_planes(count: int) -> tuple[Complex, Real, Real]:
    """Middles of so many sectors that are none, and cosines and sines of their half-angles; nobody writes to them."""
    return np.ones(count, complex), np.zeros(count), np.ones(count)
