"""A triple crank in twenty variants: read as drawn and balanced, or refused with the reason.

Analytic: what was drawn is crank radius 90, webs of 22, hubs of 70 and a reach of 160 mm.
"""

from math import cos, radians
from typing import Any

import pytest

from tests.freecad.conftest import Run

#: hub and reach in mm where the web is another
SHAPES = {
    "flat-sided webs": ((70.0**2 + 70.0**2) ** 0.5, (160.0**2 + 70.0**2) ** 0.5),
    "round webs": ((120.0**2 - 40.0**2) ** 0.5, 160.0),
}
RIGHT = {
    "as drawn", "fillets", "flat-sided webs", "round webs", "tilted STEP with an oblique bore", "tapered end",
    "split pins", "hollow", "built up", "STEP in inches", "two bodies", "keyway",
}  # fmt: skip
REFUSED = {
    "without webs": "Body.Face1: 22 mm of air between it and what follows along the shaft",
    "inches read as mm": "throw 1: a rod of 400 mm is 113 times as long as its crank radius of 3.5433 mm",
    "density 7.85": "Body: its density is 7.85 kg/m3: shafts have 1000 to 20000",
    "another crank radius": "throw 1: the faces show a crank radius of 90 mm, 100 mm are described",
    "leaning flanks": "webs: no web is used",
    "a surface among solids": "Body001: a surface without volume: select solids only",
    "two shafts": "stands beside the shaft, not on it: list the faces of one shaft",
    "a bar": "there is no crank pin",
}
MASSES = {"as drawn": "73.083", "STEP in inches": "73.083", "built up": "73.083", "two bodies": "73.083"}


def test_the_others_are_refused(run: Run) -> None:
    process = run("variants", VARIANTS=";".join(REFUSED), FORCED="density 7.85")
    assert set(process["drawn"]) == RIGHT | REFUSED.keys()
    for name, words in REFUSED.items():
        assert any(words in line for line in process[name]["refused"]), (name, process[name])
        assert "held" not in process[name], name
    assert any("leans by 3 degrees" in line for line in process["leaning flanks"]["doubts"]), process["leaning flanks"]
    # what is forced says so, in the verdict and in the status
    why = "FORCED in spite of: Body: its density is 7.85 kg/m3: shafts have 1000 to 20000"
    forced = process["forced"]
    assert forced["held"]
    assert forced["words"][1].startswith(why)
    assert why in forced["status"]


#: each of another kind of solid or of shape
_DAILY = {"as drawn", "round webs", "tilted STEP with an oblique bore", "split pins", "built up"}


@pytest.mark.parametrize("names", [_DAILY, pytest.param(RIGHT, marks=pytest.mark.nightly)], ids=["some", "all"])
def test_most_are_right(run: Run, names: set[str]) -> None:
    process = run("variants", VARIANTS=";".join(names), FORCED="")
    for name in names:
        _as_drawn(name, process[name])
    assert any(line.startswith("Warning: ") for line in process["as drawn"]["words"])


def _as_drawn(name: str, machine: dict[str, Any]) -> None:
    assert machine.get("held"), (name, machine)
    assert [web["use"] for web in machine["webs"]] == ["yes"] * 6, name
    hub, reach = SHAPES.get(name, (70.0, 160.0))
    for number, web in enumerate(machine["webs"]):
        if name == "split pins" and number == 3:
            # drawn towards the other pin: a flat side of it is 30 degrees off
            assert 1e3 * web["envelope.inner_radius_m"] == pytest.approx(70.0 / cos(radians(30.0)), rel=1e-9)
            continue
        assert 1e3 * web["envelope.thickness_m"] == pytest.approx(22.0, rel=1e-9), name
        assert 1e3 * web["envelope.inner_radius_m"] == pytest.approx(hub, rel=1e-9), name
        assert 1e3 * web["envelope.outer_radius_m"] == pytest.approx(reach, rel=1e-9), name
    cranks = [throw["crank_angle_deg"] % 360 for throw in machine["throws"]]
    apart = [(angle - cranks[0]) % 360 for angle in cranks]
    expected = [0.0, 120.0, 150.0, 240.0] if name == "split pins" else [0.0, 120.0, 240.0]
    backwards = [0.0, 240.0, 120.0]
    assert any(apart == pytest.approx(backwards, abs=1e-6) for backwards in (expected, backwards)), (name, apart)
    assert [throw["crank_radius_m"] for throw in machine["throws"]] == pytest.approx([0.09] * len(cranks), rel=1e-9)
    assert machine["words"][0].startswith("HELD: "), name
    # no figure of the verdict is what rounding leaves of zero
    assert "e-" not in machine["words"][0], machine["words"][0]
    assert MASSES.get(name, "") in machine["said"], machine["said"]
