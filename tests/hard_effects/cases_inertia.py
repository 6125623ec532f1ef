"""First-order phasors, orders 2, 4 and 6, peaks and couples of machines whose rows cancel.

A force is measured against the sum of what the rows would do alone. A couple is measured against the same with the arms
from the middle of the machine, plus the force that is left times the way to the reference plane. Reference: forces of
the rows over the turn at 50 digits, and harmonics from elliptic integrals and their recurrence (the mechanics have
hypergeometric functions).
"""

from collections.abc import Iterator
from functools import cache
from typing import Any

import numpy as np

from optimizer.mechanics.inertia import reciprocating, rotating
from optimizer.mechanics.layout import layout
from optimizer.mechanics.slider_crank import acceleration_harmonic
from schemas.machine.reciprocating import ReciprocatingMachine
from tests.hard_effects.case import ALGEBRAIC, EPS, Case, Finding, error
from tests.hard_effects.exact import Number, Row, cis, mp, rows
from tests.hard_effects.machines import Hard

ORDERS = (1, 2, 4, 6)


@cache
def harmonic(order: int, radius: Number, length: Number) -> Number:
    """A_k of the force m r w^2 A_k cos k phi, k = 1 or even.

    sqrt(1 - m sin^2 phi) = sum c_n cos 2 n phi, m = (r/l)^2: c_0 and c_1 from complete elliptic integrals, the others
    from (1 - m sin^2) f' = -m sin cos f. A_2n = 4 n^2 c_n l / r.
    """
    if order == 1:
        return mp.mpf(1)
    if mp.isinf(length):
        return mp.mpf(0)
    lost = int(12 * max(mp.log10(length / radius), 0)) + 20
    with mp.workdps(60 + lost):  # the coefficients are small differences
        ratio = radius / length
        m = ratio**2
        whole, first = mp.ellipe(m), mp.ellipk(m)
        c = [2 / mp.pi * whole, 4 / mp.pi * (whole - 2 * ((2 * m - 1) * whole + (1 - m) * first) / (3 * m))]
        c.append((m * c[0] / 2 - (2 - m) * c[1]) / (m + m / 4))
        c.append((-4 * (1 - m / 2) * c[2] - m / 4 * c[1]) / (mp.mpf(7) / 4 * m))
        n = order // 2
        return 4 * n**2 * c[n] / ratio


def _machine(
    *throws: tuple[float, float, float, list[tuple[float, float, float | None]]], **rest: Any
) -> dict[str, Any]:
    """Throws as plane, crank angle, radius, rows; rows as axis, mass, rod length."""
    cranks = [
        {
            "position_m": z,
            "crank_angle_deg": crank,
            "crank_radius_m": radius,
            "rotating_mass_kg": 3.0,
            "rows": [
                {"axis_deg": axis, "reciprocating_mass_kg": mass, "connecting_rod": {"length_m": length}}
                for axis, mass, length in of
            ],
        }
        for z, crank, radius, of in throws
    ]
    return {"kind": "reciprocating", "speed_rpm": 600.0, "throws": cranks, **rest}


def _inline(cranks: list[float], plane: float, masses: list[float] | None = None, z: float = 0.0) -> dict[str, Any]:
    masses = masses or [5.0] * len(cranks)
    throws = [(z + 0.3 * k, d, 0.1, [(90.0, masses[k], 0.4)]) for k, d in enumerate(cranks)]
    return _machine(*throws, reference_plane_m=plane)


def _many() -> dict[str, Any]:
    rng = np.random.default_rng(5)
    size = 10.0 ** rng.uniform(-9, 6, 200)
    throws = [
        (float(rng.uniform(-3, 3)), float(rng.uniform(0, 360)), 0.1, [(float(rng.uniform(0, 360)), float(m), 0.3)])
        for m in size
    ]
    return _machine(*throws)


def _off_its_throw() -> dict[str, Any]:
    body = _machine((1e6, 10.0, 0.1, [(0.0, 5.0, 0.4), (0.0, 5.0, 0.4)]), (1e6 + 1.0, 190.0, 0.1, [(0.0, 10.0, 0.4)]))
    for row, offset in zip(body["throws"][0]["rows"], (-0.1, 0.1), strict=True):
        row["offset_m"] = offset
    return body


MACHINES = (
    Hard(
        "four cranks, plane 1e6 m away",
        "force is exactly 0 by symmetry; its rounding times 1e6 m must not appear",
        _inline([0, 180, 180, 0], 1e6),
    ),
    Hard(
        "three cranks, plane 1e9 m away",
        "cosines of 120 degrees must add up to 0; a free couple is left",
        _inline([0, 120, 240], -1e9),
    ),
    Hard(
        "five cranks at 72 degrees, plane 1e6 m away",
        "irrational directions add up to 0 in rounding only",
        _inline([0, 144, 288, 72, 216], 1e6),
    ),
    Hard("masses 1 and 1 + 1e-12", "force is 1e-12 of its terms, and real", _inline([0, 180], 0.1, [1.0, 1.0 + 1e-12])),
    Hard("masses of 1e-9 and 1e6 kg", "fifteen decades in one sum", _inline([0, 95, 240], 0.2, [1e-9, 1e6, 1.0])),
    Hard(
        "star of seven",
        "orders 1, 2, 4 and 6 of a star cancel to one sense of rotation",
        _machine((0.0, 33.0, 0.1, [(360.0 * k / 7, 4.0, 0.35) for k in range(7)])),
    ),
    Hard(
        "V of 90 degrees with opposed axes, clockwise",
        "one phasor of each order is exactly 0",
        _machine((0.0, 77.0, 0.1, [(45.0, 4.0, 0.3), (135.0, 4.0, 0.3)]), rotation="cw"),
    ),
    Hard(
        "rods 1.0000001 r",
        "harmonics at the end of their series, slope infinite in the rod ratio",
        _machine((0.0, 10.0, 0.1, [(0.0, 4.0, 0.10000001), (61.0, 4.0, 0.10000001)])),
    ),
    Hard(
        "rods from 1e9 m to infinite",
        "A_6 is (r/l)^5: 1e-60 beside 0",
        _machine((0.0, 10.0, 1e-3, [(0.0, 4.0, 1e9), (60.0, 4.0, None)])),
    ),
    Hard(
        "radii of 1e-6 and 10 m",
        "seven decades of lengths",
        _machine((0.0, 10.0, 1e-6, [(0.0, 4.0, 3e-6)]), (0.5, 200.0, 10.0, [(0.0, 4.0, 55.0)])),
    ),
    Hard(
        "angles of 1e6 degrees",
        "reduction to a turn must be exact",
        _machine((0.0, 999999.9, 0.1, [(-999873.25, 4.0, 0.3), (1e-9, 4.0, 0.3)])),
    ),
    Hard("200 throws, fifteen decades of masses", "long sums of unlike terms", _many()),
    Hard(
        "machine at 1e6 m",
        "arms are differences of places; offsets of rows have 1e-10 m at such a place",
        _off_its_throw(),
    ),
)


def _phasors(lines: list[Row], order: int, weight: list[Number]) -> tuple[Number, Number]:
    """Both phasors of sum w m r A_k cos(k phi) along the axes, from the sum at two angles."""

    def at(theta: Number) -> Number:
        return sum(
            w
            * row.mass
            * row.radius
            * harmonic(order, row.radius, row.length)
            * row.axis
            * mp.cos(order * (theta + row.ahead))
            for w, row in zip(weight, lines, strict=True)
        )

    first, second = at(mp.mpf(0)), at(mp.pi / (2 * order)) / (mp.j * lines[0].sense)
    return (first + second) / 2, (first - second) / 2


def _measure(hard: Hard) -> Iterator[Finding]:
    plan = layout(ReciprocatingMachine.model_validate(hard.body))
    lines, throws = rows(hard.body), hard.body["throws"]
    planes = [mp.mpf(t["position_m"]) for t in throws]
    centre = (min(planes) + max(planes)) / 2
    reference_plane_m = hard.body.get("reference_plane_m")
    plane = centre if reference_plane_m is None else mp.mpf(reference_plane_m)
    # one unit in the last place of where the machine stands
    place = max(abs(z) for z in planes) * EPS / ALGEBRAIC

    def couple_size(alone: list[Number], arms: list[Number], force: Number) -> Number:
        noise = EPS * sum(alone)
        left = sum(alone) * abs(centre - plane) if force > noise else 0
        return sum(a * (abs(z) + place) for a, z in zip(alone, arms, strict=True)) + left

    for order in ORDERS:
        got = reciprocating(plan, order)
        alone = [row.mass * row.radius * abs(harmonic(order, row.radius, row.length)) for row in lines]
        co, counter = _phasors(lines, order, [mp.mpf(1)] * len(lines))
        force = abs(co) + abs(counter)
        size = sum(alone)
        smallest = abs(abs(co) - abs(counter))

        def finding(quantity: str, got: Any, value: Any, size: Number, order: int = order) -> Finding:
            return Finding(f"order {order}, {quantity}", error(got, value, size), ALGEBRAIC)

        yield finding("force", [got.force.co, got.force.counter], [co, counter], size)
        yield finding("peak force", got.force.peak, force, size)
        yield finding("smallest force", got.force.minor, smallest, size)
        for name, along in (("x", 1 + 0j), ("y", 1j)):
            peak = abs(co + mp.mpmathify(along) ** 2 * mp.conj(counter))
            yield finding(f"peak along {name}", got.force.peak_along(np.asarray(along)), peak, size)
        arms = [row.plane - centre for row in lines]
        both = _phasors(lines, order, [row.plane - plane for row in lines])
        size = couple_size(alone, arms, force)
        yield finding("couple", [got.moment.co, got.moment.counter], list(both), size)
        yield finding("peak couple", got.moment.peak, sum(map(abs, both)), size)
    turned = rotating(plan)
    masses = [
        (mp.mpf(t["rotating_mass_kg"]), mp.mpf(t["crank_radius_m"]), cis(t["crank_angle_deg"]), mp.mpf(t["position_m"]))
        for t in throws
    ]
    alone = [m * r for m, r, _, _ in masses]
    force = sum(m * r * d for m, r, d, _ in masses)
    yield Finding("rotating force", error(turned.force.co, force, sum(alone)), ALGEBRAIC)
    couple = sum(m * r * d * (z - plane) for m, r, d, z in masses)
    size = couple_size(alone, [z - centre for *_, z in masses], abs(force))
    yield Finding("rotating couple", error(turned.moment.co, couple, size), ALGEBRAIC)


def _rods() -> Iterator[Finding]:
    for length in (1.0000001, 1.001, 1.1, 2.0, 5.0, 1e3, 1e9, 1e20):
        ratio = 1.0 / length
        for order in ORDERS:
            actual_harmonic = harmonic(order, mp.mpf(ratio), mp.mpf(1))
            # relative to the coefficient itself, however small
            yield Finding(
                f"A_{order}", error(acceleration_harmonic(order, np.asarray(ratio)), actual_harmonic), ALGEBRAIC
            )


CASES = (
    *(Case("inertia", hard.name, hard.why, lambda hard=hard: _measure(hard)) for hard in MACHINES),
    Case("inertia", "harmonics for rods from 1.0000001 r to 1e20 r", "A_6 runs over 100 decades", _rods),
)
