"""The largest unbalance of a web, a limit as CONTRIBUTING adds it, asked for in every way."""

from math import pi

from starlette.testclient import TestClient

from optimizer.studies.sweep import run_chunk
from schemas.sweep.request import SweepRequest
from service.app import create_app
from service.settings import Settings

throw = {"position_m": 0, "crank_radius_m": 0.1, "crank_angle_deg": 30, "rotating_mass_kg": 10, "rows": []}
web = {"name": "w", "position_m": 0, "counterweight_radius_m": 0.2, "max_mass_kg": 20, "max_unbalance_kg_m": 0.4}
machine = {"kind": "reciprocating", "speed_rpm": 600, "throws": [throw], "webs": [web]}
body, square = {"machine": machine}, (20 * pi) ** 2
with TestClient(create_app(Settings(), warm=False)) as client:
    answer = client.post("/v1/optimize", json=body).json()
    (fitted,), (price,) = answer["counterweights"], answer["shadow_prices"]
    # analytic: the rotating mass pulls with 1 kg m, and the counterweight takes 0.4 of that
    assert answer["status"] == "optimal", answer
    assert abs(answer["certificate"]["objective"] - 0.6 * square) < 1.1e-6 * square, answer
    assert fitted["active_limits"] == ["max_unbalance"], fitted
    assert (price["limit"], price["web"], price["unit"]) == ("max_unbalance", "w", "N/(kg m)"), price
    assert abs(price["value"] - square) < 1e-6 * square, price
    refused = client.post("/v1/optimize", json={"machine": machine | {"webs": [web | {"max_unbalance_kg_m": -1}]}})
    assert (refused.status_code, refused.json()["errors"][0]["pointer"]) == (
        422,
        "/machine/webs/0/max_unbalance_kg_m",
    )
    page = client.post("/v1/report", json=body, headers={"Accept": "text/html"})
    assert page.status_code == 200
    assert "largest unbalance" in page.text

axis = {"path": "/machine/webs/0/max_unbalance_kg_m", "values": [0.1, 0.3, 0.5]}
request = SweepRequest.model_validate({"task": "optimize", "base": body, "axes": [axis]})
for row in run_chunk(request.model_dump_json().encode(), 0, 3).to_pylist():
    assert abs(row["objective"] - square * (1 - row[axis["path"]])) < 1.1e-6 * square, row
