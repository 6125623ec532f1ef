"""The closed loop: what the service says remains is what the solids leave, by volume integrals of FreeCAD."""

import json
from typing import Any

import pytest

from tests.freecad.conftest import Run


def columns(table: list[list[Any]]) -> list[dict[str, Any]]:
    """Lines of a sheet by heading."""
    heads, *lines = table
    return [dict(zip(heads, line, strict=True)) for line in lines]


@pytest.mark.parametrize(
    ("shaft", "second_deg", "doubtful"), [("native", 180.0, 0), ("part_design", 180.0, 4), ("imported", 117.0, 0)]
)
def test_the_solids_leave_what_the_service_says(run: Run, shaft: str, second_deg: float, doubtful: int) -> None:
    process = run("loop", SHAFT=shaft)

    # what the faces show is what was drawn: analytic
    used = columns(process["tables"]["throws"])
    assert [line["use"] for line in used] == ["yes", "yes"]
    assert sum("taken for a round web" in line for line in process["doubts"]) == doubtful == len(process["doubts"])
    assert [line["crank_radius_m"] for line in used] == pytest.approx([0.14, 0.14], rel=1e-12)
    apart = abs(used[1]["crank_angle_deg"] - used[0]["crank_angle_deg"])
    assert min(apart, 360.0 - apart) == pytest.approx(second_deg, abs=1e-9)
    assert used[1]["position_m"] - used[0]["position_m"] == pytest.approx(0.35, rel=1e-12)
    webs = columns(process["tables"]["webs"])
    assert [line["envelope.thickness_m"] for line in webs] == pytest.approx([0.07] * 4, rel=1e-12)
    assert webs[3]["position_m"] - webs[0]["position_m"] == pytest.approx(0.56, rel=1e-12)

    # what remains: the service's figure and the solids'
    assert process["held"], process["words"]
    assert process["worst"] < 1e-9
    assert process["status"] == "balanced"
    answer = json.loads(process["answer"])
    assert answer["status"] == "optimal"
    fitted = {
        counterweight["web"]: counterweight
        for counterweight in answer["counterweights"]
        if counterweight["mass_kg"] > 0
    }
    assert fitted.keys() == process["solids"].keys()
    for web, solid in process["solids"].items():
        assert solid["mass_kg"] == pytest.approx(fitted[web]["mass_kg"], rel=1e-9)
        assert solid["unbalance_kg_m"] == pytest.approx(fitted[web]["mass_radius_kg_m"], rel=1e-9)
        assert solid["half_angle_deg"] == pytest.approx(fitted[web]["shape"]["half_angle_deg"], rel=1e-6)
    # and there was something to balance
    residual = answer["residual"]
    assert residual["after"]["moment"]["peak_Nm"] < 0.7 * residual["before"]["moment"]["peak_Nm"]
