"""Accuracy against time: what breaks limits is drawn as far off as it is, hollow, and named in the table."""

import json
from typing import Any

from tests.browser.portal import Portal, cells


def _row(method: str, setting: str, time_ms: float, error: float, excess: float) -> dict[str, Any]:
    figures = {"certified_gap": 1e-9, "claim_error": 0.0}
    return {
        "method": method, "setting": setting, "time_ms": time_ms, "relative_error": error, "excess": excess, **figures,
    }  # fmt: skip


#: cuts that leave out peaks are below the optimum, but beyond the limit of the goal before; they say so by their excess
_LADDER = {
    "status": "measured",
    "choices_ladder": [],
    "reference": {"resolution": 1e-10, "goals": [{"goal": "external"}]},
    "ladder": [
        _row("cuts", "0 rounds", 1.1, -0.021, 0.017),
        _row("cuts", "1 round", 1.2, -1e-3, 0.02),
        _row("service", "relative gap 1e-09", 1.3, 1e-8, 0.0),
    ],
}
_ANSWER = """{
  const own = fetch;
  const reply = () => new Response(JSON.stringify(%s), { headers: { "content-type": "application/json" } });
  globalThis.fetch = async (address, how) => String(address).endsWith("/v1/accuracy") ? reply() : own(address, how);
}"""
#: in the page: symbols and heights of the marks, and the figures at the axis of time
_MARKS = """(plot) => ({
  marks: plot.data.flatMap((trace) => trace.y.map((y, k) => [trace.marker.symbol[k].endsWith("-open"), y])),
  figures: plot.querySelectorAll(".xtick").length,
})"""


def test_what_breaks_limits_is_not_drawn_as_accurate(visit: Portal) -> None:
    portal = visit
    portal.page.add_init_script(_ANSWER % json.dumps(_LADDER))
    portal.open("2d12", ("accuracy",))
    panel = portal.panel("accuracy")
    drawing = panel.locator(".plot").evaluate(_MARKS)
    # analytic: the larger of error and excess, hollow
    assert drawing["marks"] == [[True, 0.021], [True, 0.02], [False, 1e-8]]
    # times between 1 and 2 ms have figures too
    assert drawing["figures"] > 1
    words = panel.inner_text()
    assert "Hollow marks break limits" in words
    assert "under the limits of the goals before it" in words
    panel.locator("details > summary").click()
    rows = cells(panel.locator("table"))
    assert [row[-1] for row in rows] == ["0.017", "0.02", ""]
    assert rows[-1][1] == "relative gap 1e\u221209"
