"""Forces in rods and on guides, the torque on the shaft, the flywheel, and what overturns the frame."""

from __future__ import annotations

from math import inf, pi, radians, sqrt
from typing import Callable, Dict, Optional

from verify_bearings import PEAK, SAMPLE, magnitude, within
from verify_claims import LARGE, Claim, Claims, same
from verify_dynamics import RUBBED, alone, enclosed, of_row, output, series, signed
from verify_harmonics import Peak
from verify_numbers import ONE, Place, real
from verify_pistons import Piston, Pistons, integral
from verify_pressed import ALL, READINGS, Acting, PressureCurve

#: which forces act in every load case of a rod (design calculation of the 2D12, section 2.5)
CASES = {
    "running": ALL,
    "no_load": Acting(gas=False),
    "sudden_stop": Acting(friction=False, inertia=False),
}
RANGE = 1e-7  # of the torque over a revolution: by which a range of energy may be off
FINE = 2  # parts of a piece in which the torque crosses its mean once at most


def rod_loads(request: Place, pistons: Pistons, place: Place) -> Claims:
    """Series, and the load cases of every rod."""
    claim = "rod_loads"
    table = yield from output(claim, request, pistons, place)
    worst = 0.0
    for row, k, item in table.rows:
        off = (SAMPLE * (row.most + row.moving[0]) + RUBBED * row.friction) * leaning(row)
        there = of_row(pistons, table.angles, k)
        for name in ("rod", "side", "tangential", "radial"):
            values = [ALL.of(state) * READINGS[name](state.piston) for state in there]
            yield from series(claim, item / f"{name}_N", values, off)
        yield from magnitude(claim, item, "peak_side", "N", enclosed(alone(pistons, k, "side"), item), off)
        cases = list(item / "cases")
        yield claim, item / "cases", ONE if len(cases) == len(CASES) else -ONE, ONE
        loads: Dict[str, float] = {}
        for (name, acting), case in zip(CASES.items(), cases):
            curve = alone(pistons, k, "rod", acting)
            yield same(claim, case / "case", name)
            for way, sign in (("tension", 1), ("compression", -1)):
                peak = enclosed(curve, case, sign)
                yield from signed(claim, case, way, peak, off, sign, 0.0)
                yield where(claim, case / f"{way}_deg", curve, peak, off, sign)
            loads[name] = max((case / "tension_N").double(), -(case / "compression_N").double())
        most = max(loads.values(), default=0.0)
        yield same(claim, item / "governing_load_N", most)
        yield claim, item / "governing_case", ONE if loads.get((item / "governing_case").text()) == most else -ONE, ONE
        worst = max(worst, most)
    yield same(claim, place / "governing_load_N", worst)


def leaning(row: Piston) -> float:
    """What a force on the piston is at most multiplied by."""
    return 2 / sqrt(1 - row.ratio**2)


def where(claim: str, place: Place, curve: PressureCurve, peak: Peak, off: float, sign: int = 0) -> Claim:
    """The shaft angle of a peak: the curve has it there."""
    angle, period = radians(place.double()), curve.pistons.period * (1 + 1e-12)
    values = [sign * value.real if sign else abs(value) for value in curve.sides(angle * curve.pistons.sense)]
    there = max(values) if 0 <= angle <= period else -inf
    return claim, place, real(max(there - peak.low + PEAK * abs(peak.low) + off, -LARGE)), real(abs(peak.high) + off)


def torque(request: Place, pistons: Pistons, place: Place) -> Claims:
    """Of every row and of all, its mean, powers, and what a flywheel takes up."""
    claim, omega, every = "torque", sqrt(pistons.square), of_shaft(pistons)
    table = yield from output(claim, request, pistons, place)
    off = RUBBED * every.size + RUBBED * abs(pistons.rubbing)
    samples = [0.0] * len(table.angles)
    for row, k, item in table.rows:
        there = of_row(pistons, table.angles, k)
        values = [row.radius * ALL.of(state) * state.piston.turning for state in there]
        samples = [a + b for a, b in zip(samples, values)]
        yield from series(claim, item / "torque_Nm", values, SAMPLE * every.size)
        mean = row.radius * alone(pistons, k, "tangential").mean.real
        yield within(claim, item / "mean_torque_Nm", mean, mean, off)
    rubs = pistons.rubbing
    yield within(claim, place / "rotating_friction_Nm", rubs, rubs, off)
    samples = [item + rubs for item in samples]
    yield from series(claim, place / "torque_Nm", samples, off)
    radii = {row.radius for row in pistons.rows}
    if len(radii) == 1:
        (radius,) = radii
        yield from series(claim, place / "tangential_N", [item / radius for item in samples], off / radius)
    else:
        yield same(claim, place / "tangential_N", None)
    whole = every.plus(complex(rubs))
    peak = enclosed(whole, place)
    yield from magnitude(claim, place, "peak", "Nm", peak, off)
    yield where(claim, place / "peak_angle_deg", whole, peak, off)
    mean = whole.mean.real
    indicated = sum(row.power(omega) for row in pistons.rows)
    rubbed = sum(4 * row.radius * row.friction for row in pistons.rows) * omega / (2 * pi) + rubs * omega
    for field, value, wide in (
        ("mean_torque_Nm", mean, off),
        ("indicated_power_W", indicated, off * omega),
        ("friction_power_W", rubbed, off * omega),
        ("shaft_power_W", mean * omega, off * omega),
    ):
        yield within(claim, place / field, value, value, wide)
    energy = fluctuation(pistons)
    yield within(claim, place / "fluctuation_energy_J", energy, energy, RANGE * every.size)


def of_shaft(pistons: Pistons) -> PressureCurve:
    """The torque of all rows."""
    return PressureCurve(pistons, "tangential", [(k, row.radius) for k, row in enumerate(pistons.rows)])


def fluctuation(pistons: Pistons) -> float:
    """Range of the running integral of torque - mean [J], which turns where both are equal; by a quadrature."""
    curve = of_shaft(pistons)
    mean, size = curve.mean.real, curve.size
    work, low, high = 0.0, 0.0, 0.0
    for start, end in pistons.pieces:
        within_ = (start + end) / 2

        def beyond(angle: float, inside: float = within_) -> float:
            return curve.value(angle, inside).real - mean

        cuts = [start + (end - start) * k / FINE for k in range(FINE + 1)]
        for a, b in zip(cuts, cuts[1:]):
            root = _root(beyond, a, b)
            for left, right in ((a, root), (root, b)) if root is not None else ((a, b),):
                work += integral(beyond, left, right, size)
                low, high = min(low, work), max(high, work)
    return high - low


def _root(curve: Callable[[float], float], start: float, end: float) -> Optional[float]:
    """Where a curve that changes its sign is 0, by halving."""
    first, last = curve(start), curve(end)
    if first * last >= 0:
        return None
    for _ in range(50):
        middle = (start + end) / 2
        if curve(middle) * first > 0:
            start = middle
        else:
            end = middle
    return start


def flywheel(request: Place, pistons: Pistons, place: Place) -> Claims:
    """Irregularity and inertia: one as it is given, the other by the energy, E = J omega^2 delta."""
    wheel, energy = request / "machine" / "flywheel", fluctuation(pistons)
    off = RANGE * of_shaft(pistons).size
    yield within("flywheel", place / "fluctuation_energy_J", energy, energy, off)
    if wheel / "irregularity":
        share = (wheel / "irregularity").double()
        inertia, wide = energy / pistons.square / share, off / pistons.square / share
        yield within("flywheel", place / "irregularity", share, share, 0.0)
    else:
        inertia, wide = (wheel / "inertia_kg_m2").double(), 0.0
        share = energy / pistons.square / inertia
        yield within("flywheel", place / "irregularity", share, share, off / pistons.square / inertia)
    yield within("flywheel", place / "inertia_J_kg_m2", inertia, inertia, wide)
    yield within("flywheel", place / "inertia_MD2_kg_m2", 4 * inertia, 4 * inertia, 4 * wide)


def overturning(request: Place, pistons: Pistons, place: Place) -> Claims:
    """Side force times its distance from the shaft, which equals the torque."""
    claim = "overturning"
    table = yield from output(claim, request, pistons, place)
    every = of_shaft(pistons)
    off = (SAMPLE + RUBBED) * every.size
    samples = [0.0] * len(table.angles)
    for row, k, entry in table.rows:
        values = [row.radius * ALL.of(state) * state.piston.turning for state in of_row(pistons, table.angles, k)]
        samples = [a + b for a, b in zip(samples, values)]
        yield from series(claim, entry / "couple_Nm", values, off)
    yield from series(claim, place / "couple_Nm", samples, off)
    peak = enclosed(every, place)
    yield from magnitude(claim, place, "peak", "Nm", peak, off)
    yield where(claim, place / "peak_angle_deg", every, peak, off)
