"""Motion, gas, friction and forces of every row at hard angles.

The angles are an even grid, the dead centres and 90 degrees of every row with their neighbourhoods, and the angles
where valves open, to either side. A force is measured against the largest of the same force over the turn, with its
parts (gas of both sides, inertia, friction) taken without regard for their signs.
"""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from optimizer.effects.registry import run
from optimizer.mechanics.gas import switching_angles
from optimizer.mechanics.layout import layout
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.scene import Fidelity
from tests.hard_effects.case import ALGEBRAIC, Case, Finding, error
from tests.hard_effects.exact import Number, Row, State, mp
from tests.hard_effects.exact_turn import Machine, angle_at
from tests.hard_effects.machines import MACHINES, Hard

_EFFECTS = ("kinematics", "gas", "piston_force", "torque", "torque_integrals", "rod_forces", "shaft_loads")
_BEARINGS = [{"name": "A", "position_m": -0.3}, {"name": "B", "position_m": 0.7}]


def _angles(exact: Machine) -> list[float]:
    grid = [2.0 * np.pi * k / 24 + 0.01 for k in range(24)]
    for row in exact.rows:
        for centre in (0, mp.pi / 2, mp.pi, 3 * mp.pi / 2):
            near = [s * d for d in (1e-10, 1e-6, 3e-4, 1e-2) for s in (-1, 1)]
            grid += [float(mp.fmod(centre + d - row.ahead + 4 * mp.pi, 2 * mp.pi)) for d in (0, *near)]
    grid += [float(exact_break) + d for exact_break in exact.breaks for d in (-1e-7, 1e-7)]
    return sorted(x for x in grid if x >= 0.0)


def _parts(state: State) -> Number:
    return sum(abs(gas) for gas in state.gas) + abs(state.inertia) + abs(state.friction)


def _measure(hard: Hard) -> Iterator[Finding]:
    body = {**hard.body, "bearings": _BEARINGS}
    machine = ReciprocatingMachine.model_validate(body)
    exact = Machine(body)
    angles = _angles(exact)
    plan = layout(machine)
    effects = run(machine, plan, _EFFECTS, Fidelity(), np.array(angles))
    states = [[row.at(theta) for theta in angles] for row in exact.rows]
    demanded = ALGEBRAIC * hard.condition

    def worst(
        quantity: str, got: Any, of: Callable[[State], Number], size: Callable[[Row, list[State]], Number]
    ) -> Finding:
        """Worst row of a quantity (rows, T)."""
        errors = [
            error(got[k], [of(state) for state in line], size(row, line))
            for k, (row, line) in enumerate(zip(exact.rows, states, strict=True))
        ]
        return Finding(quantity, max(errors), demanded)

    def largest(of: Callable[[State], Number]) -> Callable[[Row, list[State]], Number]:
        return lambda _row, line: max(abs(of(state)) for state in line)

    moving, gas, pistons, rods = (effects[name] for name in ("kinematics", "gas", "piston_force", "rod_forces"))
    yield worst("displacement", moving.displacement, lambda s: s.displacement, lambda row, _: 2 * row.radius)
    yield worst("velocity", moving.velocity, lambda s: s.velocity, largest(lambda s: s.velocity))
    yield worst("acceleration", moving.acceleration, lambda s: s.acceleration, largest(lambda s: s.acceleration))
    for side in (0, 1):
        size = largest(lambda s, side=side: s.pressure(side))
        yield worst("pressure", gas.forces.pressure[:, side], lambda s, side=side: s.pressure(side), size)
        force = largest(lambda s, side=side: s.gas[side])
        yield worst("gas force of a side", gas.forces.force[:, side], lambda s, side=side: s.gas[side], force)
    yield worst(
        "gas force", pistons.gas, lambda s: sum(s.gas), largest(lambda s: sum(abs(pressures) for pressures in s.gas))
    )
    yield worst("inertia force", pistons.inertia, lambda s: s.inertia, largest(lambda s: s.inertia))
    yield worst("friction force", pistons.friction, lambda s: s.friction, lambda row, _: row.friction)
    yield worst("piston force", pistons.total, lambda s: s.piston, largest(_parts))

    def factor(of: Callable[[State], Number], quantity: str, got: Any, unit: Callable[[Row], Number]) -> Finding:
        def size(row: Row, line: list[State]) -> Number:
            return max(_parts(s) * abs(of(s)) for s in line) * unit(row)

        return worst(quantity, got, lambda s: s.piston * of(s) * unit(s.row), size)

    yield factor(lambda s: mp.sqrt(1 + s.tangent**2), "rod force", rods.rod, lambda _: mp.mpf(1))
    yield factor(lambda s: s.tangent, "side force", rods.side, lambda _: mp.mpf(1))
    yield factor(lambda s: s.rate / s.row.radius, "tangential force", rods.tangential, lambda _: mp.mpf(1))
    yield factor(lambda s: s.cosine - s.sine * s.tangent, "radial force", rods.radial, lambda _: mp.mpf(1))
    yield factor(lambda s: s.rate / s.row.radius, "torque of a row", rods.torque, lambda row: row.radius)
    # side force times the distance from pin to shaft, r cos phi + l cos beta
    yield factor(lambda s: s.rate / s.row.radius, "overturning couple", rods.overturning, lambda row: row.radius)
    torque = [sum(line[t].torque for line in states) + exact.shaft_friction for t in range(len(angles))]
    size = sum(max(_parts(s) * abs(s.rate) for s in line) for line in states) + exact.shaft_friction
    yield Finding("torque", error(effects["torque"].total, torque, size), demanded)
    yield from _shaft(exact, states, effects["shaft_loads"], demanded)
    yield from _switching(exact, effects["gas"].chambers, plan, demanded)


def _shaft(exact: Machine, states: list[list[State]], got: Any, demanded: float) -> Iterator[Finding]:
    """Forces of the rows on the shaft, as vectors."""
    planes, forces = got
    for k, (row, line) in enumerate(zip(exact.rows, states, strict=True)):
        pistons = [s.piston * row.axis * (1 - mp.j * row.sense * s.tangent) for s in line]
        size = max(_parts(s) * mp.sqrt(1 + s.tangent**2) for s in line)
        yield Finding("force of a row on the shaft", error(forces[k], pistons, size), demanded)
        yield Finding("plane of a row", error(planes[k], row.plane, max(abs(row.plane), mp.mpf(1))), ALGEBRAIC)


def _switching(exact: Machine, chambers: Any, plan: Any, demanded: float) -> Iterator[Finding]:
    """Own angles at which valves open, absolute, in radians."""
    suction, discharge = switching_angles(chambers, plan)
    for k, row in enumerate(exact.rows):
        for side, chamber in enumerate(row.chambers):
            if not chamber.closed:
                assert np.isnan(suction[k, side])
                assert np.isnan(discharge[k, side])
                continue
            both = (
                (suction[k, side], chamber.suction_opens, True),
                (discharge[k, side], chamber.discharge_opens, False),
            )
            for got, travel, grows in both:
                angle = angle_at(row, travel if side == 0 else chamber.stroke - travel)
                actual_angle = angle if grows == (side == 0) else 2 * mp.pi - angle
                yield Finding("switching angle [rad]", error(got, actual_angle, mp.mpf(1)), demanded)


CASES = tuple(Case("motion", hard.name, hard.why, lambda hard=hard: _measure(hard)) for hard in MACHINES)
