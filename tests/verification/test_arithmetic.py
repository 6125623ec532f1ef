"""The checker's numbers, units, directions and plates, and its gas, against other code: enclosed, and closely."""

import math
from fractions import Fraction
from itertools import pairwise, product
from typing import Any

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.mechanics.bearings import bending_moment, continuous_beam_influence, simple_spans_influence
from optimizer.mechanics.envelope import AnnularSector, Segment
from optimizer.mechanics.gas import Chambers, gas_forces, switching_angles
from optimizer.mechanics.kinematics import motion
from optimizer.mechanics.layout import layout
from optimizer.mechanics.slider_crank import acceleration_harmonic
from tests.builders import machine, row, throw
from tests.verification.test_curves import part

#: whole multiples of so much
_UNIT = Fraction(1, 2**1120)

_ENDS = st.integers(-(2**40), 2**40)


@st.composite
def rectangles(draw: st.DrawFn, real: bool = False) -> Any:
    x = sorted(draw(st.tuples(_ENDS, _ENDS)))
    y = (0, 0) if real else tuple(sorted(draw(st.tuples(_ENDS, _ENDS))))
    scale = 1 << draw(st.sampled_from([1080, 1120]))
    return part("numbers").Number(x[0] * scale, x[1] * scale, (y[0] * scale, y[1] * scale))


def ends(number: Any) -> tuple[Fraction, Fraction]:
    return number.low * _UNIT, number.high * _UNIT


def sides(number: Any) -> tuple[Fraction, Fraction]:
    return number.y[0] * _UNIT, number.y[1] * _UNIT


def near(pair: tuple[Fraction, Fraction], numbers: list[Fraction]) -> bool:
    """Whether an interval is that of these, but for its own rounding."""
    return min(numbers) - 4 * _UNIT <= pair[0] <= min(numbers) and max(numbers) <= pair[1] <= max(numbers) + 4 * _UNIT


@given(rectangles(), rectangles())
def test_sums_and_differences_are_exact(first: Any, second: Any) -> None:
    """Independent: fractions."""
    assert ends(first + second) == tuple(a + b for a, b in zip(ends(first), ends(second), strict=True))
    assert sides(first + second) == tuple(a + b for a, b in zip(sides(first), sides(second), strict=True))
    assert ends(first - second) == (ends(first)[0] - ends(second)[1], ends(first)[1] - ends(second)[0])
    assert sides(first - second) == (sides(first)[0] - sides(second)[1], sides(first)[1] - sides(second)[0])
    assert ends(-first) == tuple(-a for a in ends(first)[::-1])
    assert sides(first.conjugate()) == tuple(-a for a in sides(first)[::-1])
    assert ends(first.conjugate()) == ends(first)


@given(rectangles(), rectangles())
def test_products_are_those_of_all_corners(first: Any, second: Any) -> None:
    """Independent: fractions, every corner with every other."""
    actual_second = first * second
    xx = [a * b for a, b in product(ends(first), ends(second))]
    yy = [a * b for a, b in product(sides(first), sides(second))]
    xy = [a * b for a, b in product(ends(first), sides(second))]
    yx = [a * b for a, b in product(sides(first), ends(second))]
    assert near(ends(actual_second), [min(xx) - max(yy), max(xx) - min(yy)])
    assert near(sides(actual_second), [min(xy) + min(yx), max(xy) + max(yx)])
    along = first.along(second)
    assert near(ends(along), [min(xx) + min(yy), max(xx) + max(yy)])
    assert along.y == (0, 0)


@given(rectangles(), st.floats(0, 360), st.floats(1e-9, 90))
def test_what_a_sector_takes_off_is_enclosed(pull: Any, centre: float, half: float) -> None:
    """Independent: doubles, of every corner in its own direction where that is in the sector, and at both edges."""
    low, high = map(float, ends(part("worth").support(pull, (centre, half))))
    for x, y in product(ends(pull), sides(pull)):
        length, angle = math.hypot(x, y), math.degrees(math.atan2(y, x))
        beside = abs((angle - centre + 180) % 360 - 180)
        taken = length if beside <= half else max(0.0, length * math.cos(math.radians(beside - half)))
        assert low - 1e-12 * length <= taken <= high + 1e-12 * length


@given(rectangles(real=True), rectangles(real=True))
def test_real_products_and_quotients(first: Any, second: Any) -> None:
    corners = [a * b for a, b in product(ends(first), ends(second))]
    actual_second = first * second
    assert near(ends(actual_second), corners)
    assert actual_second.y == (0, 0)
    if second.low > 0:
        quotients = [a / b for a, b in product(ends(first), ends(second))]
        low, high = ends(first / second)
        # a quotient is a product with a reciprocal that is rounded
        slack = 8 * _UNIT * (1 + max(map(abs, ends(first))))
        assert min(quotients) - slack <= low <= min(quotients)
        assert max(quotients) <= high <= max(quotients) + slack


@given(rectangles())
def test_the_length_of_a_rectangle_is_that_of_its_nearest_and_farthest_corners(box: Any) -> None:
    (a, b), (c, d) = ends(box), sides(box)
    nearest = [Fraction(0) if low <= 0 <= high else min(abs(low), abs(high)) for low, high in ((a, b), (c, d))]
    farthest = [max(abs(low), abs(high)) for low, high in ((a, b), (c, d))]
    low, high = ends(abs(box))
    square = [sum(number * number for number in some) for some in (nearest, farthest)]
    assert low * low <= square[0] < (low + 2 * _UNIT) ** 2 or square[0] == 0 == low
    assert high * high >= square[1]
    assert high == 0 or (high - 2 * _UNIT) ** 2 <= square[1]


@given(rectangles())
def test_parts_and_middles(subject: Any) -> None:
    along, across = subject.parts()
    assert (ends(along), along.y) == (ends(subject), (0, 0))
    assert (ends(across), across.y) == (sides(subject), (0, 0))
    middle = subject.middle()
    assert middle.real == pytest.approx(float(sum(ends(subject)) / 2), rel=1e-15, abs=1e-300)
    assert middle.imag == pytest.approx(float(sum(sides(subject)) / 2), rel=1e-15, abs=1e-300)
    assert float(along) == pytest.approx(float(ends(subject)[1]), rel=1e-15, abs=1e-300)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_doubles_are_exact(double: float) -> None:
    assert ends(part("numbers").real(double)) == (Fraction(double), Fraction(double))


def test_fractions_are_enclosed_and_what_is_not_finite_is_no_number() -> None:
    numbers = part("numbers")
    for number in (Fraction(1, 3), Fraction(-2, 7)):
        low, high = ends(numbers.real(number))
        assert low < number < high
        assert high - low == _UNIT
    for number in (math.nan, math.inf, -math.inf):
        with pytest.raises(OverflowError):
            numbers.real(number)
    assert float(numbers.Number(0, 1 << 2200)) == 1.7976931348623157e308
    assert float(numbers.Number(0, -1 << 2200)) == -1.7976931348623157e308
    least = numbers.largest(numbers.Number(1, 9), numbers.Number(2, 3))
    assert (least.low, least.high) == (2, 9)
    assert ends(numbers.total([numbers.ONE, numbers.HALF, numbers.ZERO])) == (Fraction(3, 2), Fraction(3, 2))
    assert sides(numbers.J) == (1, 1)
    assert ends(numbers.J) == (0, 0)
    assert [ends(numbers.ABOUT_ONE), ends(numbers.BLUR), sides(numbers.BLUR)] == [
        (1 - Fraction(1, 2**48), 1 + Fraction(1, 2**48)), *2 * [(-Fraction(1, 2**48), Fraction(1, 2**48))],
    ]  # fmt: skip


@pytest.mark.parametrize("degrees", [0.0, 90.0, 180.0, 270.0, 360.0, -90.0, 1e6 * 90.0])
def test_quarter_turns_are_exact(degrees: float) -> None:
    direction = part("numbers").direction(degrees)
    x, y = ((1, 0), (0, 1), (-1, 0), (0, -1))[round(degrees / 90) % 4]
    assert (ends(direction), sides(direction)) == ((x, x), (y, y))


@given(st.floats(-1e6, 1e6))
def test_directions_are_enclosed_by_less_than_their_digits(degrees: float) -> None:
    """Independent: sine and cosine at 400 bits."""
    direction = part("numbers").direction(degrees)
    with mpmath.workprec(400):
        angle = mpmath.radians(mpmath.mpf(degrees))
        for (low, high), exact in ((ends(direction), mpmath.cos(angle)), (sides(direction), mpmath.sin(angle))):
            assert mpmath.mpf(low.numerator) / low.denominator <= exact
            assert exact <= mpmath.mpf(high.numerator) / high.denominator
            assert high - low <= Fraction(1, 2**212)


@pytest.mark.parametrize(
    ("name", "text", "value"),
    [
        ("position_m", "25 mm", 0.025), ("position_m", "2.5cm", 0.025), ("position_m", "1 in", 0.0254),
        ("position_m", "1 ft", 0.3048), ("position_m", "-3e-1 m", -0.3), ("mass_kg", "250 g", 0.25),
        ("mass_kg", "1.5 t", 1500.0), ("mass_kg", "2 lb", 0.90718474), ("angle_deg", "1 rad", 57.29577951308232),
        ("speed_rpm", "10 Hz", 600.0), ("speed_rpm", "1 rad/s", 9.549296585513721), ("force_N", "1 kN", 1000.0),
        ("force_N", "1 lbf", 4.4482216152605), ("pressure_Pa", "1 kPa", 1e3), ("pressure_Pa", "1 MPa", 1e6),
        ("pressure_Pa", "1 bar", 1e5), ("pressure_Pa", "1 psi", 6894.757293168361), ("moment_Nm", "1 N mm", 1e-3),
        ("moment_Nm", "1 lbf ft", 1.3558179483314004), ("moment_Nm", " 2  N  m ", 2.0),
    ],
)  # fmt: skip
def test_quantities_of_a_request_have_their_units(name: str, text: str, value: float) -> None:
    """Published: the definitions of the units."""
    place = part("numbers").Place(text, "request", name)
    assert place.double() == pytest.approx(value, rel=1e-15)
    # of a list by the name of the list; not in an answer, and not in another unit
    assert part("numbers").Place(text, "request", name, 3).double() == place.double()
    for path in (("answer", name), ("request", "count")):
        with pytest.raises(part("numbers").Unreadable):
            part("numbers").Place(text, *path).double()


@pytest.mark.parametrize("text", ["", "1", "m", "1 mm 2", "0x1 m", "1e9999 m", "1 " + "m" * 48, "nan m", "1,5 m"])
def test_what_is_no_quantity_is_unreadable(text: str) -> None:
    with pytest.raises(part("numbers").Unreadable) as refused:
        part("numbers").Place(text, "request", "position_m").double()
    assert refused.value.path == ("request", "position_m")


@pytest.mark.parametrize(
    ("number", "least", "fits"),
    [
        (3.0, 3.0, True),
        (2.0, 3.0, False),
        (True, 0.0, False),
        (None, 0.0, False),
        ([], 0.0, False),
        (10**400, 0.0, False),
    ],
)
def test_numbers_are_finite_and_not_below_their_least(number: Any, least: float, fits: bool) -> None:
    place = part("numbers").Place(number, "request", "mass_kg")
    if fits:
        assert place.double(least=least) == number
    else:
        with pytest.raises(part("numbers").Unreadable):
            place.double(least=least)
    assert part("numbers").Place(None, "request", "mass_kg").double(5.0) == 5.0


def test_pointers_are_escaped_and_end() -> None:
    pointer = part("numbers").pointer
    assert pointer(("a/b", 3, "~")) == "/a~1b/3/~0"
    assert len(pointer(("x" * 500,))) == 200


@pytest.mark.parametrize("continuous", [False, True])
def test_the_moment_in_a_shaft_is_that_of_the_service(continuous: bool) -> None:
    rng = np.random.default_rng(1)
    places, loads, planes = np.sort(rng.uniform(-1, 1, 4)), rng.uniform(-1.5, 1.5, 5), rng.uniform(-1.5, 1.5, 6)
    influence = (continuous_beam_influence if continuous else simple_spans_influence)(places, loads)
    expected = bending_moment(places, influence + 0j, loads, np.eye(5) + 0j, planes).real
    spans = part("spans").Spans([Fraction(place) for place in places], continuous)
    bendings = [[float(spans.bending(Fraction(plane), Fraction(load))) for load in loads] for plane in planes]
    np.testing.assert_allclose(bendings, expected, atol=1e-12)
    assert spans.extent == Fraction(places[-1]) - Fraction(places[0])


@pytest.mark.parametrize("ratio", [0.0, 1e-9, 0.2, 0.5, 0.9, 0.999, 1.0])
@pytest.mark.parametrize("order", [2, 4, 6, 12])
def test_harmonics_of_a_piston_are_those_of_the_service(order: int, ratio: float) -> None:
    """Independent: the closed form of the mechanics; what it may be off by is next to nothing."""
    share, off = part("orders").harmonic(order, ratio)
    exact = float(acceleration_harmonic(order, np.asarray(ratio)))
    assert abs(share - exact) <= off + 1e-13 * abs(exact)
    assert off <= (2e-12 if ratio < 0.95 else 2e-3) * abs(share)


_SHAPES = (("sector", AnnularSector), ("segment", Segment))


@pytest.mark.parametrize(("shape", "kind"), _SHAPES)
@pytest.mark.parametrize("inner", [0.0, 0.06, 0.2])
def test_plates_have_the_figures_of_the_service(inner: float, shape: str, kind: Any) -> None:
    plates = part("plates")
    body = {"shape": shape, "inner_radius_m": inner, "outer_radius_m": 0.25, "thickness_m": 0.04,
            "density_kg_m3": 7000.0, "max_half_angle_deg": 80.0}  # fmt: skip
    plate = plates.plate(part("numbers").Place(body, "request", "envelope"))
    point = kind(inner, 0.25, 280.0, np.deg2rad(80.0))
    assert plate.most == pytest.approx(float(point.most))
    for angle in (1e-3, 0.03, 0.3, 1.0, plate.most):
        for name in ("mass", "unbalance", "inertia", "lever"):
            assert getattr(plate, name)(angle) == pytest.approx(float(getattr(point, name)(angle)), rel=1e-11), name
        assert plates.opened(plate, plate.unbalance(angle)) == pytest.approx(angle, rel=1e-9)
        assert plate.up_to(plate.mass(angle)) == pytest.approx(angle, rel=1e-9)
    assert plate.up_to(1e9) == plate.most
    # independent: the best of many openings
    openings = np.linspace(0.0, plate.most, 100_001)
    mass, unbalance = point.mass(openings), point.unbalance(openings)
    for price, cost in ((0.0, 1.0), (3.0, 1.0), (8.0, 1.0), (100.0, 1.0), (5.0, 0.0)):
        for limit in (0.3 * float(mass[-1]), 1e9):
            best = np.max(np.where(mass <= limit, price * unbalance - cost * mass, 0.0), initial=0.0)
            low, high = plate.worth(price, cost, limit)
            assert low <= high
            assert best <= high + 1e-12
            assert best == pytest.approx(low, rel=2e-4, abs=1e-5 * float(mass[-1]))
            assert high - low <= 1e-10 * (1.0 + high + price + float(mass[-1]))
    # steel, a right angle and no hub where nothing is said
    bare = {"shape": shape, "outer_radius_m": 0.25, "thickness_m": 0.04}
    plain = plates.plate(part("numbers").Place(bare, "request", "envelope"))
    assert (plain.inner, plain.areal, plain.most) == (0.0, pytest.approx(0.04 * 7850.0), math.pi / 2)


@pytest.mark.parametrize("side", ["head", "crank"])
def test_a_chamber_has_the_pressures_and_breaks_of_the_service(side: str) -> None:
    """Independent: the gas forces of the mechanics."""
    radius, length, clearance = 0.14, 0.7, 0.12
    plan = layout(machine(throw(0.0, row(0.0, length_m=length), radius_m=radius)))
    ones = np.ones((1, 2))
    chambers = Chambers(0.3 * ones, 1e5 * ones, 4e5 * ones, clearance * ones, 1.2 * ones, 1.35 * ones, ones > 0)
    gas, k = part("gas"), ("head", "crank").index(side)
    cycle = gas.Cycle(side == "head", 0.3, 1e5, 4e5, clearance * 2 * radius, 2 * radius, 1.2, 1.35)
    assert cycle.most == 4e5
    angles = np.linspace(0.01, 6.27, 90)
    moving = motion(plan, angles)
    expected = gas_forces(chambers, moving, plan)
    for n, angle in enumerate(angles):
        piston = gas.motion(radius / length, float(angle))
        assert piston.travel * radius == pytest.approx(float(moving.displacement[0, n]), rel=1e-9)
        assert piston.rest * radius == pytest.approx(float(moving.remaining[0, n]), rel=1e-9)
        assert piston.turning == pytest.approx(float(moving.tangential_factor[0, n]), abs=1e-12)
        assert piston.radial == pytest.approx(float(moving.radial_factor[0, n]), abs=1e-12)
        assert piston.outward * radius * float(plan.omega) ** 2 == pytest.approx(
            float(moving.acceleration[0, n]), rel=1e-9
        )
        pressure = cycle.at(piston, bool(angle < np.pi))
        assert pressure == pytest.approx(float(expected.pressure[0, k, n]), rel=1e-11)
        assert gas.force(cycle, pressure) == pytest.approx(float(expected.force[0, k, n]), rel=1e-11)
    opens, closes = (float(switching_angle[0, k]) for switching_angle in switching_angles(chambers, plan))
    assert cycle.breaks(radius / length) == pytest.approx((opens, closes), rel=1e-11)


@pytest.mark.parametrize("side", ["head", "crank"])
def test_slopes_of_a_pressure_are_not_exceeded(side: str) -> None:
    """Independent: differences of the pressure over the travel, between two breaks."""
    gas, ratio = part("gas"), 0.2
    cycle = gas.Cycle(side == "head", 0.3, 1e5, 4e5, 0.03, 0.28, 1.2, 1.35)
    edges = sorted([0.0, math.pi, 2 * math.pi, *cycle.breaks(ratio)])
    flat = 0
    for start, end in pairwise(edges):
        to_shaft = 0.5 * (start + end) < math.pi
        first, last = (gas.motion(ratio, at) for at in (start + 1e-9, end - 1e-9))
        slopes = cycle.slopes(first, last, to_shaft)
        flat += slopes == gas.FLAT
        inside = [gas.motion(ratio, start + (end - start) * n / 200) for n in range(1, 200)]
        travel = [0.5 * 0.28 * (piston.travel if cycle.head else piston.rest) for piston in inside]
        pressure = [cycle.at(volume, to_shaft) for volume in inside]
        first_order = [
            abs((q - p) / (y - x)) for p, q, x, y in zip(pressure, pressure[1:], travel, travel[1:], strict=False)
        ]
        assert max(first_order) <= slopes.first * (1.0 + 1e-9) + 1e-3
        if slopes != gas.FLAT:
            assert max(first_order) >= 0.8 * slopes.first
            near_end = pressure[0] if travel[0] < travel[-1] else pressure[-1]
            clear = 0.03 + min(travel)
            exponent = 1.2 if cycle.head == to_shaft else 1.35
            assert slopes.second == pytest.approx(exponent * (exponent + 1) * near_end / clear**2, rel=0.1)
        assert slopes.by_angle == 0.0
    # suction and discharge are steady
    assert flat == 2


@pytest.mark.parametrize("turns", [1, 2])
def test_an_indicated_pressure_is_linear_between_its_entries(turns: int) -> None:
    gas, body = part("gas"), {"angle_deg": [10.0, 100.0, 250.0], "pressure_Pa": [1e5, 5e5, 2e5]}
    cycle = 2 * math.pi * turns
    table = gas._table(part("numbers").Place(body, "request", "head"), True, 0.2, turns, 0.3)
    angles = np.deg2rad([10.0, 100.0, 250.0])
    for own in np.linspace(-7.0, 14.0, 60):
        expected = np.interp(
            (own - 0.3) % cycle, [angles[2] - cycle, *angles, angles[0] + cycle], [2e5, 1e5, 5e5, 2e5, 1e5]
        )
        assert table.at(gas.motion(0.2, float(own)), True) == pytest.approx(expected, rel=1e-12)
    assert table.breaks(0.2) == pytest.approx([angle + 0.3 for angle in angles])
    assert table.most == 5e5
    first, last = (gas.motion(0.2, 0.3 + float(angles[0]) + step) for step in (0.1, 0.4))
    assert table.slopes(first, last, True) == (0.0, 0.0, pytest.approx(4e5 / (angles[1] - angles[0])))
    steady = gas.Table(False, 0.2, [0.0], [3e5])
    assert (steady.at(first, True), steady.slopes(first, last, True)) == (3e5, gas.FLAT)
    for wrong in ({**body, "angle_deg": [10.0, 5.0, 250.0]}, {"angle_deg": [1.0, 2.0], "pressure_Pa": [1.0, 2.0]}):
        with pytest.raises(part("numbers").NotCovered):
            gas._table(part("numbers").Place(wrong, "request", "head"), True, 0.2, turns, 0.3)


@pytest.mark.parametrize("count", [1, 2, 5, 8])
def test_quadratures_are_those_of_gauss_and_legendre(count: int) -> None:
    """Independent: numpy."""
    gauss = sorted(part("gas").gauss(count))
    nodes, weights = np.polynomial.legendre.leggauss(count)
    np.testing.assert_allclose([node for node, _ in gauss], 0.5 * (nodes + 1.0), atol=1e-14)
    np.testing.assert_allclose([weight for _, weight in gauss], 0.5 * weights, atol=1e-14)
