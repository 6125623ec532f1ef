"""The eight stages in the checker: genuine ones are held, figures that are falsified are broken, and edges are wide."""

import json
from collections.abc import Callable
from functools import cache
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from service.verification import checker
from tests import night
from tests.optimize.machines import machine, row, throw, web
from tests.optimize.shafts import shaft
from tests.pairs.asking import body_of
from tests.verification.answers import answered
from tests.verification.anything import JSON, judged, paths
from tests.verification.anything import replaced as replaced_anywhere
from tests.verification.checking import broken
from tests.verification.falsified import at, numbers, replaced
from tests.verification.kinds import SINGLE
from tests.verification.test_curves import part

#: by which a figure is falsified, and the share of the largest of its unit below which one is what rounding leaves
_SHARE, _DUST = 1e-6, 1e-8


def _rod(axis: float, mass: float, **more: Any) -> dict[str, Any]:
    return row(axis, mass, connecting_rod={"length_m": 0.35, "mass_kg": 3.0}, **more)


def _crooked(ratio: int | None, rotation: str = "ccw", **objective: Any) -> dict[str, Any]:
    """A machine of which no figure is 0, with a balance shaft that is to be seen in what is left."""
    throws = [throw(-0.3, 70.0, [_rod(25.0, 12.0)], rotating=4.0), throw(0.4, 190.0, [_rod(130.0, 11.0)], rotating=2.0)]
    more = {} if ratio is None else {"balance_shafts": [shaft("one", ratio, 0.2, 1.5)]}
    webs = [web("a", -0.4, 4.0), web("b", 0.5, 4.0)]
    return {"machine": machine(throws, webs, rotation=rotation, **more), "objective": objective}


def _upright(angle: float) -> dict[str, Any]:
    """Rows along one direction, of which every rule of thumb speaks."""
    throws = [throw(-0.3, 20.0, [_rod(angle, 12.0)], rotating=4.0), throw(0.4, 20.0, [_rod(angle, 7.0)], rotating=2.0)]
    return {"machine": machine(throws, [web("a", -0.4, 4.0), web("b", 0.5, 4.0)])}


_MADE: dict[str, Callable[[], Any]] = {
    "balance shaft with": lambda: _crooked(1),
    "clockwise": lambda: _crooked(None, "cw"),
    "balance shaft against": lambda: _crooked(-1),
    "balance shaft of order 2": lambda: _crooked(2, orders="all"),
    "balance shaft of order -2": lambda: _crooked(-2, orders="all"),
    "infeasible": lambda: _crooked(None, force_ceiling_N=1.0),
    "along x": lambda: _upright(0.0),
    "along y": lambda: _upright(90.0),
    "oldham": lambda: SINGLE["scroll-oldham"],
    "pins": lambda: SINGLE["scroll-three-pins"],
    "in line": lambda: SINGLE["inline-six"],
    "V": lambda: SINGLE["v90-equal"],
    "plates": lambda: body_of("twin", ("plates, sectors",), 2.0),
    "unbalances": lambda: body_of("twin", ("unbalances", "reference plane"), 2.0),
    "two terms": lambda: _crooked(None) | {"fidelity": {"kinematics": "order_2"}},
    "one plane": lambda: _crooked(None) | {"machine": _crooked(None)["machine"] | {"webs": [web("a", 0.1, 4.0)]}},
    "no webs": lambda: _crooked(None) | {"machine": _crooked(None)["machine"] | {"webs": []}},
}


@cache
def _pair(name: str) -> tuple[Any, str]:
    body = json.loads(json.dumps({**_MADE[name](), "outputs": ["stages"]}))
    return body, json.dumps(answered(body))


def _judge(request: Any, answer: Any) -> Callable[[Any], bool]:
    """Whether a claim of the stages is broken, of answers that differ in these alone."""
    place = part("numbers").Place
    position, actual_place = place(request, "request"), place(answer, "answer")
    plan = part("machine").Machine(
        position / "machine",
        position / "objective",
        actual_place / "reference_plane_m",
        position / "machine" / "max_total_mass_kg",
    )
    claims = part("answer").fitted(position, plan, actual_place / "counterweights", actual_place / "balance_shafts")
    fitted = None
    while answer["status"] != "infeasible" and fitted is None:
        try:
            next(claims)
        except StopIteration as value:
            fitted = value.value

    def refuted(changed: Any) -> bool:
        stages = list(part("stages").stages(position, plan, place(changed, "answer"), fitted))
        return any(room is not None and room.high < 0 for _, _, room, _ in stages)

    return refuted


@pytest.mark.parametrize("name", night.part(2, _MADE))
def test_every_number_of_genuine_stages_is_held(name: str) -> None:
    request, text = _pair(name)
    verdict = checker().verify(request, json.loads(text))
    assert not broken(request, json.loads(text))
    assert not [where for where in verdict["not_covered"] if "stages" in where]


@pytest.mark.parametrize("step", [6, pytest.param(1, marks=pytest.mark.nightly)])
@pytest.mark.parametrize("name", night.part(3, _MADE))
def test_figures_that_are_off_by_a_millionth_are_broken(name: str, step: int) -> None:
    """Of every stage one number of so many."""
    request, text = _pair(name)
    answer = json.loads(text)
    refuted = _judge(request, answer)
    assert not refuted(answer)
    stages, count = answer["stages"], 0
    for k, stage in enumerate(stages):
        places = [("stages", k, *path) for path in numbers(stage)]
        most = max(abs(level["value"]) for level in stages if level["unit"] == stage["unit"])
        for path in places[k % step :: step]:
            leaf = at(answer, path)
            # rounding has no share, nor has its direction one
            if leaf == 0 or min(_size(answer, path), abs(at(stages, (k, "value"))) or most) < _DUST * most:
                continue
            count += 1
            assert refuted(replaced(answer, path, leaf * (1 + _SHARE))), path
    assert count > 18 // step


def _size(answer: Any, path: tuple[str | int, ...]) -> float:
    """What a place tells the size of, or that of which it tells the direction."""
    plain = path[-1] in ("direction_deg", "frequency_Hz", "order", "transferred_share", "position_m")
    size: float = at(answer, path[:-1]).get("peak", float("inf")) if plain else abs(at(answer, path))
    return size


@pytest.mark.parametrize("field", ["motion", "quantity", "unit", "order"])
def test_what_acts_is_called_as_it_is(field: str) -> None:
    request, text = _pair("clockwise")
    answer = json.loads(text)
    refuted = _judge(request, answer)
    changed = {"motion": "none", "quantity": "couple", "unit": "N mm", "order": 3}[field]
    for k in (0, 3, 7):
        assert refuted(replaced(answer, ("stages", k, "acting", 0, field), changed))
        if answer["stages"][k]["left"][0][field] != changed:
            assert refuted(replaced(answer, ("stages", k, "left", 0, field), changed))


@pytest.mark.parametrize("verdict", ["fully", "partly", "no"])
def test_one_verdict_alone_is_true(verdict: str) -> None:
    request, text = _pair("clockwise")
    answer = json.loads(text)
    refuted = _judge(request, answer)
    for k, stage in enumerate(answer["stages"]):
        assert refuted(replaced(answer, ("stages", k, "balanceable"), verdict)) == (stage["balanceable"] != verdict)


@pytest.mark.parametrize(
    ("path", "wrong"),
    [
        (("stages", 0), None),
        (("stages", 6, "iron"), []),
        (("stages", 2, "acting"), []),
        (("stages", 2, "left"), None),
        (("stages", 2, "rules_of_thumb"), []),
        (("stages", 2, "rules_of_thumb", 0, "name"), "transfer 25 % of the first-order force"),
        (("stages", 2, "remaining"), None),
        (("stages", 6, "unit"), "N"),
        (("stages", 6, "stage"), "VI"),
    ],
)
def test_nothing_is_left_out_nor_renamed(path: tuple[str | int, ...], wrong: Any) -> None:
    request, text = _pair("along y")
    answer = json.loads(text)
    refuted = _judge(request, answer)
    if len(path) == 2:
        assert refuted({**answer, "stages": answer["stages"][1:]})
    else:
        assert refuted(replaced(answer, path, wrong))


def test_what_is_infeasible_leaves_nothing() -> None:
    request, text = _pair("infeasible")
    answer = json.loads(text)
    refuted = _judge(request, answer)
    assert refuted(replaced(answer, ("stages", 0, "remaining"), answer["stages"][0]["value"]))
    assert refuted(replaced(answer, ("stages", 0, "left"), answer["stages"][0]["acting"]))


def test_words_are_no_claims() -> None:
    request, text = _pair("along y")
    answer = json.loads(text)
    whole = checker().verify(request, answer)
    for path in (("title",), ("formula",), ("plane",), ("rules_of_thumb", 0, "source")):
        verdict = checker().verify(request, replaced(answer, ("stages", 2, *path), "something else"))
        assert (verdict["leaves"], verdict["checked"]) == (whole["leaves"], whole["checked"])


def _number(phasor: complex) -> Any:
    tools = part("numbers")
    return tools.real(phasor.real) + tools.J * tools.real(phasor.imag)


@pytest.mark.parametrize(
    ("fitted", "left", "taken"),
    [
        (-0.5 + 0j, 1.5, 0.0),
        (-3.0 + 0j, 0.0, -1.0),
        (1.0 + 0j, 2.0, 1.0),
        (-1.0 + 2j, 1.0, 2j),
    ],
)
def test_what_rotates_is_opposed_first(fitted: complex, left: complex, taken: complex) -> None:
    """Analytic: of 2 along x as much as is fitted along -x, and no more than all of it."""
    pair, zero, turn = part("ellipses").Pair, _number(0j), 0.6 + 0.8j
    parts = (pair(_number(2 * turn), zero), pair(_number(1j * turn), _number(5 + 0j)))
    superposition = part("stages").superposed(*parts, pair(_number(fitted * turn), _number(-3 + 0j)))
    assert superposition[0].co.middle() == pytest.approx(left * turn, abs=1e-12)
    assert superposition[1].co.middle() == pytest.approx((taken + 1j) * turn, abs=1e-12)
    assert superposition[1].counter.middle() == pytest.approx(2.0)


def test_of_nothing_that_rotates_nothing_is_opposed() -> None:
    """Analytic: what is known to its own size alone may be opposed by no more than that."""
    pair, zero = part("ellipses").Pair, _number(0j)
    superposition = part("stages").superposed(pair(zero, zero), pair(zero, zero), pair(_number(-7 + 0j), zero))
    assert (float(abs(superposition[0].co)), superposition[1].co.middle()) == (
        pytest.approx(0.0, abs=1e-300),
        pytest.approx(-7.0),
    )


_EDGES = [
    ((1.0, 0.0), {"with_shaft"}, {"fully"}),
    ((0.0, 1.0), {"against_shaft"}, {"no"}),
    ((1.0, 1.0), {"fixed"}, {"partly"}),
    ((1.0, 0.5), {"ellipse"}, {"partly"}),
    ((0.0, 0.0), {"none"}, {"fully"}),
    ((1e-14, 0.0), {"none"}, {"fully"}),
    ((1.0, 0.9e-6), {"with_shaft"}, {"partly"}),
    ((1.0, 1.1e-6), {"ellipse"}, {"partly"}),
    ((1.0, 0.9e-9), {"with_shaft"}, {"fully"}),
    ((0.9e-9, 1.0), {"against_shaft"}, {"no"}),
]


@pytest.mark.parametrize(("sizes", "motions", "verdicts"), _EDGES)
def test_edges_between_shapes(sizes: tuple[float, float], motions: set[str], verdicts: set[str]) -> None:
    """Analytic: what is below its share counts for none."""
    tools = part("ellipses")
    pair = tools.Pair(*(_number(size * (0.6 + 0.8j)) for size in sizes))
    assert tools.motions(pair, part("numbers").real(1e-13)) == motions
    assert tools.balanceable(pair, 1) == verdicts
    assert tools.balanceable(pair, 2) == ({"fully"} if sizes == (0.0, 0.0) else {"no"})


def test_verdicts_of_several_together() -> None:
    """Analytic: partly where they differ, of what is none nothing is said."""
    tools = part("ellipses")
    number, none = _number(1 + 0j), _number(0j)
    turns, fixed, nothing = tools.Pair(number, none), tools.Pair(number, number), tools.Pair(none, none)
    assert tools.all_balanceable([(turns, 1), (nothing, 2)]) == {"fully"}
    assert tools.all_balanceable([(turns, 1), (fixed, 2)]) == {"partly"}
    assert tools.all_balanceable([(fixed, 2), (nothing, 1)]) == {"no"}
    assert tools.all_balanceable([(nothing, 2)]) == {"fully"}
    unsure = tools.Pair(part("numbers").SPECK, none)
    assert tools.all_balanceable([(turns, 1), (unsure, 2)]) == {"fully", "partly"}


@pytest.mark.parametrize(
    ("degrees", "counter", "name", "shares"),
    [
        (89.0, 1.0, "force", [(0.2, 0.3)]),
        (46.0, 1.0, "force", [(0.2, 0.3)]),
        (44.0, 1.0, "force", [(0.3, 0.5)]),
        (45.0, 1.0, "force", [(0.3, 0.5)]),
        (179.0, 1.0, "force", [(0.3, 0.5)]),
        (89.0, 1.0, "moment", [(0.15, 0.5)]),
        (1.0, 1.0, "moment", [(0.5,)]),
        (1.0, 0.5, "moment", [()]),
        (1.0, 0.5, "force", [(0.5,)]),
        (1.0, 0.0, "force", [()]),
        (1.0, 0.0, "moment", [()]),
    ],
)
def test_which_rules_are_customary(degrees: float, counter: float, name: str, shares: list[tuple[float, ...]]) -> None:
    """Published: the slides on balancing."""
    way = part("numbers").direction(degrees)
    pair = part("ellipses").Pair(way, way * part("numbers").real(counter))
    assert part("thumb").customary(pair, name) == shares


_ANGLES = st.sampled_from([0.0, 45.0, 90.0, 120.0, 180.0]) | st.floats(0.0, 360.0)
_MASSES = st.sampled_from([0.0, 4.0]) | st.floats(0.1, 20.0)


@night.by_day(10, 20)
@given(
    st.lists(st.tuples(_ANGLES, _ANGLES, _MASSES, _MASSES), min_size=1, max_size=3),
    st.lists(st.tuples(st.floats(-1.0, 1.0), st.floats(0.0, 9.0)), max_size=3),
    st.sampled_from([None, 1, -1, 2, -2]),
    st.sampled_from(["ccw", "cw"]),
)
def test_stages_of_any_machine_are_held(
    throws: list[tuple[float, ...]], webs: list[tuple[float, float]], ratio: int | None, rotation: str
) -> None:
    places = [throw(0.3 * k, turn, [_rod(axis, mass)], 0.1, own) for k, (turn, axis, mass, own) in enumerate(throws)]
    fitted = [web(f"{k}", position, most) for k, (position, most) in enumerate(webs)]
    more = {} if ratio is None else {"balance_shafts": [shaft("one", ratio, 0.2, 3.0)]}
    body = {"machine": machine(places, fitted, rotation=rotation, **more), "outputs": ["stages"]}
    answer = answered(body)
    assert not broken(body, answer)
    assert not [where for where in checker().verify(body, answer)["not_covered"] if "stages" in where]


@settings(max_examples=15, deadline=None)
@given(data=st.data())
def test_nothing_that_is_sent_as_stages_raises(data: st.DataObject) -> None:
    """Any JSON in any place of the stages is judged, or refused by name."""
    request, text = _pair(data.draw(st.sampled_from(["along y", "balance shaft of order 2", "infeasible", "pins"])))
    answer = json.loads(text)
    for _ in range(data.draw(st.integers(1, 2))):
        places = [path for path in paths(answer) if path[:1] == ("stages",)]
        answer = replaced_anywhere(answer, data.draw(st.sampled_from(places)), data.draw(JSON))
    judged(request, answer)
