"""Four-process cycles: continuity, switching angles, work, open sides."""

from dataclasses import replace
from itertools import pairwise

import mpmath
import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from optimizer.mechanics.gas import Chambers, gas_forces, indicated_work, switching_angles, switching_travels
from optimizer.mechanics.kinematics import Motion, motion
from optimizer.mechanics.layout import Layout, layout
from tests.analyze.driven import STYLES, arrays, random_driven
from tests.builders import machine, row, stack, throw

SIDES = ("head", "crank")


def at_own_angle(plan: Layout, phi: float, k: int) -> Motion:
    """Motion with row k at its own angle phi."""
    ahead = motion(plan, np.zeros(1)).crank_angle[k, 0]
    return motion(plan, np.array([phi - ahead]))


def pressure(plan: Layout, data: Chambers, k: int, side: int, phi: float) -> float:
    return float(gas_forces(data, at_own_angle(plan, phi, k), plan).pressure[k, side, 0])


def single_row(rod_ratio: float = 0.25, radius: float = 0.1, rotation: str = "ccw") -> Layout:
    crank = throw(0.0, row(0.0, length_m=radius / rod_ratio), radius_m=radius)
    return layout(machine(crank, rotation=rotation))


def single_cylinder(closed: tuple[bool, bool] = (True, True), **rest: tuple[float, float]) -> Chambers:
    """Chambers of one row, head and crank side."""
    data = {
        "area": (0.05, 0.045),
        "suction": (1e5, 1e5),
        "discharge": (3e5, 3e5),
        "clearance": (0.1, 0.12),
        "expansion_exponent": (1.2, 1.25),
        "compression_exponent": (1.35, 1.3),
        **rest,
    }
    return Chambers(**{name: np.array([pair]) for name, pair in data.items()}, closed=np.array([closed]))


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("seed", range(3))
def test_switching_angles_are_where_the_laws_meet(seed: int, style: str) -> None:
    plan, data = arrays(random_driven(seed, style))
    suction, discharge = switching_angles(data, plan)
    rows = plan.reciprocating
    for k, side in np.ndindex(data.closed.shape):
        if not data.closed[k, side]:
            assert np.isnan([suction[k, side], discharge[k, side]]).all()
            continue
        radius, stroke = rows.crank_radius[k], 2.0 * rows.crank_radius[k]
        length, clear = radius / rows.rod_ratio[k], data.clearance[k, side] * stroke

        def volume(phi: float, radius=radius, length=length, stroke=stroke, side=side, clear=clear) -> float:
            moved = radius + length - radius * np.cos(phi) - np.sqrt(length**2 - (radius * np.sin(phi)) ** 2)
            return (moved if side == 0 else stroke - moved) + clear

        low, high = data.suction[k, side], data.discharge[k, side]
        opens = clear * (high / low) ** (1.0 / data.expansion_exponent[k, side])
        closes = (stroke + clear) * (low / high) ** (1.0 / data.compression_exponent[k, side])
        growing, shrinking = ((0.0, np.pi), (np.pi, 2.0 * np.pi))[:: 1 if side == 0 else -1]
        # independent: root finding on p V^n
        root = brentq(lambda phi, v=volume, o=opens: v(phi) - o, *growing, xtol=1e-14)
        assert suction[k, side] == pytest.approx(root, abs=1e-10)
        actual_root = brentq(lambda phi, v=volume, c=closes: v(phi) - c, *shrinking, xtol=1e-14)
        assert discharge[k, side] == pytest.approx(actual_root, abs=1e-10)


@pytest.mark.parametrize("style", STYLES)
def test_pressure_is_continuous_and_stays_between_suction_and_discharge(style: str) -> None:
    plan, data = arrays(random_driven(7, style))
    suction, discharge = switching_angles(data, plan)
    gas = gas_forces(data, motion(plan, np.linspace(0.0, 2.0 * np.pi, 2000)), plan)
    assert np.all(gas.pressure >= data.suction[..., None] * (1 - 1e-15))
    assert np.all(gas.pressure <= data.discharge[..., None] * (1 + 1e-15))
    for k, side in np.ndindex(data.closed.shape):
        for phi in (suction[k, side], discharge[k, side], 0.0, np.pi):
            if np.isnan(phi):
                continue
            before, at, after = (pressure(plan, data, k, side, phi + d) for d in (-1e-7, 0.0, 1e-7))
            assert before == pytest.approx(at, rel=1e-5)
            assert after == pytest.approx(at, rel=1e-5)
        if data.closed[k, side]:
            # analytic: at the switching angles the valves' pressures, at the dead centres the cycle's corners
            assert pressure(plan, data, k, side, suction[k, side]) == pytest.approx(data.suction[k, side], rel=1e-9)
            assert pressure(plan, data, k, side, discharge[k, side]) == pytest.approx(data.discharge[k, side], rel=1e-9)
            small, large = (0.0, np.pi)[:: 1 if side == 0 else -1]
            assert pressure(plan, data, k, side, small) == pytest.approx(data.discharge[k, side], rel=1e-9)
            assert pressure(plan, data, k, side, large) == pytest.approx(data.suction[k, side], rel=1e-9)


def _work_by_quadrature(plan: Layout, data: Chambers, k: int, side: int) -> float:
    """-integral of p dV over a turn, split where p has kinks."""
    corners = [
        0.0,
        np.pi,
        2.0 * np.pi,
        switching_angles(data, plan)[0][k, side],
        switching_angles(data, plan)[1][k, side],
    ]
    omega, area = float(plan.omega), data.area[k, side]
    outward = 1.0 if side == 0 else -1.0

    def power(phi: float) -> float:
        moving = at_own_angle(plan, phi, k)
        grows = outward * area * moving.velocity[k, 0] / omega
        return -float(gas_forces(data, moving, plan).pressure[k, side, 0]) * grows

    ends = sorted(c for c in corners if not np.isnan(c))
    return sum(quad(power, a, b, epsabs=0.0, epsrel=1e-10)[0] for a, b in pairwise(ends))


@pytest.mark.parametrize("seed", range(2))
def test_indicated_work_is_the_area_of_the_diagram(seed: int) -> None:
    plan, data = arrays(random_driven(seed, "v", throws=1))
    for k, side in np.ndindex(data.closed.shape):
        # independent
        by_quadrature = _work_by_quadrature(plan, data, k, side)
        scale = data.discharge[k, side] * data.area[k, side] * plan.reciprocating.crank_radius[k]
        assert indicated_work(data, plan)[k, side] == pytest.approx(by_quadrature, rel=1e-8, abs=1e-9 * scale)


def test_work_of_equal_exponents() -> None:
    # analytic: n/(n-1) p_s (V_1 - V_4) ((p_d/p_s)^((n-1)/n) - 1) where both exponents are n
    n, ratio, stroke = 1.3, 3.0, 0.2
    data = single_cylinder(expansion_exponent=(n, n), compression_exponent=(n, n))
    drawn_in = stroke * (1.0 + data.clearance[0] - data.clearance[0] * ratio ** (1.0 / n))
    expected = n / (n - 1.0) * 1e5 * data.area[0] * drawn_in * (ratio ** ((n - 1.0) / n) - 1.0)
    np.testing.assert_allclose(indicated_work(data, single_row())[0], expected, rtol=1e-13)


def test_exponents_near_one_are_isothermal() -> None:
    plan, ratio, stroke = single_row(), 3.0, 0.2
    chambers = single_cylinder(expansion_exponent=(1.0, 1.0), compression_exponent=(1.0, 1.0))
    # analytic: p_s (V_1 - V_4) ln(p_d / p_s), with V_4 = ratio V_0
    expected = 1e5 * chambers.area[0] * stroke * (1.0 + chambers.clearance[0] * (1.0 - ratio)) * np.log(ratio)
    np.testing.assert_allclose(indicated_work(chambers, plan)[0], expected, rtol=1e-13)
    for off in (1e-15, 1e-13, 1e-10, 1e-7, 1e-4):
        near = np.full((1, 2), 1.0 + off)
        work = indicated_work(replace(chambers, expansion_exponent=near, compression_exponent=near), plan)
        with mpmath.workdps(50):
            n = mpmath.mpf(1.0 + off)
            gain = n / (n - 1) * (mpmath.mpf(ratio) ** ((n - 1) / n) - 1)
            refilled = mpmath.mpf(ratio) ** (1 / n) - 1
            full = [
                float(1e5 * a * stroke * (1 - c * refilled) * gain)
                for a, c in zip(chambers.area[0], chambers.clearance[0], strict=True)
            ]
        np.testing.assert_allclose(work[0], full, rtol=1e-13)  # independent: in 50 digits


@pytest.mark.parametrize("open_side", [0, 1])
def test_an_open_side_has_ambient_pressure_and_does_no_work(open_side: int) -> None:
    closed = (open_side == 1, open_side == 0)
    ambient = [(1e5, 1e5), (1e5, 1e5)]
    plan, both = single_row(), single_cylinder()
    values = {name: getattr(both, name).copy() for name in ("suction", "discharge")}
    for pair in values.values():
        pair[0, open_side] = ambient[open_side][0]
    data = replace(both, **values, closed=np.array([closed]))
    gas = gas_forces(data, motion(plan, np.linspace(0.0, 6.0, 50)), plan)
    sign = -1.0 if open_side == 0 else 1.0
    np.testing.assert_array_equal(gas.pressure[0, open_side], 1e5)
    np.testing.assert_allclose(gas.force[0, open_side], sign * 1e5 * data.area[0, open_side], rtol=1e-15)
    assert indicated_work(data, plan)[0, open_side] == 0.0
    # the other side does not notice
    whole = gas_forces(both, motion(plan, np.linspace(0.0, 6.0, 50)), plan)
    np.testing.assert_array_equal(gas.pressure[0, 1 - open_side], whole.pressure[0, 1 - open_side])
    assert indicated_work(data, plan)[0, 1 - open_side] == indicated_work(both, plan)[0, 1 - open_side]


def test_a_side_may_be_open_to_a_vacuum() -> None:
    data = single_cylinder((True, False), suction=(1e5, 0.0), discharge=(3e5, 0.0))
    plan = single_row()
    np.testing.assert_array_equal(gas_forces(data, motion(plan, np.array([0.3, 4.0])), plan).force[0, 1], 0.0)
    assert indicated_work(data, plan)[0, 1] == 0.0
    assert np.isnan(switching_angles(data, plan)[0][0, 1])


def test_no_pressure_ratio_no_work() -> None:
    data, plan = single_cylinder(discharge=(1e5, 1e5)), single_row()
    np.testing.assert_array_equal(indicated_work(data, plan), 0.0)
    np.testing.assert_array_equal(gas_forces(data, motion(plan, np.linspace(0, 6, 30)), plan).pressure, 1e5)


def test_too_much_clearance_never_delivers() -> None:
    data, plan = single_cylinder(clearance=(1.0, 0.1)), single_row()
    never = [np.isnan(values[0]).tolist() for values in (*switching_travels(data, plan), indicated_work(data, plan))]
    # analytic: re-expansion fills 3^(1/1.2) - 1 = 1.50 strokes
    assert never == [[True, False]] * 3


@pytest.mark.parametrize("travel", [1e-4, 1e-7])
def test_a_chamber_that_delivers_at_the_very_end_delivers(travel: float) -> None:
    """Analytic: what is compressed to so much travel has the discharge pressure there."""
    plan, (clear, exponent) = single_row(), (0.02, 1.35)
    taken = (0.2 - travel) / (0.2 + clear)
    ratio = (1.0 - taken) ** -exponent
    chambers = single_cylinder(
        discharge=(1e5 * ratio, 3e5), clearance=(clear / 0.2, 0.12), expansion_exponent=(9.0, 1.25)
    )
    _, discharge = switching_travels(chambers, plan)
    assert discharge[0, 0] == pytest.approx(travel, rel=1e-6)


def test_sense_of_rotation_and_crank_side_are_mirror_images() -> None:
    phi = np.linspace(0.0, 2.0 * np.pi, 60, endpoint=False)
    alike = single_cylinder(
        area=(0.05, 0.05), clearance=(0.1, 0.1), expansion_exponent=(1.2, 1.2), compression_exponent=(1.3, 1.3)
    )
    # analytic: with an almost infinite rod the crank side half a turn later is the head side with the other sign
    plan = single_row(1e-9)
    head, crank = (
        gas_forces(alike, motion(plan, phi), plan).force[0],
        gas_forces(alike, motion(plan, phi + np.pi), plan).force[0],
    )
    np.testing.assert_allclose(crank[1], -head[0], rtol=1e-6)
    # own angles: the sense of rotation is of no account
    arrangement = single_row(1e-9, rotation="cw")
    np.testing.assert_allclose(gas_forces(alike, motion(arrangement, phi), arrangement).force[0], head, rtol=1e-12)


def test_a_batch_is_the_loop() -> None:
    columns = [arrays(random_driven(seed, "v", throws=2)) for seed in range(3)]
    plan, data = stack([arrangement for arrangement, _ in columns]), stack([cylinders for _, cylinders in columns])
    angle = np.linspace(0.0, 7.0, 40)
    moving = motion(plan, np.broadcast_to(angle, (3, 40)))
    batch = gas_forces(data, moving, plan)
    for k, (column_layout, chambers) in enumerate(columns):
        alone = gas_forces(chambers, motion(column_layout, angle), column_layout)
        np.testing.assert_allclose(batch.pressure[k], alone.pressure, rtol=1e-13)
        np.testing.assert_allclose(batch.total[k], alone.total, rtol=1e-11)
        np.testing.assert_allclose(indicated_work(data, plan)[k], indicated_work(chambers, column_layout), rtol=1e-13)
        for got, expected in zip(switching_angles(data, plan), switching_angles(chambers, column_layout), strict=True):
            np.testing.assert_allclose(got[k], expected, rtol=1e-13)


@pytest.mark.parametrize("rise", [1e-13, 1e-9, 1e-5, 0.1, 2.0])
@pytest.mark.parametrize("exponent", [1.0 + 2.3e-16, 1.3, 10.0])
def test_work_of_pressures_that_hardly_differ(exponent: float, rise: float) -> None:
    plan, low = single_row(), 1e5
    high = low * (1.0 + rise)
    same = {"discharge": (high, high), "expansion_exponent": (exponent,) * 2, "compression_exponent": (exponent,) * 2}
    data = single_cylinder(**same)
    actual = indicated_work(data, plan)[0]
    with mpmath.workdps(50):
        n, ratio = mpmath.mpf(exponent), mpmath.mpf(high) / mpmath.mpf(low)
        for side, (area, clearance) in enumerate(((0.05, 0.1), (0.045, 0.12))):
            full, clear = 0.2 * (1 + mpmath.mpf(clearance)), 0.2 * mpmath.mpf(clearance)
            drawn = full - clear * ratio ** (1 / n)
            # analytic: equal exponents, volume drawn in times p_s n/(n-1) (ratio^((n-1)/n) - 1)
            expected = area * low * drawn * n / (n - 1) * (ratio ** ((n - 1) / n) - 1)
            assert float(actual[side]) == pytest.approx(float(expected), rel=1e-12)
