"""Three machines with counterweights, ours beside rigid bodies that EXUDYN integrates over one turn."""

import json
from collections.abc import Iterator
from typing import Any

import numpy as np

from optimizer.analyze import analyze
from optimizer.numerics.arrays import Complex
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.requests import AnalyzeRequest
from service.documents.examples import load
from tests.validation.comparison import Comparison
from tests.validation.multibody import STEPS, Revolution, revolution

#: example, planes of its two bearings, and counterweights on its webs as mass and angle
MACHINES: dict[str, tuple[tuple[float, float], list[tuple[float, float]]]] = {
    "2d12": ((-0.4, 0.4), [(30.0, 170.0), (0.0, 0.0), (5.0, 20.0), (20.0, 10.0)]),
    "v90-equal": ((-0.2, 0.25), [(6.0, 185.0), (4.0, 170.0)]),
    "v8-cross-plane": ((-0.3, 0.28), [(1.2, 190.0), (0.7, 95.0), (0.0, 0.0), (1.0, 20.0)]),
}
#: of the largest figure: the trapezoidal rule in steps of a quarter of a degree
_METHOD = 2e-5


def comparisons(names: tuple[str, ...] = tuple(MACHINES)) -> Iterator[Comparison]:
    for name in names:
        yield from _machine(name)


def _machine(name: str) -> Iterator[Comparison]:
    places, fitted = MACHINES[name]
    posted = json.loads(load(name))["machine"]
    # ours read, so that units and defaults are numbers; without gas and friction, which are internal to the frame
    machine = ReciprocatingMachine.model_validate(posted).model_dump(mode="json")
    for throw in machine["throws"]:
        for row in throw["rows"]:
            row["cylinder"] = None
    bearings = [{"name": str(k), "position_m": place} for k, place in enumerate(places)]
    machine = machine | {"bearings": bearings, "friction": None, "flywheel": None}
    webs = [web["name"] for web in machine["webs"]]
    counterweights = [
        {"web": web, "mass_kg": mass, "angle_deg": angle} for web, (mass, angle) in zip(webs, fitted, strict=False)
    ]
    request = AnalyzeRequest.model_validate(
        {
            "machine": machine,
            "counterweights": counterweights,
            "outputs": ["residual", "orders", "main_bearings"],
            "angles": {"step_deg": 360.0 / STEPS},
        }
    )
    answer = analyze(request)
    places_of_throws = [throw["position_m"] for throw in machine["throws"]]
    reference = 0.5 * (min(places_of_throws) + max(places_of_throws))
    turn = revolution(machine, counterweights, reference)
    yield from _against(name, answer, turn)


def _against(name: str, answer: Any, turn: Revolution) -> Iterator[Comparison]:
    for order in (1, 2):
        (ours,) = (order_peaks for order_peaks in answer.orders.after if order_peaks.order == order)
        force, moment = _peak(turn.force, order), _peak(turn.moment, order)
        allowed = _METHOD * float(np.max(np.abs(turn.force))), _METHOD * float(np.max(np.abs(turn.moment)))
        yield _line(name, f"force of order {order}", force, ours.force.peak_N, allowed[0], "N")
        yield _line(name, f"moment of order {order}", moment, ours.moment.peak_Nm, allowed[1], "N m")
    for k, bearing in enumerate(answer.main_bearings.bearings):
        load = np.array(bearing.after.force_x_N) + 1j * np.array(bearing.after.force_y_N)
        size = float(np.max(np.abs(turn.bearings[k])))
        off = float(np.max(np.abs(load - turn.bearings[k])))
        peak = float(np.max(np.abs(load)))
        yield _line(name, f"largest load of bearing {k + 1}", size, peak, _METHOD * size, "N")
        yield _line(name, f"load of bearing {k + 1}, largest difference at {STEPS} angles", 0, off, _METHOD * size, "N")


def _line(name: str, quantity: str, expected: float, ours: float, allowed: float, unit: str) -> Comparison:
    return Comparison(name, quantity, "independent", expected, ours, allowed, unit)


def _peak(values: Complex, order: int) -> float:
    """|f| + |b| of one order."""
    spectrum = np.fft.fft(values) / values.size
    return float(np.abs(spectrum[order]) + np.abs(spectrum[-order]))
