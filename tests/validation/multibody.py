"""A reciprocating machine as rigid bodies in space, integrated in time by EXUDYN: no formula of ours.

Shaft, rods and crossheads are bodies with six coordinates each. The shaft lies in two bearings, which hold its centre
line without moments. A rod turns on its crank pin, holds its crosshead at the other end, and every crosshead slides in
the frame. The polar inertia of the shaft is so large that its speed is constant to a part in 1e7. What the joints of
the frame carry is what the machine does to it.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from optimizer.numerics.arrays import Complex, Real

STEPS = 1440  # of one turn
#: polar inertia of the shaft over that of all moving masses at their crank radii
_HEAVY = 1e7


@dataclass(frozen=True)
class Revolution:
    """What the shaft and the crossheads put on the frame over one turn, as drawn; complex for x + jy."""

    angle_deg: Real  # (T,)
    bearings: Complex  # (bearings, T) N
    force: Complex  # (T,) N
    moment: Complex  # (T,) N m, sum of (z - reference) F


def revolution(machine: dict[str, Any], counterweights: list[dict[str, Any]], reference_m: float) -> Revolution:
    """Integrate one turn of a machine as posted, counter-clockwise, with two bearings.

    Parameters
    ----------
    counterweights : web, mass and angle of each.
    reference_m : plane of the moments.
    """
    import exudyn as exu
    from exudyn.itemInterface import SensorObject

    container = exu.SystemContainer()
    system = container.AddSystem()
    omega = machine["speed_rpm"] * np.pi / 30.0
    ground = system.CreateGround()
    shaft = _shaft(system, machine, counterweights, omega)
    places = [bearing["position_m"] for bearing in machine["bearings"]]
    joints = [
        system.CreateGenericJoint(
            itemNumbers=[ground, shaft], position=[0, 0, z], constrainedAxes=[1, 1, k == 0, 0, 0, 0]
        )
        for k, z in enumerate(places)
    ]
    turned = [1.0] * len(places)
    for throw in machine["throws"]:
        pin = throw["crank_radius_m"] * _unit(throw["crank_angle_deg"])
        for row in throw["rows"]:
            place = throw["position_m"] + row.get("offset_m", 0.0)
            joints.append(_row(system, ground, shaft, row, pin, place, omega))
            turned.append(_unit(row["axis_deg"]))
            places.append(place)
    kind = exu.OutputVariableType.ForceLocal
    sensors = [
        system.AddSensor(SensorObject(objectNumber=joint, outputVariableType=kind, storeInternal=True))
        for joint in joints
    ]
    system.Assemble()
    _integrate(exu, system, 2.0 * np.pi / omega)
    stored = np.array([system.GetSensorStoredData(sensor)[:STEPS, 1:3] for sensor in sensors])
    # EXUDYN's force is that of the second body of a joint, here the moving one, on the first
    force = (stored[..., 0] + 1j * stored[..., 1]) * np.array(turned)[:, None]
    arm = np.array(places)[:, None] - reference_m
    angle = 360.0 / STEPS * np.arange(STEPS)
    return Revolution(angle, force[: len(machine["bearings"])], np.sum(force, axis=0), np.sum(arm * force, axis=0))


def _unit(angle_deg: float) -> complex:
    return complex(np.exp(1j * np.deg2rad(angle_deg)))


def _vector(place: complex, z: float = 0.0) -> list[float]:
    return [place.real, place.imag, z]


def _turned(along: complex) -> Real:
    """Rotation matrix whose x axis lies along a unit vector across the shaft."""
    return np.array([[along.real, -along.imag, 0.0], [along.imag, along.real, 0.0], [0.0, 0.0, 1.0]])


def _shaft(system: Any, machine: dict[str, Any], counterweights: list[dict[str, Any]], omega: float) -> Any:
    """A slender shaft of great polar inertia, with the unbalance of its throws and counterweights as points on it."""
    from exudyn.rigidBodyUtilities import RigidBodyInertia

    webs = {web["name"]: web for web in machine["webs"]}
    points = [
        (
            throw.get("rotating_mass_kg", 0.0),
            throw["crank_radius_m"] * _unit(throw["crank_angle_deg"]),
            throw["position_m"],
        )
        for throw in machine["throws"]
    ]
    for fitted in counterweights:
        web = webs[fitted["web"]]
        place = web["counterweight_radius_m"] * _unit(fitted["angle_deg"])
        points.append((fitted["mass_kg"], place, web["position_m"]))
    total = 1.0 + sum(mass for mass, _, _ in points)
    centre = sum(mass * np.array(_vector(place, z)) for mass, place, z in points) / total
    moving = sum(
        throw["crank_radius_m"] ** 2 * (throw["rotating_mass_kg"] + sum(_moving(row) for row in throw["rows"]))
        for throw in machine["throws"]
    )
    tensor = _HEAVY * moving * np.eye(3)
    for mass, place, z in points:
        at = np.array(_vector(place, z))
        tensor = tensor + mass * (at @ at * np.eye(3) - np.outer(at, at))
    inertia = RigidBodyInertia(mass=total, com=centre, inertiaTensor=tensor, inertiaTensorAtCOM=False)
    return system.CreateRigidBody(inertia=inertia, initialAngularVelocity=[0.0, 0.0, omega])


def _moving(row: dict[str, Any]) -> float:
    return float(row["reciprocating_mass_kg"] + row["connecting_rod"]["mass_kg"])


def _row(system: Any, ground: Any, shaft: Any, row: dict[str, Any], pin: complex, z: float, omega: float) -> Any:
    """Rod and crosshead of a row; the joint between crosshead and frame.

    The rod's two masses are kept, so that its centre of mass and its inertia are those of the two points.
    """
    from exudyn.rigidBodyUtilities import RigidBodyInertia

    rod, axis = row["connecting_rod"], _unit(row["axis_deg"])
    across = (pin * axis.conjugate()).imag
    length, share = rod["length_m"], rod.get("reciprocating_share", 1.0 / 3.0)
    along = np.sqrt(length**2 - across**2)
    crosshead = ((pin * axis.conjugate()).real + along) * axis
    pin_speed = 1j * omega * pin
    sideways = (pin_speed * axis.conjugate()).imag
    speed = ((pin_speed * axis.conjugate()).real - across * sideways / along) * axis
    lies = (crosshead - pin) / length
    turning = ((speed - pin_speed) * lies.conjugate()).imag / length
    mass = rod.get("mass_kg", 0.0) + 1e-9
    swing = mass * share * (1.0 - share) * length**2
    body = system.CreateRigidBody(
        referencePosition=_vector(pin + share * length * lies, z),
        referenceRotationMatrix=_turned(lies),
        initialVelocity=_vector(pin_speed + share * (speed - pin_speed)),
        initialAngularVelocity=[0.0, 0.0, turning],
        inertia=RigidBodyInertia(mass=mass, com=[0, 0, 0], inertiaTensor=np.diag([swing, swing, swing])),
    )
    slider = system.CreateRigidBody(
        referencePosition=_vector(crosshead, z),
        initialVelocity=_vector(speed),
        inertia=RigidBodyInertia(mass=row["reciprocating_mass_kg"], com=[0, 0, 0], inertiaTensor=np.eye(3)),
    )
    system.CreateRevoluteJoint(itemNumbers=[shaft, body], position=_vector(pin, z), axis=[0, 0, 1])
    at = _vector(crosshead, z)
    system.CreateGenericJoint(itemNumbers=[body, slider], position=at, constrainedAxes=[1, 1, 0, 0, 0, 0])
    return system.CreateGenericJoint(
        itemNumbers=[ground, slider],
        position=at,
        rotationMatrixAxes=_turned(axis),
        constrainedAxes=[0, 1, 1, 1, 1, 1],
    )


def _integrate(exu: Any, system: Any, period: float) -> None:
    settings = exu.SimulationSettings()
    settings.timeIntegration.numberOfSteps = STEPS
    settings.timeIntegration.endTime = period
    settings.timeIntegration.verboseMode = 0
    settings.timeIntegration.newton.useModifiedNewton = False
    settings.timeIntegration.generalizedAlpha.computeInitialAccelerations = True
    # constraints of the speeds and the trapezoidal rule: second order in the joint forces too
    settings.timeIntegration.generalizedAlpha.useIndex2Constraints = True
    settings.timeIntegration.generalizedAlpha.useNewmark = True
    settings.timeIntegration.generalizedAlpha.spectralRadius = 1.0
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = period / STEPS
    system.SolveDynamic(settings)
