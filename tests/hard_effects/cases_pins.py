"""Loads of the anti-rotation pins of whole answers. Every pin is measured against its own largest load over the turn.

A pattern near a line, or of pins close together, multiplies the last digit of the pins' angles and radii. Where the
places leave a line by a share w of their span, loads change by 1/w units for a unit in the last place of the data. The
demand grows with that condition, and with nothing else.
"""

from collections.abc import Iterator
from typing import Any, NamedTuple

from optimizer.pins.answer import pin_loads
from schemas.scroll.pin_loads import PinLoadsRequest
from tests.hard_effects.case import ALGEBRAIC, EPS, Case, Finding, error
from tests.hard_effects.exact import mp
from tests.hard_effects.exact_pins import Pattern


class Pins(NamedTuple):
    """Pins, torque, why they are hard, and what a unit in the last place of the data changes, in such units."""

    name: str
    why: str
    pins: list[dict[str, Any]]
    torque: Any = 12.0
    condition: float = 1.0


def pins(angles: list[float], radius: Any = 0.06, **options: Any) -> list[dict[str, Any]]:
    """Pins at these angles; every other field one value for all, or a list."""
    columns = {"radius_m": radius, **options}
    return [
        {"angle_deg": angle, **{name: v[k] if isinstance(v, list) else v for name, v in columns.items()}}
        for k, angle in enumerate(angles)
    ]


_TABLE = {"angle_deg": [0, 70, 115, 260], "torque_Nm": [12, -20, 9, 15]}
_STRAY = [3.7, 117.0, 251.0, 300.0]

ELASTIC = (
    Pins("three even pins as a pattern", "none: for comparison", pins([3.0, 123.0, 243.0])),
    Pins("torque that changes its sign", "the largest load lies at an entry or between, by pin", pins(_STRAY), _TABLE),
    Pins(
        "stiffness 1e-9 : 1 : 1",
        "nearly a line by stiffness: the soft pin alone holds the torque there; peaks 3e-5 rad wide",
        pins(_STRAY[:3], stiffness_N_per_m=[0.02, 2e7, 2e7]),
        12.0,
        4e4,
    ),
    Pins(
        "stiffness 1 : 1e-9 : 1e-9",
        "the mean place is the stiff pin to nine digits; its own offset cancels",
        pins(_STRAY[:3], stiffness_N_per_m=[2e7, 0.02, 0.02]),
    ),
    Pins(
        "stiffness 1e18 : 1 : 1e-6",
        "24 decades: all that the request allows",
        pins(_STRAY[:3], stiffness_N_per_m=[1e18, 1.0, 1e-6]),
    ),
    Pins(
        "two stiff pins and two of 1e-9",
        "nearly a line by stiffness: peaks of 3e4 times, 4 degrees / 3e4 wide",
        pins([10.0, 190.0, 95.0, 280.0], stiffness_N_per_m=[2e7, 2e7, 0.02, 0.02]),
        12.0,
        4e4,
    ),
    Pins("1e-3 off a line", "loads peak at 1e3 times the usual within 1e-3 rad", pins([20.0, 200.0, 200.1]), 12.0, 2e3),
    Pins(
        "1e-5 off a line", "loads peak at 1e5 times the usual within 1e-5 rad", pins([20.0, 200.0, 200.001]), 12.0, 2e5
    ),
    Pins(
        "2e-6 off a line", "as near as a pattern may be without being on it", pins([20.0, 200.0, 200.0003]), 12.0, 1e6
    ),
    Pins(
        "cluster of 1e-6 radii",
        "places differ in their last ten digits only",
        pins([40.0, 40.00005, 40.00002], radius=[0.06, 0.06, 0.06000005]),
        12.0,
        1e7,
    ),
    Pins("radii of 1e-6 and 10 m", "seven decades of levers", pins(_STRAY, radius=[1e-6, 10.0, 0.06, 3.0])),
    Pins(
        "two pins, a degree from their line",
        "every pattern of two is on a line: 57 times the usual load",
        pins([1.0, 181.0]),
        12.0,
        1e2,
    ),
    Pins(
        "two pins, 1e-3 degrees from their line",
        "dead point between the samples: 57,000 times the usual load",
        pins([0.001, 180.001]),
        12.0,
        1e5,
    ),
)

CONTACT = (
    Pins("clearance of 1e-5", "some pins bear, others do not", pins(_STRAY, stiffness_N_per_m=2e7, clearance_m=1e-5)),
    Pins(
        "clearance of 1 m",
        "clearance is 1e5 times the strain that the torque makes",
        pins(_STRAY[:3], stiffness_N_per_m=2e7, clearance_m=1.0),
        12.0,
        1e6,
    ),
    Pins(
        "clearances of 1e-12 and 1e-4",
        "eight decades of play",
        pins(_STRAY, stiffness_N_per_m=2e7, clearance_m=[1e-12, 1e-4, 1e-12, 3e-5]),
    ),
    Pins(
        "errors that strain by themselves",
        "pins bear against each other without any torque",
        pins(_STRAY, stiffness_N_per_m=2e7, eccentricity_error_m=[1e-4, -1e-4, 5e-5, 0.0]),
        1e-3,
        1e3,
    ),
    Pins(
        "contact, stiffness 1e-9 : 1",
        "the soft pins only bear where the stiff ones do not",
        pins(_STRAY, stiffness_N_per_m=[2e7, 0.02, 2e7, 0.02], clearance_m=[1e-5, 0.0, 1e-5, 0.0]),
        12.0,
        1e3,
    ),
)


def _answer(body: dict[str, Any]) -> Any:
    return pin_loads(PinLoadsRequest.model_validate({"angles": {"step_deg": 7.5}, **body}))


def _loads(subject: Any, exact: Any) -> float:
    """Worst pin, against its own largest load; samples at dead points have none."""
    worst = 0.0
    for k, pin in enumerate(subject.pins):
        pairs = [(v, w) for v, w in zip(pin.load_N, (line[k] for line in exact), strict=True) if v is not None]
        worst = max(worst, error([v for v, _ in pairs], [w for _, w in pairs]))
    return worst


def _elastic(case: Pins) -> Iterator[Finding]:
    answer, exact = _answer({"pins": case.pins, "rotation_torque_Nm": case.torque}), Pattern(case.pins, case.torque)
    demanded = max(ALGEBRAIC, 4 * EPS * case.condition)
    yield Finding("elastic loads", _loads(answer, [exact.loads(a) for a in answer.angle_deg]), demanded)
    if answer.peak_N is not None:
        off = max(error(pin.peak_N, exact.peak(k)) for k, pin in enumerate(answer.pins))
        yield Finding("elastic peaks", off, demanded)


def _contact(case: Pins) -> Iterator[Finding]:
    answer, exact = _answer({"pins": case.pins, "rotation_torque_Nm": case.torque}), Pattern(case.pins, case.torque)
    contacts = [exact.contact(a) for a in answer.angle_deg]
    largest = max(abs(force) for line in contacts for force in line)
    off = max(
        abs(mp.mpf(pin.load_N[t]) - line[k]) for t, line in enumerate(contacts) for k, pin in enumerate(answer.pins)
    )
    yield Finding("contact loads", float(off / largest), max(ALGEBRAIC, 4 * EPS * case.condition))
    # the certificate: no load is further off than the answer says, rounding included
    bound = answer.contact.load_error_bound_N
    yield Finding("contact loads over their bound", float(max(off - bound, 0) / largest), 0.0)


def _even(count: int) -> Iterator[Finding]:
    answer = _answer({"pin_count": count, "pin_circle_radius_m": 0.06, "rotation_torque_Nm": 12.0})
    factor = 24 / (count * mp.mpf(0.06))
    exact = [
        [factor * mp.sinpi(mp.mpf(a) / 180 - mp.mpf(2 * i) / count) for i in range(count)] for a in answer.angle_deg
    ]
    yield Finding("even loads", _loads(answer, exact), ALGEBRAIC)
    off = max(error(pin.peak_N, factor) for pin in answer.pins)
    yield Finding("even peaks", off, ALGEBRAIC)


CASES = (
    *(Case("pins", f"{n} even pins", "phases 360/n are no doubles", lambda n=n: _even(n)) for n in (1, 2, 3, 7, 1000)),
    *(Case("pins", case.name, case.why, lambda case=case: _elastic(case)) for case in ELASTIC),
    *(Case("pins", case.name, case.why, lambda case=case: _contact(case)) for case in CONTACT),
)
