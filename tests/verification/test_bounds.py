"""Limits, prices, counts and gaps in the checker: right at what they allow, and just beyond it."""

import cmath
import math
from types import SimpleNamespace as Fields
from typing import Any

import pytest

from tests.verification.test_curves import part
from tests.verification.test_figures import held, place, real


def fits(room: Any) -> bool:
    return bool(room.high >= 0)


_CASTINGS = [(0, 30.0, False), (1, 100.0, False), (2, 250.0, True)]


@pytest.mark.parametrize(
    ("angles", "right"),
    [
        ((50.0, 120.0, 230.0), True),
        ((350.0, 60.0, 290.0), True),
        ((50.0, 120.0 + 9e-13, 230.0), True),
        ((50.0, 120.0 + 2e-12, 230.0), False),
        ((50.0, 120.0 - 2e-12, 230.0), False),
        ((50.0, 80.0, 230.0), False),
        ((50.0, 120.0, 270.0), False),
    ],
)
def test_identical_castings_are_alike_from_their_cranks(angles: tuple[float, ...], right: bool) -> None:
    """Analytic: 20 degrees ahead of cranks at 30 and 100 degrees, and behind one at 250."""
    webs = [Fields(name=name) for name in "abc"]
    machine = Fields(groups=[_CASTINGS], webs=webs)
    entries = {name: place({"mass_kg": 2.0, "angle_deg": angle}) for name, angle in zip("abc", angles, strict=True)}
    assert held(part("weights")._alike(machine, entries)) == right
    heavier = entries | {"c": place({"mass_kg": 2.0 + 1e-12, "angle_deg": angles[2]})}
    assert not held(part("weights")._alike(machine, heavier))
    nothing = {name: place({"mass_kg": 0.0, "angle_deg": 0.0}) for name in "abc"}
    assert held(part("weights")._alike(machine, nothing))


@pytest.mark.parametrize(("names", "right"), [(["a"], True), (["a", "b"], True), (["a", "n", "b"], True), ([], False),
                                               (["b"], False), (["a", "c"], False), (["a", "a"], False),
                                               (["a", "z"], False)])  # fmt: skip
def test_limits_that_are_touched_are_listed_once(names: list[str], right: bool) -> None:
    """Analytic: a ten thousandth is left at most; within 1e-9 of that they may be listed or not."""
    rooms = {"a": 1e-4 - 1.01e-9, "b": 1e-4 + 0.99e-9, "c": 1e-4 + 1.01e-9, "n": math.nan}
    assert held(part("weights").active_limits("x", place(names), rooms)) == right
    assert held(part("weights").active_limits("x", place([]), {"b": 1e-4 - 0.99e-9}))


_CRANK = Fields(throw=1, degrees=300.0)


@pytest.mark.parametrize(
    ("angle", "printed", "right"),
    [
        (20.0, 80.0, True), (300.0, 0.0, True), (299.0, 359.0, True), (300.0, 360.0, False), (299.0, -1.0, False),
        (20.0, 280.0, False), (20.0, 80.0 + 5e-12, True), (20.0, 80.0 - 5e-12, True), (20.0, 80.0 + 8e-12, False),
        (20.0, 80.0 - 8e-12, False), (20.0, None, False),
    ],
)  # fmt: skip
def test_the_angle_from_a_crank(angle: float, printed: float | None, right: bool) -> None:
    """Analytic: 80 degrees from 300 to 20; off by 1e-14 of 660 degrees at most."""
    weight = {"throw": 1, "mass_kg": 2.0, "angle_deg": angle, "angle_from_crank_deg": printed}
    assert held(part("weights")._crank(_CRANK, place(weight))) == right
    assert not held(part("weights")._crank(_CRANK, place(weight | {"throw": 0, "angle_from_crank_deg": 80.0})))
    assert not held(part("weights")._crank(None, place(weight)))
    assert not held(part("weights")._crank(None, place(weight | {"throw": None, "angle_from_crank_deg": 80.0})))
    assert held(part("weights")._crank(None, place({"mass_kg": 2.0})))
    empty = place({"throw": 1, "mass_kg": 0.0, "angle_deg": 0.0, "angle_from_crank_deg": printed})
    assert held(part("weights")._crank(_CRANK, empty)) == (printed is None)


@pytest.mark.parametrize(
    ("masses", "pieces", "sizes"),
    [
        ([3.0, 1.0, 2.0], 3, 3), ([2.0, 2.0, 2.0], 3, 1), ([0.0, 2.0, 0.0], 1, 1), ([0.0, 0.0, 0.0], 0, 0),
        ([2.0, 2.0 * (1 + 0.99e-9), 5.0], 3, 2), ([2.0 * (1 + 1.01e-9), 2.0, 5.0], 3, 3), ([1e-3, 2e-3, 1e-3], 3, 2),
    ],
)  # fmt: skip
def test_castings_are_counted_by_their_masses(masses: list[float], pieces: int, sizes: int) -> None:
    """Analytic: of one size are masses that differ by up to 1e-9 of themselves; what is fixed is not counted."""
    webs = [{"name": str(k)} for k in range(3)] + [{"name": "there", "fixed": {"mass_kg": 9.0}}]
    answer = place({"counterweights": [{"mass_kg": mass} for mass in [*masses, 9.0]]})
    machine = place({"webs": webs, "catalogue": {"masses_kg": [1.0]}}, "request")
    costs = part("alternatives").costs(machine, answer, real(7.0))
    assert {name: float(cost) for name, cost in costs.items()} == {"mass": 7.0, "pieces": pieces, "sizes": sizes}
    assert part("levels")._sizes(sorted(mass for mass in masses if mass > 0)) == sizes


@pytest.mark.parametrize(("first", "second", "room"), [(0.3, 0.5, 0.3), (0.5, 0.3, 0.3), (-0.5, 0.3, -0.5),
                                                        (math.nan, 0.5, None), (0.5, math.nan, None),
                                                        (math.nan, 1e-5, 1e-5), (math.nan, 1e-4, None),
                                                        (math.nan, math.nan, None)])  # fmt: skip
def test_the_tighter_of_two_rooms(first: float, second: float, room: float | None) -> None:
    tighter = part("ceilings")._tighter(first, second)
    assert math.isnan(tighter) if room is None else tighter == room


def _priced(**more: Any) -> Any:
    fields = {"limit": "max_mass", "web": "a", "price": 6.0, "size": 3.0, "unit": "kg", "touched": True}
    return part("prices").Priced(**(fields | more))


@pytest.mark.parametrize(
    ("price", "right"),
    [
        # 6 over a weight of 4, off by 1e-6 of itself and by what rounding leaves
        (1.5 * (1 + 0.99e-6), True), (1.5 * (1 - 0.99e-6), True), (1.5 * (1 + 1.01e-6), False),
        (1.5 * (1 - 1.01e-6), False), (6.0, False), (24.0, False), (0.0, False),
    ],
)  # fmt: skip
def test_a_price_is_by_what_is_weighed_first(price: float, right: bool) -> None:
    position = place([{"limit": "max_mass", "web": "a", "value": price, "unit": "N/kg"}])
    assert held(part("prices").price_entries(position, [_priced()], 4.0, "N", 1e-9, 1e-9, 0.0)) == right


@pytest.mark.parametrize(("gap", "right"), [(17.99, True), (17.97, False)])
def test_a_whole_limit_that_is_worth_less_than_the_gap_has_no_price(gap: float, right: bool) -> None:
    """Analytic: 3 kg at 6 N/kg are 18 N, and a thousandth of the gap more counts as less."""
    position = place([{"limit": "max_mass", "web": "a", "value": 0.0, "unit": "N/kg"}])
    assert held(part("prices").price_entries(position, [_priced()], 4.0, "N", gap, 1e-9, 0.0)) == right


@pytest.mark.parametrize(("off", "dust", "rest", "right"), [
    # a dust of 4e-3 over the weight, or 1e-9 of the rest over weight and size; and 1e-6 of the price besides
    (1.001e-3, 4e-3, 1e-9, True), (1.002e-3, 4e-3, 1e-9, False), (1.001e-3, 0.0, 1.2e7, True),
    (1.002e-3, 0.0, 1.2e7, False),
])  # fmt: skip
def test_what_rounding_leaves_of_a_price(off: float, dust: float, rest: float, right: bool) -> None:
    for sign in (1, -1):
        position = place([{"limit": "max_mass", "web": "a", "value": 1.5 + sign * off, "unit": "N/kg"}])
        assert held(part("prices").price_entries(position, [_priced()], 4.0, "N", 1e-9, rest, dust)) == right


@pytest.mark.parametrize(("price", "touched", "edge", "must"), [
    (1.1e-3, False, False, True), (0.9e-3, False, False, False), (0.9e-3, True, False, True),
    (1.1e-3, False, True, False), (1.1e-3, True, True, True),
])  # fmt: skip
def test_a_limit_that_is_worth_something_is_listed(price: float, touched: bool, edge: bool, must: bool) -> None:
    """Analytic: a whole limit of 3 kg that is worth more than 1e-6 of 3000 N."""
    stated = [_priced(price=price, touched=touched, edge=edge)]
    assert held(part("prices").price_entries(place([]), stated, 1.0, "N", 1.0, 3000.0, 0.0)) != must
    # what is listed twice, or is no limit
    first = {"limit": "max_mass", "web": "a", "value": price, "unit": "N/kg"}
    assert not held(part("prices").price_entries(place([first, first]), stated, 1.0, "N", 1.0, 3000.0, 0.0))
    second = first | {"web": "b"}
    assert not held(part("prices").price_entries(place([first, second]), stated, 1.0, "N", 1.0, 3000.0, 0.0))
    assert not held(part("prices").price_entries(place([first | {"unit": "N"}]), stated, 1.0, "N", 1.0, 3e3, 0.0))


@pytest.mark.parametrize(("values", "value", "right"), [
    ({"values": [2.0, "5 kg", None]}, 2.0, True), ({"values": [2.0, "5 kg", None]}, 5.0 + 4.9e-9, True),
    ({"values": [2.0, "5 kg", None]}, 5.0 + 5.1e-9, False), ({"values": [2.0, "5 kg"]}, 3.0, False),
    ({"start": 5.0, "stop": "2 kg"}, 2.0 - 4.9e-9, True), ({"start": 5.0, "stop": "2 kg"}, 2.0 - 5.1e-9, False),
    ({"start": 2.0, "stop": 5.0}, 5.0 + 4.9e-9, True), ({"start": 2.0, "stop": 5.0}, 5.0 + 5.1e-9, False),
    ({"start": 2.0, "stop": 5.0}, 3.0, True), ({"values": [2.0]}, None, False), ({"values": [2.0, None]}, None, None),
])  # fmt: skip
def test_a_value_of_an_axis_is_listed_or_between_its_ends(values: Any, value: Any, right: bool | None) -> None:
    path = "/machine/webs/0/max_mass_kg"
    room = part("sweep")._on_axis(place({"path": path, **values}, "request"), place({path: value}))[2]
    assert (None if room is None else fits(room)) == right


def _curve(points: list[tuple[float, float]], knee: int | None, **ends: float) -> Any:
    (x, high), (far, low) = points[0], points[-1]
    fields = {"smallest_force_N": x, "moment_at_smallest_force_Nm": high, "force_at_smallest_moment_N": far}
    peaks = [{"status": "optimal", "weighted_force_peak_N": f, "weighted_moment_peak_Nm": m} for f, m in points]
    body = {"points": peaks, "ends": fields | {"smallest_moment_Nm": low} | ends, "status": "optimal", "knee": knee}
    return held(part("front")._shape(place(body)))


def test_the_knee_is_farthest_below_the_line_between_the_ends() -> None:
    """Analytic: of (1, 9), (2, 4), (4, 2), (9, 1) both inner points are as far, of others the one below."""
    both = [(1.0, 9.0), (2.0, 4.0), (4.0, 2.0), (9.0, 1.0)]
    assert [_curve(both, k) for k in (None, 0, 1, 2, 3, 4)] == [False, False, True, True, False, False]
    lower = [(1.0, 9.0), (2.0, 4.0), (4.0, 1.9), (9.0, 1.0)]
    assert [_curve(lower, k) for k in (1, 2)] == [False, True]
    # nearer to the line than a ten thousandth there is none
    for depth, none in ((0.99e-4, True), (1.01e-4, False)):
        straight = [(1.0, 9.0), (5.0, 5.0 - 8.0 * depth), (9.0, 1.0)]
        assert _curve(straight, None) == none
        assert _curve(straight, 1)
    assert _curve([(1.0, 9.0), (9.0, 1.0)], None)
    assert not _curve([(1.0, 9.0), (9.0, 1.0)], 1)
    for name in ("smallest_force_N", "moment_at_smallest_force_Nm", "force_at_smallest_moment_N", "smallest_moment_Nm"):
        assert not _curve(both, 1, **{name: 5.0})
    # from the smallest force to the smallest moment, and no point twice
    assert not _curve([(1.0, 9.0), (4.0, 2.0), (2.0, 4.0), (9.0, 1.0)], 1)
    assert not _curve([(1.0, 9.0), (2.0, 4.0), (3.0, 4.0), (9.0, 1.0)], 1)
    assert _curve([(1.0, 9.0), (2.0, 4.0), (2.0, 3.0), (9.0, 1.0)], 2)


@pytest.mark.parametrize("ratio", [1, -1, 2, -2, 3])
@pytest.mark.parametrize("mirrored", [False, True])
def test_what_turns_with_a_balance_shaft(ratio: int, mirrored: bool) -> None:
    """Analytic: n^2 v e^{j (n - 1) t}, and about the crankshaft the real part of -j conj(p) n^2 v e^{jnt}."""
    numbers, t, p = part("numbers"), 0.7, 0.3 - 0.8j
    unit = numbers.direction(math.degrees(t))
    shaft = part("shafts").Geared(None, ratio, real(p.real) + numbers.J * real(p.imag), mirrored)
    assert shaft.on_shaft(unit).middle() == pytest.approx(ratio**2 * cmath.exp(1j * (ratio - 1) * t), rel=1e-13)
    around = -1j * p.conjugate() * ratio**2 * cmath.exp(1j * ratio * t)
    assert shaft.roll(unit).middle() == pytest.approx(around.conjugate() if mirrored else around, rel=1e-13)
    ways = numbers.direction(40.0), numbers.direction(100.0)
    mass = part("machine").Mass(real(2.0), *ways, real(0.0))
    way = cmath.rect(2.0, math.radians(40.0 if ratio > 0 else 100.0))
    assert shaft.vector(mass).middle() == pytest.approx(way.conjugate() if mirrored else way, rel=1e-13)
    first = shaft.first(real(3.0), real(5.0))
    assert float(first) == {1: 3.0, -1: 5.0}.get(ratio, 0.0)
    for times in (0, 1, 3, -1, -2):
        middle = part("shafts").power(unit, times).middle()
        assert middle == pytest.approx(cmath.exp(1j * times * t), rel=1e-13)


_STATE = {"suction_pressure_Pa": 1e5, "discharge_pressure_Pa": 4e5, "relative_clearance": 0.1,
          "expansion_exponent": 1.2, "compression_exponent": 1.3}  # fmt: skip
_BORE = {"bore_m": 0.2, "piston_rod_diameter_m": 0.05}


@pytest.mark.parametrize(("name", "value"), [("suction_pressure_Pa", 0.0), ("suction_pressure_Pa", 4.1e5),
                                              ("relative_clearance", 0.0), ("expansion_exponent", 1.0),
                                              ("compression_exponent", 1.0), ("expansion_exponent", 0.5)])  # fmt: skip
def test_a_cycle_that_is_none_is_not_covered(name: str, value: float) -> None:
    gas = part("gas")
    state = _STATE | _BORE | {"crank": {"relative_clearance": 0.2, "suction_pressure_Pa": 4e5}}
    row = place({"cylinder": state}, "request")
    head, crank = gas.chambers(row, 0.3, 0.0)
    assert head == gas.Cycle(True, pytest.approx(math.pi * 0.01), 1e5, 4e5, pytest.approx(0.03), 0.3, 1.2, 1.3)
    assert (crank.head, crank.low, crank.high, crank.clear) == (False, 4e5, 4e5, pytest.approx(0.06))
    assert crank.area == pytest.approx(math.pi / 4 * (0.04 - 0.0025), rel=1e-14)
    with pytest.raises(part("numbers").NotCovered) as refused:
        list(gas.chambers(place({"cylinder": state | {name: value, "crank": {}}}, "request"), 0.3, 0.0))
    assert refused.value.args[0].path == ("request", "cylinder")


@pytest.mark.parametrize(("acting", "acts"), [("double", (True, True)), ("head", (True, False)),
                                               ("crank", (False, True))])  # fmt: skip
def test_the_side_that_does_not_act_has_the_pressure_around_it(acting: str, acts: tuple[bool, bool]) -> None:
    gas, cylinder = part("gas"), _STATE | _BORE | {"acting": acting, "ambient_pressure_Pa": 9e4}
    for side, chamber, acting_too in zip((True, False), gas.chambers(place({"cylinder": cylinder}), 0.3, 0.0), acts,
                                       strict=True):  # fmt: skip
        assert isinstance(chamber, gas.Cycle if acting_too else gas.Table)
        assert chamber.head == side
        if not acting_too:
            assert (chamber.angles, chamber.pressures) == ([0.0], [9e4])
    areas = {"head_area_m2": 0.03, "crank_area_m2": 0.0}
    bare = {name: value for name, value in cylinder.items() if name not in _BORE}
    head, crank = gas.chambers(place({"cylinders": [bare | areas]}), 0.3, 0.0)
    assert (head.area, crank.area) == (0.03, 0.0)
    assert isinstance(crank, gas.Table)
    assert crank.pressures == ([0.0])


def _gaps(objective: float, lowest: float, gap: float, share: float, size: float, status: str, **more: Any) -> bool:
    proof = {"objective": objective, "lower_bound": lowest, "gap": gap, "relative_gap": share, "yardstick": size,
             "objective_without_counterweights": more.pop("rest", size)}  # fmt: skip
    request = place({"machine": {}, "accuracy": {"relative_gap": 0.01}}, "request")
    return held(part("answer").gaps(request, place({"certificate": proof | more, "status": status}), real(5.0)))


def test_gaps_are_differences_and_small_where_an_answer_is_optimal() -> None:
    """Analytic: 100 over 99.5 is 0.5, of 50 a hundredth, which is what was asked for."""
    assert _gaps(100.0, 99.5, 0.5, 0.01, 50.0, "optimal")
    assert not _gaps(100.0, 99.4, 0.6, 0.012, 50.0, "optimal")
    assert _gaps(100.0, 99.4, 0.6, 0.012, 50.0, "inaccurate")
    # rounding of both is allowed, 4e-15 of 199.5
    assert _gaps(100.0, 99.5, 0.5 + 6e-13, 0.01, 50.0, "inaccurate")
    assert not _gaps(100.0, 99.5, 0.5 + 8e-13, 0.01, 50.0, "inaccurate")
    assert _gaps(100.0, 99.5, 0.5 - 6e-13, 0.01, 50.0, "inaccurate")
    assert not _gaps(100.0, 99.5, 0.5 - 8e-13, 0.01, 50.0, "inaccurate")
    assert _gaps(100.0, 99.5 - 6e-13, 0.5, 0.01, 50.0, "optimal")
    assert not _gaps(100.0, 99.5 - 8e-13, 0.5 + 8e-13, 0.01, 50.0, "optimal")
    assert not _gaps(100.0, 99.5, 0.5, 0.0101, 50.0, "optimal")
    assert not _gaps(100.0, 99.5, 0.5, 0.01, 50.0, "optimal", rest=50.1)
    assert _gaps(1e-3, 1e-3, 0.0, 0.0, 0.0, "inaccurate")


def test_gaps_of_the_mass_are_up_to_a_ten_thousandth() -> None:
    """Analytic: 5 kg over a minimum, as a share of 4 kg."""
    of = (100.0, 99.5, 0.5, 0.01, 50.0)
    for share, right in ((0.99e-4, True), (1.01e-4, False)):
        least = 5.0 - 4.0 * share
        mass = {"mass_lower_bound_kg": least, "mass_yardstick_kg": 4.0, "mass_relative_gap": (5.0 - least) / 4.0}
        assert _gaps(*of, "optimal", **mass) == right
        assert _gaps(*of, "inaccurate", **mass)
        assert not _gaps(*of, "inaccurate", **(mass | {"mass_relative_gap": share * 1.001}))
    exact = {"mass_lower_bound_kg": 4.9996, "mass_yardstick_kg": 4.0, "mass_relative_gap": 1e-4 + 4e-15}
    assert _gaps(*of, "optimal", **exact)


@pytest.mark.parametrize(("price", "expected"), [(4.0, 2.0), (1.0, 1.0), (2.5, 2.0), (9.0, 8.0)])
def test_a_budget_is_worth_what_is_left_out_next(price: float, expected: float) -> None:
    """Analytic: gains of 8, 2 and -1 on 3, 4 and 5 kg with a budget of 5: the next kilogram is worth 2."""
    gains = [(real(8.0), real(3.0)), (real(2.0), real(4.0)), (real(-1.0), real(5.0))]
    actual = part("worth").worth_of_budget(real(price), gains, real(5.0))
    assert float(actual) == expected


_INTERVALS = ((-3, 0), (0, 5), (-3, 5), (1, 4), (-4, -1), (0, 0), (-2, -2), (7, 7))


@pytest.mark.parametrize("first", _INTERVALS)
@pytest.mark.parametrize("second", _INTERVALS)
def test_a_product_of_intervals_that_end_at_0(first: tuple[int, int], second: tuple[int, int]) -> None:
    """Independent: the products of all ends."""
    every = [a * b for a in first for b in second]
    assert part("numbers")._product(first, second) == (min(every), max(every))
    low, high = first
    least = 0 if low <= 0 <= high else min(abs(low), abs(high))
    assert part("numbers")._distance(low, high) == (least, max(abs(low), abs(high)))
