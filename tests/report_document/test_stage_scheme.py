"""The scheme of the balancing stages, and indicator diagrams: what is drawn is what the answer says."""

from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

from optimizer.optimize import optimize
from schemas.answer.outputs import Stage
from schemas.machine.reciprocating import ReciprocatingMachine
from service.report.indicator import indicators
from service.report.stage_scheme import stage_scheme
from tests.report_document.conftest import MARKUP, request_of

_SVG = "{http://www.w3.org/2000/svg}"


def stages_of(example: str, **changes: Any) -> tuple[Any, tuple[Stage, ...]]:
    request = request_of(example, outputs=["stages"], **changes)
    stages = optimize(request).stages
    assert stages is not None
    return request.machine, stages


def cells(machine: Any, stages: tuple[Stage, ...]) -> list[ElementTree.Element]:
    root = ElementTree.fromstring(stage_scheme(machine, stages).svg())
    return root.findall(f"{_SVG}g")


def texts(cell: ElementTree.Element) -> list[str]:
    return [element.text or "" for element in cell.iter(f"{_SVG}text")]


def test_every_stage_is_drawn_with_what_acts_and_what_is_left() -> None:
    machine, stages = stages_of("2d12")
    drawn = cells(machine, stages)
    assert [texts(cell)[0] for cell in drawn] == ["I", "II", "III", "IV", "V", "VI", "VII", "VIII"]
    for cell, stage in zip(drawn[:6], stages, strict=False):
        words = " ".join(texts(cell))
        for part in (*stage.acting, *(stage.left or ())):
            assert part.motion == "none" or f"{part.peak:.6g} {part.unit}" in words
    # published of opposed rows: what is left of first-order forces turns against the shaft, of second order it is fixed
    assert "against the shaft" in " ".join(texts(drawn[2]))
    assert "one direction" in " ".join(texts(drawn[5]))
    assert sum("order" in text for text in texts(drawn[7])) == 4


def test_arrows_point_where_the_forces_do_analytic() -> None:
    """Second-order forces of a V at 90 degrees are horizontal: a level line through the middle of the picture."""
    rod = {"length_m": 0.5}
    rows = [{"axis_deg": axis, "reciprocating_mass_kg": 2, "connecting_rod": rod} for axis in (45, 135)]
    throw = {"position_m": 0, "crank_radius_m": 0.1, "crank_angle_deg": 90, "rows": rows}
    machine = {"kind": "reciprocating", "speed_rpm": 600, "throws": [throw]}
    plan, stages = stages_of("2d12", machine=machine)
    assert isinstance(plan, ReciprocatingMachine)
    (acting,) = stages[4].acting
    assert (acting.motion, acting.direction_deg) == ("fixed", pytest.approx(0.0, abs=1e-9))
    lines = [element.get("d") for element in cells(plan, stages)[4].iter(f"{_SVG}path")]
    # the largest reaches 50 px to both sides of the middle at 77, 92
    assert "M127 92L27 92" in lines


def test_machines_without_webs_and_scrolls_have_a_scheme() -> None:
    machine, stages = stages_of("scroll-three-pins")
    assert len(cells(machine, stages)) == 8
    bare = request_of("2d12").machine.model_dump(mode="json") | {"webs": [], "name": MARKUP}
    plan, without = stages_of("2d12", machine=bare)
    assert "no webs" in texts(cells(plan, without)[6])


def test_an_indicator_diagram_encloses_the_indicated_work_analytic() -> None:
    """The work of a chamber in a turn is the integral of its pressure over the travel, times its area."""
    request = request_of("2d12", outputs=["gas"], angles={"step_deg": 1})
    gas = optimize(request).gas
    assert gas is not None
    assert len(list(indicators(request.machine, gas))) == 2
    for row, areas in zip(gas.rows, ((0.418539, 0.409035), (0.159043, 0.149540)), strict=True):
        travel = np.array([*row.displacement_m, row.displacement_m[0]])
        assert np.ptp(travel) == pytest.approx(0.28)
        for chamber, area, outward in zip(row.chambers, areas, (1.0, -1.0), strict=True):
            pressure = np.array([*chamber.pressure_Pa, chamber.pressure_Pa[0]])
            work = outward * area * np.sum(0.5 * (pressure[1:] + pressure[:-1]) * np.diff(travel))
            assert abs(work) == pytest.approx(abs(chamber.indicated_work_J), rel=2e-3)


def test_many_rows_are_not_all_drawn() -> None:
    request = request_of("2d12", outputs=["gas"], angles={"step_deg": 30})
    gas = optimize(request).gas
    assert gas is not None
    assert len(list(indicators(request.machine, gas.model_copy(update={"rows": gas.rows * 5})))) == 8


def test_heads_of_arrows_are_small_and_slender() -> None:
    """Analytic: both sides of a head are 8 px long and 30 degrees off the arrow, so that all three are alike."""
    machine, stages = stages_of("2d12")
    heads = 0
    for cell in cells(machine, stages):
        paths = [element.get("d") or "" for element in cell.iter(f"{_SVG}path")]
        areas = [path.strip("MZ").split("L") for path in paths if path.endswith("Z")]
        for corners in (area for area in areas if len(area) == 3):
            heads += 1
            tip, first_complex, second_complex = (complex(*map(float, corner.split())) for corner in corners)
            assert abs(first_complex - tip) == pytest.approx(8.0, abs=0.02)
            assert abs(second_complex - tip) == pytest.approx(8.0, abs=0.02)
            assert abs(first_complex - second_complex) == pytest.approx(8.0, abs=0.03)
    assert heads > 5
