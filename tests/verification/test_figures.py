"""How wide a figure may be off, both ways, at both ends and beside them: claims of the checker one by one."""

import json
import math
from types import SimpleNamespace as Fields
from typing import Any

import pytest

from tests.verification.test_curves import part

#: of a tolerance: inside, and beyond
_INSIDE, _BEYOND = 0.999, 1.001


def place(value: Any, *path: str | int) -> Any:
    return part("numbers").Place(value, *(path or ("answer",)))


def real(value: float) -> Any:
    return part("numbers").real(value)


def held(claims: Any) -> bool:
    """Whether nothing is broken."""
    return all(room is None or room.high >= 0 for _, _, room, _ in claims)


@pytest.mark.parametrize("figure", [-3.0, 0.5, 7.0])
def test_a_figure_lies_in_its_range(figure: float) -> None:
    """Analytic: what is left is its distance to the nearer end, and nothing below 1e-230 is told."""
    near, number = part("claims").near, part("numbers").Number
    around = number(real(figure - 0.25).low, real(figure + 0.5).high)
    for value, room in ((figure, 0.25), (figure - 0.25, 0.0), (figure + 0.5, 0.0), (figure + 0.25, 0.25)):
        claim, where, left, size = near("a", place(value, "answer", "b"), around)
        assert (claim, where.path) == ("a", ("answer", "b"))
        assert float(left) == pytest.approx(room)
        assert left.high >= 0
        assert float(size) == max(abs(figure - 0.25), abs(figure + 0.5))
    # beyond an end its distance is what is missing
    for value in (figure - 0.25 - 1e-6, figure + 0.5 + 1e-6):
        assert near("a", place(value), around)[2].high < 0
    nothing = part("machine").NOTHING
    for off, fits in ((_INSIDE, True), (_BEYOND, False)):
        for sign in (1, -1):
            assert (near("a", place(sign * off * nothing), real(0.0))[2].high >= 0) == fits
    assert float(near("a", place(1.0), around, real(9.0))[3]) == 9.0
    assert near("a", place(None), around)[2] is None


@pytest.mark.parametrize(("value", "number", "alike"), [
    ("a", "a", True), ("a", "b", False), (None, None, True), (None, 0, False), (0, None, False), (2, 2.0, True),
    (True, True, True), ([2], 2, False), ({}, None, False), ([None], [None], False), (1.5, 1.4, False),
])  # fmt: skip
def test_a_text_or_a_count_is_the_same(value: Any, number: Any, alike: bool) -> None:
    room = part("claims").same("a", place(value), number)[2]
    assert float(room) == (1.0 if alike else -1.0)


def test_a_figure_is_between_two_others() -> None:
    """Analytic: the smaller of both distances and what it may be off by; its size with that."""
    within = part("bearings").within
    for value, room in ((2.0, 0.1), (3.0, 1.1), (5.0, 3.1), (7.0, 1.1), (8.0, 0.1), (8.2, -0.1), (1.8, -0.1)):
        claim, _, left, size = within("a", place(value), 2.0, 8.0, 0.1)
        assert claim == "a"
        assert float(left) == pytest.approx(room)
        assert float(size) == pytest.approx(8.1)
    assert float(within("a", place(-2.0), -9.0, 4.0, 0.5)[3]) == 9.5
    assert float(within("a", place(None), 2.0, 8.0, 0.1)[2]) == -1.0


@pytest.mark.parametrize(("ends", "right"), [([1.0, 2.0], True), ([2.0, 2.0], True), ([2.0, 1.0], False),
                                              ([1.0], False), ([1.0, 2.0, 3.0], False), ([], False)])  # fmt: skip
def test_a_bracket_rises(ends: list[float], right: bool) -> None:
    assert float(part("bearings").rising("a", place(ends))[2]) == (1.0 if right else -1.0)


@pytest.mark.parametrize("off", [0.0, 1e-3])
def test_a_peak_and_its_bracket_are_as_wide_as_they_say(off: float) -> None:
    """Analytic: 2e-9 below the peak, 2e-9 above it for the upper end of its bracket alone."""
    bearings, peak = part("bearings"), part("harmonics").Peak(100.0, 100.0 + 1e-9, 0.0)
    most = 100.0 + 1e-9
    low, high, far = 100.0 - 2e-7 - off, most + off, most * (1 + 2e-9) + off
    by = 1e-10

    def fits(value: float, first: float, last: float) -> bool:
        return held(bearings.magnitude("a", place({"p_N": value, "p_bracket_N": [first, last]}), "p", "N", peak, off))

    assert fits(low + by, low + by, 100.0 - off + by)
    assert fits(high - by, high - by, far - by)
    assert not fits(low - by, 100.0, 100.0)
    assert not fits(high + by, 100.0, 100.0)
    assert not fits(100.0, low - by, 100.0)
    assert not fits(100.0, 100.0, far + by)
    if off:
        assert not fits(100.0, high + by, far)
        assert not fits(100.0, low, 100.0 - off - by)
    assert not held(bearings.magnitude("a", place({"p_N": 100.0, "p_bracket_N": [100.0]}), "p", "N", peak, off))


@pytest.mark.parametrize("sign", [1, -1])
def test_a_largest_value_has_its_sign(sign: int) -> None:
    """Analytic: of the other sign all stands the other way round; none below the least."""
    dynamics, peak = part("dynamics"), part("harmonics").Peak(40.0, 50.0, 0.0)

    def fits(value: float, ends: list[float], least: float = -math.inf) -> bool:
        position = place({"p_N": sign * value, "p_bracket_N": [sign * end for end in ends[::sign]]})
        return held(dynamics.signed("a", position, "p", peak, 0.5, sign, least))

    wide = 40.0 * 2e-9 + 0.5
    assert fits(40.0 - wide + 1e-9, [40.0 - wide + 1e-9, 39.5 + 1e-9])
    assert fits(50.5, [50.5, 50.0 + wide])
    assert not fits(40.0 - wide - 1e-9, [45.0, 45.0])
    assert not fits(50.5 + 1e-9, [45.0, 45.0])
    assert not fits(45.0, [40.0 - wide - 1e-9, 45.0])
    assert not fits(45.0, [39.0, 39.5 - 1e-9])
    assert not fits(45.0, [45.0, 50.0 + wide + 1e-9])
    assert fits(60.0, [60.0, 60.0], 60.0)
    assert not fits(45.0, [45.0, 45.0], 60.0)
    actual_place = place({"p_N": 45.0 * sign, "p_bracket_N": [45.0 * sign] * 3})
    assert not held(dynamics.signed("a", actual_place, "p", peak, 0.5, sign))


@pytest.mark.parametrize(("step", "turns", "count"), [(90.0, 1, 4), (90.0, 2, 8), (90.0, 2, 4), (7.0, 1, 51)])
def test_samples_are_a_step_apart(step: float, turns: int, count: int) -> None:
    bearings, request = part("bearings"), place({"angles": {"step_deg": step}}, "request")
    angles = [step * n for n in range(count)]
    assert held(bearings.sampled("a", place(angles), request, turns))
    assert not held(bearings.sampled("a", place(angles[:-1]), request, turns))
    for k in (0, 1, count - 1):
        for sign in (1, -1):
            for share, fits in ((_INSIDE, True), (_BEYOND, False)):
                off = sign * share * 1e-9 * (k + 1) * step
                moved = [angle + off * (n == k) for n, angle in enumerate(angles)]
                assert held(bearings.sampled("a", place(moved), request, turns)) == fits
    assert held(bearings.sampled("a", place([float(n) for n in range(360)]), place({}, "request")))


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("turns", [1, 2])
def test_a_peak_is_at_its_angle(sense: int, turns: int) -> None:
    """Analytic: 3 + 2 e^{jt} is 5 long at 0, and shorter by 0.6 t^2 beside it; within the revolutions."""
    bearings, numbers = part("bearings"), part("numbers")
    curve = part("harmonics").Curve({0: 3 + 0j, 1: 2 * complex(math.cos(-1.0), math.sin(-1.0))})
    loads = Fields(turns=turns, turn=Fields(sense=numbers.ONE if sense > 0 else -numbers.ONE))
    there = math.degrees(1.0) if sense > 0 else 360.0 - math.degrees(1.0)
    peak = part("harmonics").Peak(5.0, 5.0, 0.0)
    exact = bearings.where("a", place(there), loads, curve, peak)[2]
    assert float(exact) == pytest.approx(5 * 2e-9 + 5e-11, rel=1e-4)
    # 0.6 t^2 is 1e-8 at 1.3e-4 rad
    far = math.degrees(math.sqrt(1.005e-8 / 0.6))
    for share, fits in ((0.99, True), (1.01, False)):
        for side in (1, -1):
            indices = bearings.where("a", place(there + side * share * far), loads, curve, peak)
            assert (indices[2].high >= 0) == fits
    again = bearings.where("a", place(there + 360.0), loads, curve, peak)[2]
    assert (again.high >= 0) == (turns == 2)
    assert bearings.where("a", place(there - 360.0), loads, curve, peak)[2].high < 0
    ahead = part("harmonics").Curve({0: 3 + 0j, 1: 2 + 0j})
    for end, fits in ((0.0, True), (360.0 * turns, True), (360.0 * (turns + 1), False), (-360.0, False)):
        assert (bearings.where("a", place(end), loads, ahead, peak)[2].high >= 0) == fits


def test_where_a_curve_changes_its_sign() -> None:
    """Analytic: the cube root of 2, rising and falling; where it does not, nowhere."""
    root = part("rods")._root
    for sign in (1.0, -1.0):
        assert root(lambda x, sign=sign: sign * (x**3 - 2.0), 1.0, 2.0) == pytest.approx(2.0 ** (1 / 3), abs=1e-14)
        assert root(lambda x, sign=sign: sign * (x**3 - 2.0), 1.3, 2.0) is None
    assert root(lambda x: x, 0.0, 1.0) is None
    assert root(lambda x: x - 1.0, 0.0, 1.0) is None


@pytest.mark.parametrize(("sign", "value"), [(0, -5.0), (1, 5.0), (-1, -5.0)])
def test_a_load_is_at_the_angle_that_is_told(sign: int, value: float) -> None:
    """Analytic: a height is the sign times a value, the larger of both sides; up to 1e9 of it below the peak."""
    rods, peak = part("rods"), part("harmonics").Peak(5.0, 6.0, 0.0)
    angles: list[float] = []

    def sides(angle: float) -> list[complex]:
        angles.append(angle)
        return [complex(value), complex(value / 2.0)]

    for sense in (1, -1):
        curve = Fields(pistons=Fields(period=4 * math.pi, sense=sense), sides=sides)
        indices = rods.where("a", place(90.0), curve, peak, 0.25, sign)
        assert angles.pop() == pytest.approx(sense * math.pi / 2)
        assert float(indices[2]) == pytest.approx(0.25 + 1e-8, rel=1e-12)
        assert float(indices[3]) == 6.25
        higher = rods.where("a", place(90.0), curve, part("harmonics").Peak(5.2, 6.0, 0.0), 0.25, sign)
        assert float(higher[2]) == pytest.approx(0.05, rel=1e-6)
        for degrees, fits in ((0.0, True), (720.0, True), (720.1, False), (-0.1, False)):
            assert (rods.where("a", place(degrees), curve, peak, 0.25, sign)[2].high >= 0) == fits


def test_the_largest_room_is_told_as_a_share() -> None:
    """Analytic: of sizes that doubles hold, and of those that they do not."""
    share, number = part("claims")._share, part("numbers").Number
    assert share(real(-3.0), real(4.0)) == -0.75
    assert share(real(1e80), real(1e-90)) == 1e100
    assert share(real(-1e80), real(1e-90)) == -1e100
    assert share(real(2e-150), real(1e-150)) == pytest.approx(2.0)
    assert share(real(2e150), real(1e150)) == pytest.approx(2.0)
    assert share(real(-0.5), number(-1, 0)) == -0.5
    assert share(real(1.0), number(real(3.0).low, real(4.0).high)) == 0.25


def _judged(*claims: tuple[str, Any, Any, Any]) -> dict[str, Any]:
    verdict: dict[str, Any] = part("claims").judged(iter(claims), place({"a": 1.0, "b": {"c": 2.0, "d": "text"}}))
    return verdict


def test_the_worst_of_a_kind_is_shown() -> None:
    a, c, d = (place(1.0, "answer", *path) for path in (("a",), ("b", "c"), ("b", "d")))
    real_part = real(1.0)
    verdict = _judged(("x", a, real(2.0), real_part), ("x", c, real(0.5), real_part), ("x", d, real(0.7), real_part))
    assert (verdict["verdict"], verdict["leaves"], verdict["checked"], verdict["not_covered"]) == ("held", 3, 3, [])
    assert verdict["claims"] == [{"claim": "x", "verdict": "held", "margin": 0.5, "where": "/answer/b/c"}]
    judgement = _judged(("x", a, None, real_part), ("x", c, real(0.5), real_part), ("y", d, real(0.0), real_part))
    assert [statement["verdict"] for statement in judgement["claims"]] == ["not covered", "held"]
    assert (judgement["verdict"], judgement["checked"], judgement["not_covered"]) == ("not covered", 2, ["/answer/a"])
    finding = _judged(("x", a, real(-1e-9), real_part), ("x", c, None, real_part), ("x", d, real(-1e-8), real_part))
    assert [(statement["verdict"], statement["margin"], statement["where"]) for statement in finding["claims"]] == [
        ("broken", -1e-8, "/answer/b/d")
    ]
    assert finding["verdict"] == "broken"
    # all held, but not all looked at
    assert _judged(("x", a, real(1.0), real_part))["not_covered"] == ["/answer/b"]
    assert _judged(("x", a, real(1.0), real_part), ("x", c, real_part, real_part))["not_covered"] == ["/answer/b/d"]
    evidence = part("claims").EVIDENCE
    claim = _judged(("x", a, real_part, real_part), (evidence, place({}, "answer", "b"), None, real_part))
    assert (claim["verdict"], claim["leaves"], claim["checked"]) == ("held", 1, 1)
    nothing = ("x", place(None, "answer", "z"), None, real_part)
    assert [statement["claim"] for statement in _judged(nothing, ("y", a, real_part, real_part))["claims"]] == ["y"]
    outside = ("x", place(None, "request", "z"), None, real_part)
    assert [statement["claim"] for statement in _judged(outside, ("y", a, real_part, real_part))["claims"]] == [
        "x",
        "y",
    ]


@pytest.mark.parametrize("error", [ZeroDivisionError, OverflowError, ValueError])
def test_what_doubles_do_not_hold_is_not_covered(error: type[Exception]) -> None:
    def claims() -> Any:
        yield "x", place(1.0), real(1.0), real(1.0)
        raise error

    values = list(part("claims").covered(claims()))
    assert [(claim[0], claim[2] is None, claim[1].path) for claim in values[1:]] == [("request", True, ("request",))]

    def unreadable() -> Any:
        yield "x", place(1.0), real(1.0), real(1.0)
        raise part("numbers").Unreadable(("answer",), "must be a number")

    with pytest.raises(part("numbers").Unreadable):
        list(part("claims").covered(unreadable()))


def test_two_hundred_names_are_listed() -> None:
    leaves = part("leaves")
    answer = place({f"n{k}": [1.0, None, {"x": k}] for k in range(250)})
    account = leaves.account(answer, set(), set())
    assert (account["leaves"], account["checked"], len(account["not_covered"])) == (500, 0, 200)
    assert account["not_covered"][0] == "/answer/n0"
    names = {("answer", "n0", 0), ("answer", "n1", 2, "x")}
    verdict = leaves.account(answer, names, {("answer", "n2")})
    assert (verdict["leaves"], verdict["checked"]) == (498, 2)
    assert verdict["not_covered"][:3] == ["/answer/n0/*", "/answer/n1/*", "/answer/n3"]
    assert leaves.leaves(json.loads('{"a": [1, 2, {"b": null}], "c": "d"}')) == 7


@pytest.mark.parametrize(("planes", "rows", "orders", "right"), [(50, 4, 5, True), (51, 4, 5, False), (40, 5, 5, True),
                                                                  (41, 5, 5, False), (40, 5, 75, True),
                                                                  (40, 5, 76, False)])  # fmt: skip
def test_the_bending_of_many_planes_is_not_covered(planes: int, rows: int, orders: int, right: bool) -> None:
    """Analytic: 200 planes times rows, and 3000 planes times harmonics."""
    row = Fields(position=0.0, axis=1j)
    turn = Fields(pistons=Fields(rows=[row] * rows), turning=[], place=place({}, "request", "bearings"))
    harmonics = [Fields(shaft=dict.fromkeys(range(orders), 0j))]
    loads = Fields(pistons=harmonics, planes=[0.0] * planes, turn=turn, factor=lambda *_: 1.0, vector=lambda *_: 2j)
    curve = part("loads").Loads._curve
    if right:
        actual_curve = curve(loads, "bending:0.0")
        assert (actual_curve.weights, actual_curve.beside) == ([(k, 1j) for k in range(rows)], {0: 2j})
    else:
        with pytest.raises(part("numbers").NotCovered):
            curve(loads, "bending:0.0")
    assert curve(loads, "bearing:a").reading == "shaft"
