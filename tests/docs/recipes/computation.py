"""The speed of pistons, a computation as CONTRIBUTING adds it, asked for in every way."""

import sys
import time
from pathlib import Path

from starlette.testclient import TestClient

from service.app import create_app
from service.settings import Settings

path, body = "/v1/piston-speed", {"stroke_m": 0.28, "speed_rpm": 500}
with TestClient(create_app(Settings(data_dir=Path(sys.argv[1])), warm=False)) as client:
    now = client.post(path, json=body)
    # analytic: two strokes in a turn
    assert (now.status_code, abs(now.json()["mean_m_s"] - 2 * 0.28 * 500 / 60) < 1e-12) == (200, True), now.text
    refused = client.post(path, json=body | {"speed_rpm": 0})
    assert (refused.status_code, refused.json()["errors"][0]["pointer"]) == (422, "/speed_rpm")
    later = client.post(path, json=body, headers={"Prefer": "respond-async"})
    assert later.status_code == 202, later.text
    patience = time.monotonic() + 240
    while (state := client.get(later.headers["location"]).json())["state"] in ("queued", "running"):
        assert time.monotonic() < patience, state
        time.sleep(0.05)
    assert state["state"] == "done", state
    assert client.get(state["links"]["results"]).json() == now.json()
    metrics = client.get("/metrics").text
    assert 'counterweight_computation_seconds_count{computation="piston_speed"} 1.0' in metrics
    operation = client.get("/openapi.json").json()["paths"][path]["post"]
    assert (operation["operationId"], operation["summary"]) == ("piston_speed", "Mean speed of pistons")
    page = Path("docs/api.md").read_text()
    assert "`POST " + path + "`" in page
