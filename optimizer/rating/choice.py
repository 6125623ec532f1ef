"""Piston rods and motor from tables: the design is done again until both suffice.

A thicker rod takes area from the crank side, so that bore and gas force grow with it. A motor runs at a speed of its
own, which changes volumes and power. No choice is ever taken back for a smaller one, so that this ends.
"""

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

from optimizer.errors import refuse
from optimizer.rating.loads import rod_loads
from schemas.base.model import FieldProblem
from schemas.base.variation import with_fields
from schemas.rating.answer import Choice, ChoiceStep, RatingAnswer
from schemas.rating.request import RatingRequest
from schemas.rating.tables import Motor, PistonRod

#: the speed of a motor may differ from that of the request by so large a share
SPEED_TOLERANCE = 0.05

#: request at some speed and diameters of the rods [m] -> its rating
Rated = Callable[[RatingRequest, Sequence[float]], RatingAnswer]


class _State(NamedTuple):
    """Which rod of the table each stage has that says none itself, and which motor."""

    rods: tuple[int, ...]
    motor: int


def with_choice(request: RatingRequest, rated: Rated) -> RatingAnswer:
    """The rating with rods and motor from the tables of the request.

    Raises
    ------
    OutOfRange
        if the largest of a table do not suffice, or none of the motors runs at about the speed of the request.
    """
    motors, table = _motors(request), request.piston_rods
    entries = [stage.piston_rod_diameter_m for stage in request.stages]
    state = _State((0,) * len(entries), 0)
    steps: list[ChoiceStep] = []
    while True:
        diameters = [table[k].diameter_m if own is None else own for own, k in zip(entries, state.rods, strict=True)]
        motor = motors[state.motor] if motors else None
        speed = request.speed_rpm if motor is None or motor.speed_rpm is None else motor.speed_rpm
        answer = rated(with_fields(request, {("speed_rpm",): speed}), diameters)
        loads = rod_loads([stage.actual_loads for stage in answer.stages], answer.tandem_loads)
        steps.append(
            ChoiceStep(
                speed_rpm=speed,
                piston_rod_diameters_m=tuple(diameters),
                rod_loads_N=tuple(loads),
                motor_power_W=answer.motor_power_W,
            )
        )
        after = _State(_rods(request, state.rods, loads), _motor(motors, state.motor, answer.motor_power_W))
        if after == state:
            choice = Choice(
                speed_rpm=speed,
                piston_rod_diameters_m=tuple(diameters),
                motor_power_W=None if motor is None else motor.power_W,
                steps=tuple(steps),
            )
            return answer.model_copy(update={"choice": choice})
        state = after


def _motors(request: RatingRequest) -> Sequence[Motor]:
    """Motors that run at about the speed of the request, the weakest first."""
    if not request.motors:
        return ()
    speed = request.speed_rpm
    near = [
        motor
        for motor in request.motors
        if motor.speed_rpm is None or abs(motor.speed_rpm - speed) <= SPEED_TOLERANCE * speed
    ]
    if not near:
        message = f"none runs within {SPEED_TOLERANCE:.0%} of {speed:.5g} rpm, the speed that is asked for"
        refuse([FieldProblem(("motors",), message)])
    return near


def _rods(request: RatingRequest, now: tuple[int, ...], loads: Sequence[float]) -> tuple[int, ...]:
    """The thinnest that bear these forces [N], none thinner than now."""
    refuse(_too_weak(request, loads))
    return tuple(
        k if stage.piston_rod_diameter_m is not None else max(k, _smallest_rod(request.piston_rods, load))
        for stage, k, load in zip(request.stages, now, loads, strict=True)
    )


def _smallest_rod(table: Sequence[PistonRod], load: float) -> int:
    return next(k for k, rod in enumerate(table) if rod.largest_force_N >= load)


def _too_weak(request: RatingRequest, loads: Sequence[float]) -> Iterator[FieldProblem]:
    for number, (stage, load) in enumerate(zip(request.stages, loads, strict=True), 1):
        if stage.piston_rod_diameter_m is None and load > request.piston_rods[-1].largest_force_N:
            strongest = request.piston_rods[-1].largest_force_N
            message = f"the gas force of stage {number} is {load:.5g} N; the strongest rod bears {strongest:.5g} N"
            yield FieldProblem(("piston_rods",), message)


def _motor(motors: Sequence[Motor], now: int, power: float) -> int:
    if not motors:
        return 0
    if power > motors[-1].power_W:
        message = f"the machine needs {power:.5g} W; the strongest motor for its speed gives {motors[-1].power_W:.5g} W"
        refuse([FieldProblem(("motors",), message)])
    return max(now, next(k for k, motor in enumerate(motors) if motor.power_W >= power))
