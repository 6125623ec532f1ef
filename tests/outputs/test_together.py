"""Peaks of all outputs of an answer are searched together: each as if it were searched alone."""

import json
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from optimizer.mechanics import curve_batch
from optimizer.outputs.peaks import TOLERANCE, search
from optimizer.outputs.registry import OUTPUTS, fields, prepare
from optimizer.responses import piecewise_cubics
from schemas.request.requests import AnalyzeRequest
from tests.benchmarks.outputs import sixteen_rows
from tests.benchmarks.whole_turn import six_with_gas

_EXAMPLES = Path(__file__).parents[2] / "examples"
_SHOWN = ("piston_force", "rod_loads", "torque", "overturning", "roll", "loads", "main_bearings")


def _example(name: str) -> dict[str, Any]:
    machine: dict[str, Any] = json.loads((_EXAMPLES / f"{name}.json").read_bytes())["machine"]
    return machine


MACHINES = {
    # double acting, with friction
    "2D12": lambda: _example("2d12"),
    # indicated pressures over two turns
    "four-stroke": lambda: _example("inline-four-engine"),
    # many rows, of which most curves have one
    "16 rows": sixteen_rows,
    "six with gas": six_with_gas,
}


@pytest.mark.parametrize("name", MACHINES)
def test_a_peak_does_not_depend_on_what_is_searched_beside_it(name: str) -> None:
    # independent: each search by itself, with the curves' own expansions
    machine = MACHINES[name]()
    texts = _SHOWN if machine.get("bearings") else _SHOWN[:-1]
    request = AnalyzeRequest.model_validate({"machine": machine, "outputs": texts, "angles": {"step_deg": 30}})
    scene = prepare(request, request.outputs)
    unbalance = np.full(len(machine["webs"]), 0.3 - 0.2j)
    searches = list(chain.from_iterable(OUTPUTS[text].searches(scene, unbalance) for text in texts))
    search(scene, searches)
    for entry in searches:
        alone = entry.curves.pieces.peaks(entry.offset, TOLERANCE, entry.number, entry.group, entry.sign)
        together = scene.peaks.brackets(entry.name)
        texts = scene.peaks.plain(entry.name)
        angle = np.mod(alone.angle, np.deg2rad(360.0) * scene.results["whole_turn"].turns)
        np.testing.assert_array_equal(together.angle, angle, err_msg=str(entry.name))
        np.testing.assert_array_equal(texts.angle_deg, np.rad2deg(angle), err_msg=str(entry.name))
        np.testing.assert_array_equal(together.value, alone.value, err_msg=str(entry.name))
        np.testing.assert_array_equal(texts.lower, alone.lower * entry.scale, err_msg=str(entry.name))
        np.testing.assert_array_equal(texts.upper, alone.upper * entry.scale, err_msg=str(entry.name))


def test_outputs_without_floors_need_one_search(monkeypatch: pytest.MonkeyPatch) -> None:
    searches: list[int] = []
    bracketed = piecewise_cubics._brackets

    def counted(pieces: piecewise_cubics.Pieces, *rest: Any) -> piecewise_cubics.Bracket:
        searches.append(len(pieces.half))
        assert isinstance(pieces.source, curve_batch.CurveBatch)
        return bracketed(pieces, *rest)

    monkeypatch.setattr(piecewise_cubics, "_brackets", counted)
    request = AnalyzeRequest.model_validate({"machine": _example("2d12"), "outputs": _SHOWN[:-1]})
    fields(prepare(request, request.outputs), np.zeros(len(request.machine.webs), complex), request.outputs)
    # two rows in five readings and their inertia, the torque and the roll
    assert searches == [2 * 6 + 2]


def test_nothing_is_searched_where_no_output_shows_a_peak() -> None:
    scene = prepare(AnalyzeRequest.model_validate({"machine": _example("2d12")}), ())
    search(scene, ())
    assert scene.peaks.is_closed(0.0)


def test_orders_are_those_of_the_counterweights_asked_for() -> None:
    # independent: each asked of a machine of its own, which knows nothing of the others
    request = AnalyzeRequest.model_validate({"machine": _example("2d12"), "outputs": ["orders"]})
    first, second = (np.full(len(request.machine.webs), size, complex) for size in (0.3 - 0.2j, -0.1j))
    scene = prepare(request, request.outputs)
    for unbalance in (first, second, None, first):
        alone = prepare(request, request.outputs).orders(unbalance)
        for order, wrench in scene.orders(unbalance).items():
            for pair, own in zip(wrench, alone[order], strict=True):
                assert (pair.co, pair.counter) == (own.co, own.counter)
    assert scene.orders(first)[1].force.co != scene.orders(second)[1].force.co
    assert scene.orders(first)[2] is scene.orders(second)[2]
