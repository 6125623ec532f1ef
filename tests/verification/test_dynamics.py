"""Gas, friction and inertia in the checker: pressures, works, peaks and all outputs of them."""

from collections.abc import Iterator
from functools import cache
from math import pi
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from schemas.base.units import parse_quantity
from service.verification import checker
from tests import night
from tests.verification.answers import pair
from tests.verification.anything import JSON, judged, paths
from tests.verification.anything import replaced as replaced_anywhere
from tests.verification.checking import broken, is_broken
from tests.verification.falsified import numbers, replaced
from tests.verification.test_curves import part

_OUTPUTS = (
    "kinematics",
    "gas",
    "piston_force",
    "rod_loads",
    "torque",
    "flywheel",
    "overturning",
    "roll",
    "loads",
)


@pytest.mark.parametrize("name", night.part(4, ["dynamics", "four strokes", "gas", "indicated pressure"]))
def test_every_claim_is_held(name: str) -> None:
    verdict = checker().verify(*pair(name))
    assert (verdict["verdict"], verdict["not_covered"]) == ("held", [])


def _refuted(request: Any, answer: Any, output: str) -> bool:
    """Whether a claim of one output is broken, without what else the answer holds."""
    place = part("numbers").Place
    position, actual_place = (
        place(request, "request"),
        place({**answer, **dict.fromkeys(_OUTPUTS)} | {output: answer[output]}),
    )
    machine = part("machine").Machine(position / "machine", position / "objective", place(None), place(None))
    curves = part("bearings").curves if output == "roll" else part("outputs").dynamics
    alone = place({**actual_place.value, "residual": {}, "main_bearings": None, "internal_moment": None}, "answer")
    claims = list(curves(position, machine, alone, part("answer").NOTHING_FITTED if output == "roll" else None))
    assert claims
    return any(room is not None and room.high < 0 for _, _, room, _ in claims)


@pytest.mark.parametrize("some", [3, pytest.param(24, marks=pytest.mark.nightly)])
@pytest.mark.parametrize("name", night.part(2, ["dynamics", "four strokes"]))
def test_samples_and_peaks_that_are_falsified_are_broken(name: str, some: int) -> None:
    """Of every output some numbers, whatever they are."""
    request, answer = pair(name)
    for output in _OUTPUTS:
        number = answer[output]
        assert not number or not _refuted(request, answer, output)
        places = [(output, *path) for path in numbers(number)] if number else []
        for path in places[:: max(1, len(places) // some)]:
            if path[-1] in ("mean_torque_error_Nm", "fluctuation_energy_error_J"):
                continue
            node: Any = answer
            for step in path:
                node = node[step]
            assert _refuted(request, replaced(answer, path, node * 1.001 + 1e-3), output), path


@settings(max_examples=10)
@given(data=st.data())
def test_nothing_that_is_sent_as_gas_raises(data: st.DataObject) -> None:
    """Any JSON in any place of throws, friction and flywheel is judged, or refused by name."""
    request, answer = pair("four strokes")
    fields = {**dict.fromkeys(_OUTPUTS), "main_bearings": None, "internal_moment": None}
    answer = {**answer, **fields, **{name: answer[name] for name in ("gas", "torque", "flywheel", "loads")}}
    request["objective"] = {}
    places = [path for path in paths(request) if {"throws", "friction", "flywheel"} & {*path} and len(path) > 2]
    for path, value in data.draw(st.lists(st.tuples(st.sampled_from(places), JSON), min_size=1, max_size=2)):
        request = replaced_anywhere(request, path, value)
    judged(request, answer)


@pytest.mark.parametrize("field", night.part(2, ["before_Nm", "after_Nm"]))
def test_the_moment_inside_the_shaft_is_held(field: str) -> None:
    request, answer = pair("dynamics")
    answer["internal_moment"][field] = answer["internal_moment"][field] * 1.001 + 0.1
    assert any(claim.startswith("internal_moment") for claim in broken(request, answer))


def _cycle(head: bool, ratio: float, clearance: float) -> Any:
    return part("gas").Cycle(head, 0.01, 1e5, ratio * 1e5, clearance * 0.2, 0.2, 1.2, 1.3)


@cache
def _pistons(name: str) -> Any:
    numbers_, machine = part("numbers"), part("machine")
    place = numbers_.Place(pair(name)[0], "request")
    nothing = numbers_.Place(None)
    built = machine.Machine(place / "machine", place / "objective", nothing, nothing)
    return part("pistons").Pistons(place / "machine", built, list(part("pistons").rows_of(place / "machine")))


@given(st.booleans(), st.floats(1.0, 20.0), st.floats(0.01, 0.2), st.floats(0, 6.28), st.floats(0, 0.9))
def test_a_polytrope_keeps_p_times_volume_to_its_exponent(
    head: bool, ratio: float, clearance: float, own: float, rod: float
) -> None:
    """Analytic: while gas is shut in, p V^n is what it was; else it has one of both pressures."""
    cycle, piston = _cycle(head, ratio, clearance), part("gas").motion(rod, own)
    to_shaft = own < pi
    pressure = cycle.at(piston, to_shaft)
    volume = cycle.clear + 0.1 * (piston.travel if head else piston.rest)
    exponent, start = (1.2, cycle.clear) if head == to_shaft else (1.3, cycle.clear + 0.2)
    first = cycle.high if head == to_shaft else cycle.low
    shut_in = pressure * volume**exponent == pytest.approx(first * start**exponent, rel=1e-9)
    assert shut_in or pressure in (cycle.low, cycle.high)
    assert cycle.low <= pressure <= cycle.high


@pytest.mark.parametrize("head", [True, False])
@pytest.mark.parametrize("ratio", [1.5, 4.0])
def test_work_and_valves_of_a_cycle(head: bool, ratio: float) -> None:
    """Analytic: of four processes, n / (n - 1) (p_2 V_2 - p_1 V_1) of a polytrope with what is let in or out."""
    cycle, row = _cycle(head, ratio, 0.08), _pistons("dynamics").rows[0]
    row.radius, rest = 0.1, (row.radius, row.chambers)
    row.chambers = [cycle]

    def technical(exponent: float, pressure: float, volume: float) -> float:
        return exponent / (exponent - 1) * pressure * volume * (ratio ** ((exponent - 1) / exponent) - 1)

    full, clear = cycle.area * (0.2 + cycle.clear), cycle.area * cycle.clear
    work = technical(1.3, 1e5, full) - technical(1.2, 1e5, clear * ratio ** (1 / 1.2))
    assert row.work(cycle) == pytest.approx(work, rel=1e-9)
    for angle, pressure in zip(cycle.breaks(row.ratio), (cycle.low, cycle.high), strict=True):
        there = part("gas").motion(row.ratio, angle)
        assert cycle.at(there, angle < pi) == pytest.approx(pressure, rel=1e-9)
        assert cycle.at(part("gas").motion(row.ratio, angle - 1e-3), angle < pi) != pressure
    row.radius, row.chambers = rest


@settings(max_examples=20)
@given(st.sampled_from(["dynamics", "four strokes"]), st.data())
def test_a_peak_of_pressed_rows_is_enclosed(name: str, data: st.DataObject) -> None:
    """Independent: the curve at many angles."""
    pistons, pressed = _pistons(name), part("pressed")
    reading = data.draw(st.sampled_from(["piston", "rod", "side", "tangential", "radial", "shaft"]))
    weight = st.complex_numbers(max_magnitude=2, allow_nan=False) if reading == "shaft" else st.floats(-2, 2)
    curve = pressed.PressureCurve(pistons, reading, [(k, data.draw(weight)) for k in range(len(pistons.rows))])
    curve = curve.plus(data.draw(st.floats(-1e4, 1e4)))
    sign = 0 if reading == "shaft" else data.draw(st.sampled_from([-1, 0, 1]))
    peak = curve.peak(sign=sign)
    assert peak.high <= peak.low + 1e-9 * abs(peak.low) + 1e-11 * curve.size
    values = [curve.value(angle) for angle in np.linspace(0.0, pistons.period, 500)]
    heights = [sign * phasor.real if sign else abs(phasor) for phasor in values]
    assert max(heights) <= peak.high + 1e-11 * curve.size
    there = [sign * side.real if sign else abs(side) for side in curve.sides(peak.angle)]
    assert max(there) == pytest.approx(peak.low, rel=1e-6, abs=1e-6 * curve.size)


def test_mean_and_root_mean_square_by_a_quadrature() -> None:
    """Independent: the trapezoidal rule at many angles."""
    pistons = _pistons("four strokes")
    curve = part("pressed").PressureCurve(pistons, "shaft", [(0, 1.0), (1, 0.5j)]).plus(50j)
    values = np.array([curve.value(angle) for angle in np.linspace(0.0, pistons.period, 8_000, endpoint=False)])
    assert abs(curve.mean - values.mean()) < 1e-3 * curve.size
    assert curve.rms == pytest.approx(np.sqrt(np.mean(np.abs(values) ** 2)), rel=1e-3)


@pytest.mark.parametrize("text", ["4 bar", "0.4 MPa", "400 kPa", "58.01509 psi", "4e5 Pa"])
def test_pressures_have_the_units_of_the_service(text: str) -> None:
    """Independent: the units of the schema."""
    place = part("numbers").Place({"discharge_pressure_Pa": text}, "request")
    assert (place / "discharge_pressure_Pa").double() == parse_quantity(text, "Pa")


def brackets(node: Any) -> Iterator[list[float]]:
    """Every bracket of an answer that is wider than nothing."""
    for name, value in node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ():
        if "bracket" in str(name) and value[0] < value[1]:
            yield value
        yield from brackets(value)


def test_both_ends_of_a_bracket_stand_in_their_order() -> None:
    request, answer = pair("dynamics")
    every = list(brackets(answer))
    assert len(every) > 4
    # of bearings, of rods, and of bending moments
    for bracket in (every[0], every[len(every) // 2], answer["main_bearings"]["bending"]["peak_bracket_Nm"]):
        bracket.reverse()
        assert is_broken(request, answer)
        bracket.reverse()
    assert not broken(request, answer)


@pytest.mark.parametrize("reading", ["side", "tangential", "radial"])
@pytest.mark.parametrize("ratio", [0.05, 0.3, 0.8])
def test_sizes_of_what_a_rod_makes_of_a_force(reading: str, ratio: float) -> None:
    """Independent: the Fourier series of numpy; sums of its sizes and of those of its slopes in a frame that turns."""
    pressed, count, frame = part("pressed"), 1024, -0.3
    values = [pressed.READINGS[reading](pressed.motion(ratio, 2 * pi * n / count)) for n in range(count)]
    sizes, orders = np.abs(np.fft.fft(values)) / count, np.fft.fftfreq(count, 1 / count)
    for power, size in enumerate(pressed._sizes(reading, ratio, frame)):
        assert size == pytest.approx(np.sum(np.abs(orders - frame) ** power * sizes), rel=2e-4)
        assert size > np.sum(np.abs(orders - frame) ** power * sizes)
