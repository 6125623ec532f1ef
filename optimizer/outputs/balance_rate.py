"""Balance rates of the throws: how much of its own crank each pair of webs balances."""

from typing import NamedTuple

from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.balance_rate import balance_rates, customary
from optimizer.mechanics.crank_of_web import shares
from optimizer.mechanics.layout import layout, stacked
from optimizer.numerics.arrays import SMALLEST, Complex, Real
from optimizer.numerics.memoization import remembered
from optimizer.outputs.output import Columns, Output
from schemas.answer.answers import BalanceRate
from schemas.answer.outputs import labels
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.machine.throws import Throw


class Cranks(NamedTuple):
    """Rotating unbalance of the throws, and which webs are theirs; of one machine, or of many with leading axes."""

    rotating: Complex  # (..., throws) kg m, with the rotating shares of the rods
    shares: Real  # (..., throws, webs)

    def rates(self, unbalance: Complex) -> Complex:
        """Balance rate and, imaginary, its sideways part (..., throws), with counterweights (..., webs) kg m."""
        return balance_rates(self.rotating, self.shares, unbalance)

    @property
    def customary(self) -> Complex:
        """Counterweights (..., webs) kg m of a uniform rate of 1."""
        return customary(self.rotating, self.shares)


@remembered
def cranks(machine: ReciprocatingMachine) -> Cranks:
    """Throws of a machine and their webs; its fields may hold columns (n,)."""
    masses = [_rotating_mass(throw) for throw in machine.throws]
    radii = stacked([throw.crank_radius_m for throw in machine.throws])
    crank = layout(machine).cranks
    assert crank is not None  # it is no scroll machine
    return Cranks(stacked(masses) * radii * crank, shares(machine))


def balance_rate(machine: Machine, unbalance: Complex | None) -> tuple[BalanceRate, ...]:
    """Balance rates with counterweights (webs,) kg m; none without counterweights to show, or without throws."""
    if unbalance is None or not isinstance(machine, ReciprocatingMachine):
        return ()
    crank = layout(machine).cranks
    assert crank is not None  # it is no scroll machine
    webs = unbalance.tolist()
    return tuple(
        [
            _rate(number, throw, _rotating_mass(throw) * throw.crank_radius_m * vector, share, webs)
            for number, (throw, vector, share) in enumerate(
                zip(machine.throws, crank.tolist(), shares(machine).tolist(), strict=True)
            )
        ]
    )


def _rotating_mass(throw: Throw) -> float:
    """With the rotating shares of the rods, kg; fields of the throw may hold columns."""
    return throw.rotating_mass_kg + sum([row.rotating_kg for row in throw.rows])


def _rate(number: int, throw: Throw, rotating: complex, share: list[float], webs: list[complex]) -> BalanceRate:
    """As :func:`optimizer.mechanics.balance_rate.balance_rates`, of one throw in plain numbers."""
    if not abs(rotating) > SMALLEST:
        return BalanceRate(throw=number, name=throw.name, rate=None, sideways=None)
    rate = -sum([part * vector for part, vector in zip(share, webs, strict=True)], 0j) / rotating
    return BalanceRate.of_figures(
        {"throw": number, "name": throw.name, "rate": rate.real + 0.0, "sideways": rate.imag + 0.0}
    )


def _columns(scene: Prepared, unbalance: Complex) -> dict[str, Real]:
    machine = scene.machine
    if not isinstance(machine, ReciprocatingMachine):
        return {}
    rates, result = cranks(machine).rates(unbalance), {}
    for k, label in enumerate(labels([throw.name for throw in machine.throws])):
        result[f"balance_rate.{label}"] = rates[..., k].real
        result[f"balance_rate_sideways.{label}"] = rates[..., k].imag
    return result


BALANCE_RATE = Output(
    "balance_rate",
    "how much of its own crank each pair of webs balances",
    (),
    lambda scene, unbalance: balance_rate(scene.machine, unbalance),
    Columns(_columns),
)
