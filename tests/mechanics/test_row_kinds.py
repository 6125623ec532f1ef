"""Rows that differ by their phase alone: they are expanded once, and every curve stays what it was."""

import copy
from typing import Any

import numpy as np
import pytest

from optimizer.mechanics.gas import switching_angles
from optimizer.mechanics.row_data import row_data
from optimizer.mechanics.whole_turn import TurnCurves, WholeTurn, break_angles, whole_turn
from tests import night
from tests.analyze.driven import STYLES, arrays, random_driven

#: equal throws, evenly spaced by whole steps of the pieces
COUNTS = (2, 3, 4, 8)
_READINGS = ("piston", "rod_at_rest", "side", "tangential", "on_shaft", "on_frame")


def equal_throws(seed: int, style: str, count: int, apart_deg: float | None = None) -> dict[str, Any]:
    body = random_driven(seed, style, throws=1)
    first = body["throws"][0]
    body["throws"] = []
    for k in range(count):
        throw = copy.deepcopy(first)
        throw["position_m"] += 0.5 * k
        throw["crank_angle_deg"] += k * (360.0 / count if apart_deg is None else apart_deg)
        body["throws"].append(throw)
    return body


def _turn(body: dict[str, Any], kinds: bool = True) -> WholeTurn:
    """All rows over the revolution; each by itself where kinds are not to be looked for."""
    plan, data = arrays(body)
    friction = np.full(plan.reciprocating.mass.shape, 2e3)
    breaks = break_angles(plan, switching_angles(data, plan))
    turn = whole_turn(row_data(plan, True, friction, data), breaks, squared=True, single=True)
    if not kinds:
        vars(turn)["kinds"] = None
    return turn


def _curves(turn: WholeTurn, reading: Any, seed: int) -> TurnCurves:
    rng, count = np.random.default_rng(seed), turn.rows.crank_radius.shape[-1]
    weights = rng.normal(size=(1, 3, count)) * (rng.random((1, 3, count)) < 0.8)
    if reading.startswith("on_"):
        return turn.curves(
            reading, weights * np.exp(2j * np.pi * rng.random(weights.shape)), np.array([[1.0, 2j, 0.0]])
        )
    return turn.curves(reading, weights)


@pytest.mark.parametrize("style", night.part(1, STYLES))
@pytest.mark.parametrize("count", night.part(2, COUNTS))
def test_curves_are_those_of_rows_one_by_one(count: int, style: str) -> None:
    # analytic: a row that is ahead does the same, that much earlier
    body = equal_throws(count, style, count)
    turn, single = _turn(body), _turn(body, kinds=False)
    assert turn.kinds is not None
    assert turn.kinds.first.size == len(body["throws"][0]["rows"])
    for reading in _READINGS:
        curves, expected = _curves(turn, reading, count), _curves(single, reading, count)
        pieces, segments = curves.pieces, expected.pieces
        size = np.max(segments.size)
        assert pieces.cubic == pytest.approx(segments.cubic, rel=0.0, abs=1e-12 * size), reading
        assert pieces.rest == pytest.approx(segments.rest, rel=1e-9, abs=1e-15 * size), reading
        assert pieces.size == pytest.approx(segments.size, rel=1e-12), reading
        assert curves.mean == pytest.approx(expected.mean, abs=1e-12 * size), reading
        assert curves.variance == pytest.approx(expected.variance, rel=1e-9, abs=1e-13 * size**2), reading
        assert np.all(curves.rms_error <= 1e-9 * size), reading


@pytest.mark.parametrize(
    ("field", "value"),
    [("reciprocating_mass_kg", 1.25), ("axis_deg", 0.5), ("cylinder", None), ("connecting_rod", {"length_m": 9.0})],
)
def test_a_row_that_differs_is_of_a_kind_of_its_own(field: str, value: Any) -> None:
    body = equal_throws(1, "single", 4)
    for throw in body["throws"]:
        throw["crank_angle_deg"] = 90.0 * round(throw["crank_angle_deg"] / 90.0)
        throw["rows"][0]["axis_deg"] = 0.0
    row = body["throws"][1]["rows"][0]
    if value is None:
        row["cylinder"]["suction_pressure_Pa"] *= 1.1
    else:
        row[field] = value
    turn = _turn(body)
    kinds = turn.kinds
    if kinds is not None:
        # what jumps in one row cuts the pieces of all, so that these may repeat no more
        assert kinds.kind[1] not in np.delete(kinds.kind, 1)
    for reading in _READINGS:
        pieces = _curves(turn, reading, 1).pieces
        segments = _curves(_turn(body, kinds=False), reading, 1).pieces
        assert pieces.cubic == pytest.approx(segments.cubic, rel=0.0, abs=1e-12 * np.max(segments.size)), reading


def test_kinds_need_pieces_that_repeat() -> None:
    # analytic: 72 degrees are no whole number of pieces
    assert _turn(equal_throws(2, "single", 5)).kinds is None
    # nor are throws that are 90 degrees apart and do not go around
    assert _turn(equal_throws(2, "single", 3, apart_deg=90.0)).kinds is None
    assert _turn(random_driven(3, "v")).kinds is None


def test_equal_rows_that_do_the_same_at_once_are_one() -> None:
    # analytic: crank and axis turned together
    body = equal_throws(4, "single", 2, apart_deg=180.0)
    body["throws"][1]["rows"][0]["axis_deg"] += 180.0
    kinds = _turn(body).kinds
    assert kinds is not None
    assert kinds.kind.tolist() == kinds.later.tolist() == [0, 0]
