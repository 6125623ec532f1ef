"""Balance rates of the throws of one machine: how much of its own crank each pair of webs balances."""

from typing import NamedTuple

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.mechanics.angles import direction
from optimizer.mechanics.balance_rate import balance_rates, customary, web_shares
from schemas.answers import BalanceRate
from schemas.machine import Machine, ReciprocatingMachine


class Cranks(NamedTuple):
    """Rotating unbalance of the throws, and which webs are theirs."""

    rotating: Complex  # (throws,) kg m, with the rotating shares of the rods
    shares: Real  # (throws, webs)

    def rates(self, unbalance: Complex) -> Complex:
        """Balance rate and, imaginary, its sideways part (throws,)."""
        return balance_rates(self.rotating, self.shares, unbalance)

    @property
    def customary(self) -> Complex:
        """Counterweights (webs,) kg m of a uniform rate of 1."""
        return customary(self.rotating, self.shares)


def cranks(machine: ReciprocatingMachine) -> Cranks:
    """Throws of one machine and their webs."""
    masses = [
        throw.rotating_mass_kg
        + sum(
            (1.0 - row.connecting_rod.reciprocating_share) * row.connecting_rod.mass_kg
            for row in throw.rows
            if row.connecting_rod is not None
        )
        for throw in machine.throws
    ]
    radii = np.array([throw.crank_radius_m for throw in machine.throws])
    crank = direction(np.array([throw.crank_angle_deg for throw in machine.throws]))
    places = (np.array([one.position_m for one in which]) for which in (machine.throws, machine.webs))
    return Cranks(np.array(masses) * radii * crank, web_shares(*places))


def balance_rate(machine: Machine, unbalance: Complex | None) -> tuple[BalanceRate, ...]:
    """Balance rates with counterweights (webs,) kg m; none without counterweights to show, or without throws."""
    if unbalance is None or not isinstance(machine, ReciprocatingMachine):
        return ()
    rates = cranks(machine).rates(unbalance)
    return tuple(
        BalanceRate(
            throw=number,
            name=throw.name,
            rate=None if np.isnan(rate) else float(rate.real) + 0.0,
            sideways=None if np.isnan(rate) else float(rate.imag) + 0.0,
        )
        for number, (throw, rate) in enumerate(zip(machine.throws, rates, strict=True))
    )
