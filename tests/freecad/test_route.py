"""POST /v1/shaft against the workbench: its integrals of the solids are the unbalance that the bodies show."""

import pytest

from tests.freecad.conftest import Run


def test_the_route_says_what_the_solids_do(run: Run) -> None:
    for kind, entry in run("routes").items():
        answer, (mass, x, y) = entry["answer"], entry["own"]
        scale = mass * 0.14
        planes = answer["unbalances"]
        # independent: volume integrals in the frame of the shaft, against tensors in that of the document
        assert answer["rotor"]["mass_kg"] == pytest.approx(mass, rel=1e-12), kind
        assert sum(plane["x_kg_m"] for plane in planes) == pytest.approx(x, abs=1e-9 * scale), kind
        assert sum(plane["y_kg_m"] for plane in planes) == pytest.approx(y, abs=1e-9 * scale), kind
        couple = [sum(plane["position_m"] * plane[f"{axis}_kg_m"] for plane in planes) for axis in "xy"]
        assert couple == pytest.approx(entry["own couple"], abs=1e-9 * scale), kind
        for name in ("origin_m", "x", "y", "z"):
            assert entry["alone"]["frame"][name] == pytest.approx(answer["frame"][name], abs=1e-9), (kind, name)
        assert [throw["crank_radius_m"] for throw in answer["throws"]] == pytest.approx([0.14, 0.14], rel=1e-9)
        assert not any(doubt["serious"] for doubt in answer["doubts"])
