"""What shakes the frame: ellipses of the first order, phasors of all orders, and what no counterweight removes."""

from __future__ import annotations

from math import inf, sqrt
from typing import Callable, Dict, Iterable, List, Optional, Sequence, Tuple

from verify_claims import Claims, near, same
from verify_machine import NAMES, NOTHING, Machine, Mass, Responses, row_masses
from verify_numbers import BLUR, HALF, ONE, ZERO, Number, Place, direction, real
from verify_shafts import power

#: kg m, what turns with and against the shaft, and where it is along it [m]
_Turning = Tuple[Number, Number, Number, Number]
_EITHER_WAY = Number((-ONE).low, ONE.high)
SERIES = 1e-12  # share by which the sum of a series in doubles may be off
_FIGURES: Dict[str, Callable[[Number, Number], Number]] = {
    "peak": lambda co, counter: abs(co) + abs(counter),
    "minor": lambda co, counter: abs(abs(co) - abs(counter)),
    "peak_x": lambda co, counter: abs(co + counter.conjugate()),
    "peak_y": lambda co, counter: abs(co - counter.conjugate()),
    "co_rotating": lambda co, counter: abs(co),
    "counter_rotating": lambda co, counter: abs(counter),
}


def first_order(claim: str, place: Place, responses: Responses) -> Claims:
    """Both ellipses."""
    for name, unit in NAMES.items():
        pair = responses[name]
        for figure, evaluate in _FIGURES.items():
            leaf = place / name / f"{figure}_{unit}"
            if leaf:
                yield near(claim, leaf, evaluate(*pair))
        axis, product = place / name / "major_axis_deg", pair[0] * pair[1]
        if axis:
            # along e^{ja} both phasors point the same way: their product is along e^{2ja}
            degrees = axis.double()
            way = direction(degrees) + BLUR
            yield claim, axis, -abs(product - way * way * abs(product)) if 0 <= degrees <= 180 else -ONE, abs(product)


def of_order(
    request: Place, machine: Machine, order: int, shafts: Sequence[Tuple[int, Mass]] = ()
) -> Optional[Responses]:
    """Phasors that turn ``order`` times, an even number; None where a row has no rod."""
    if order not in machine.higher:
        machine.higher[order] = _of_rows(request, machine, order)
    own = machine.higher[order]
    geared = [(mass.product * real(order * order), mass) for ratio, mass in shafts if ratio == order]
    if own is None or not geared:
        return own
    return _plus(own, machine, [(size, mass.co, mass.counter, mass.position) for size, mass in geared])


def _of_rows(request: Place, machine: Machine, order: int) -> Optional[Responses]:
    design = request / "machine"
    # the series cut off behind its second term
    cut_off = (request / "fidelity" / "kinematics").text(default="exact") == "order_2"
    parts: List[_Turning] = []
    for throw in design / "throws":
        radius, crank = (throw / "crank_radius_m").number(), direction((throw / "crank_angle_deg").double())
        for row in throw / "rows":
            rod, axis = row / "connecting_rod", direction((row / "axis_deg").double())
            if not rod:
                return None
            length = (rod / "length_m").double(least=1e-300) if rod / "length_m" else inf
            ratio = min((throw / "crank_radius_m").double() / length, 1.0)
            share, off = (ratio if order == 2 else 0.0, 0.0) if cut_off else harmonic(order, ratio)
            size = row_masses(row)[0] * radius * HALF * (real(share) + real(off) * _EITHER_WAY)
            phasor = power(crank * axis.conjugate(), order)
            where = (throw / "position_m").number() + (row / "offset_m").number(0.0)
            parts.append((size, axis * phasor, axis * phasor.conjugate(), where))
    return _plus(dict.fromkeys(NAMES, (ZERO, ZERO)), machine, parts)


def _plus(responses: Responses, machine: Machine, parts: Sequence[_Turning]) -> Responses:
    sums = {name: [*responses[name]] for name in NAMES}
    for size, co, counter, where in parts:
        for name, pair in sums.items():
            arm = ONE if name == "force" else where * machine.wide - machine.plane * machine.wide
            force = size * machine.wide * machine.square * arm
            for k, way in enumerate((co, counter)):
                if way is not ZERO:
                    pair[k] = pair[k] + (way + machine.blur) * force
    return {name: (co, counter) for name, (co, counter) in sums.items()}


def harmonic(order: int, ratio: float) -> Tuple[float, float]:
    """What cos(order phi) has in the acceleration of a piston over r omega^2, of crank radius over rod length up to 1.

    With k = sqrt(1 - ratio^2) and q = (1 - k) / (1 + k) the rod adds sqrt(1 - ratio^2 sin^2 phi) =
    (1 + k) / 2 |1 + q e^{2j phi}|, whose Fourier coefficients are q^m times hypergeometric series in q^2; order = 2 m.
    Returns that, and what the rounding of the series and its end may be off by.
    """
    m = order // 2
    root = sqrt(max((1 - ratio) * (1 + ratio), 0.0))
    over_ratio = ratio / (1 + root) ** 2
    power_of, term, series, n = ratio * over_ratio, 1.0, 0.0, 0
    for k in range(m):
        term *= (0.5 - k) / (k + 1)
    least = 1e-18 * abs(term)
    while abs(term) > least and n < 20_000:
        series += term
        term *= (n + m - 0.5) * (n - 0.5) / ((n + m + 1.0) * (n + 1.0)) * power_of**2
        n += 1
    factor = order**2 * (1 + root) * over_ratio * power_of ** (m - 1)
    # beyond its first terms one falls as 1 / n^3 at least
    return factor * series, factor * (SERIES * abs(series) + n * abs(term))


def orders(claim: str, place: Place, by_order: Iterable[Tuple[int, Optional[Responses]]]) -> Claims:
    """Phasors of force and moment by order."""
    by_order, entries = list(by_order), list(place)
    yield claim, place, ONE if len(entries) == len(by_order) else -ONE, ONE
    for (order, responses), entry in zip(by_order, entries):
        if responses is None or not entry:
            yield claim, entry, -ONE if (responses is None) != (entry.value is None) else ONE, ONE
            continue
        yield same(claim, entry / "order", order)
        for name, unit in NAMES.items():
            pair = responses[name]
            yield near(claim, entry / name / f"peak_{unit}", abs(pair[0]) + abs(pair[1]))
            for sense, phasor in zip(("co_rotating", "counter_rotating"), pair):
                yield from _phasor(claim, entry / name / sense, unit, phasor)


def _phasor(claim: str, place: Place, unit: str, phasor: Number) -> Claims:
    along, across = phasor.parts()
    yield near(claim, place / f"real_{unit}", along, abs(phasor))
    yield near(claim, place / f"imag_{unit}", across, abs(phasor))
    yield near(claim, place / f"magnitude_{unit}", abs(phasor))
    phase = (place / "phase_deg").double()
    way = direction(phase) + BLUR
    off = abs(phasor - way * abs(phasor)) - real(NOTHING)
    yield claim, place / "phase_deg", -off if -180 <= phase <= 180 else -ONE, abs(phasor)


def floor(machine: Machine, design: Place, place: Place) -> Claims:
    """The phasors that turn against the shaft, but where a balance shaft does."""
    backwards = [shaft for shaft in design / "balance_shafts" if (shaft / "speed_ratio").double() == -1]
    planes = [(web / "position_m").number() for shaft in backwards for web in shaft / "webs"]
    arms = any(abs(plane - machine.plane).low > 0 for plane in planes)
    has_planes = {"force": bool(planes), "moment": arms}
    for name, unit in NAMES.items():
        figure = ZERO if has_planes[name] else abs(machine.before[name][1])
        yield near("floor", place / f"{name}_{unit}", figure)
