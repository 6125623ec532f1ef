"""Gas forces in the piston rod at the dead centres."""

from collections.abc import Sequence

from optimizer.rating.sizes import Acting
from schemas.rating.answer import CylinderSize, DeadCentre, GasLoads, TandemLoads


def gas_loads(p1: float, p2: float, ambient: float, acting: Acting, size: CylinderSize) -> GasLoads:
    """Gas forces [N] of one cylinder, positive in rod tension, (1-13) to (1-16).

    At the outer dead centre the head side has just discharged and the crank side just taken in. At the inner one it is
    the other way round: p1 F_z - p2 F_g and p2 F_z - p1 F_g. An open side is at ambient pressure.

    Parameters
    ----------
    p1, p2, ambient : absolute pressures [Pa] at suction, at discharge and on an open side.
    """
    head_works, crank_works = acting != "crank", acting != "head"
    outer = _dead_centre(p2 if head_works else ambient, p1 if crank_works else ambient, size)
    inner = _dead_centre(p1 if head_works else ambient, p2 if crank_works else ambient, size)
    return GasLoads(outer=outer, inner=inner, largest_N=max(abs(outer.gas_force_N), abs(inner.gas_force_N)))


def tandem_loads(stages: Sequence[int], loads: Sequence[GasLoads]) -> TandemLoads:
    """Gas forces [N] of pistons on one rod: their sums at each dead centre.

    Parameters
    ----------
    stages : numbers from 1 of those on the rod.
    loads : of every stage.
    """
    outer = sum(loads[number - 1].outer.gas_force_N for number in stages)
    inner = sum(loads[number - 1].inner.gas_force_N for number in stages)
    return TandemLoads(stages=tuple(stages), outer_N=outer, inner_N=inner, largest_N=max(abs(outer), abs(inner)))


def rod_loads(loads: Sequence[GasLoads], tandems: Sequence[TandemLoads]) -> list[float]:
    """Largest gas force [N] in the rod of every stage, which may carry others too."""
    shared = {number: tandem.largest_N for tandem in tandems for number in tandem.stages}
    return [shared.get(number, load.largest_N) for number, load in enumerate(loads, 1)]


def _dead_centre(head: float, crank: float, size: CylinderSize) -> DeadCentre:
    force = crank * size.crank_area_m2 - head * size.head_area_m2
    return DeadCentre(head_pressure_Pa=head, crank_pressure_Pa=crank, gas_force_N=force)
