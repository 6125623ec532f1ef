"""The lean of the rods, an effect and an output as CONTRIBUTING adds them, asked for in every way."""

import json
from math import asin, degrees
from pathlib import Path

from starlette.testclient import TestClient

import schemas
from optimizer.studies.sweep import run_chunk
from schemas.request.requests import OptimizeRequest
from schemas.sweep.request import SweepRequest
from service.app import create_app
from service.documents.examples import load
from service.settings import Settings

assert Path(schemas.__file__).parents[1] == Path.cwd()
body = {**json.loads(load("2d12")), "outputs": ["residual", "obliquity"]}
machine = OptimizeRequest.model_validate(body).machine.model_dump(mode="json")
# analytic: sin beta = r / l sin phi
ratios = [
    throw["crank_radius_m"] / row["connecting_rod"]["length_m"] for throw in machine["throws"] for row in throw["rows"]
]
expected = [degrees(asin(ratio)) for ratio in ratios]

with TestClient(create_app(Settings(), warm=False)) as client:
    answer = client.post("/v1/optimize", json=body)
    assert answer.status_code == 200, answer.text
    lean = answer.json()["obliquity"]["largest_deg"]
    assert all(abs(angle - other) < 1e-12 * other for angle, other in zip(lean, expected, strict=True)), (
        lean,
        expected,
    )
    page = client.post("/v1/report", json=body, headers={"Accept": "text/html"})
    assert page.status_code == 200
    assert "Lean of the rods" in page.text
    catalogue = client.get("/v1/effects").json()
    assert "obliquity" in [output["name"] for output in catalogue["outputs"]]
    (effect,) = (entry for entry in catalogue["effects"] if entry["name"] == "obliquity")
    assert effect["needs"] == ["kinematics"]
    use = answer.json()["effects"]["obliquity"]
    assert (use["simulated"], use["needed_by"]) == (True, ["obliquity"])
    without = client.post("/v1/optimize", json=body | {"outputs": ["kinematics"]}).json()["effects"]
    assert (without["obliquity"]["simulated"], without["kinematics"]["simulated"]) == (False, True)
    missing = json.loads(json.dumps(body))
    del missing["machine"]["throws"][0]["rows"][0]["connecting_rod"]
    refused = client.post("/v1/optimize", json=missing)
    assert refused.status_code == 422
    assert "needed by output 'obliquity'" in refused.text

path = "/machine/throws/0/crank_radius_m"
axis = {"path": path, "values": [0.1, 0.12, 0.14]}
base = {"machine": machine, "outputs": ["obliquity"]}
request = SweepRequest.model_validate({"task": "analyze", "base": base, "axes": [axis]})
rows = run_chunk(request.model_dump_json().encode(), 0, 3).to_pylist()
length = machine["throws"][0]["rows"][0]["connecting_rod"]["length_m"]
for row in rows:
    largest = max(degrees(asin(row[path] / length)), *expected[1:])
    assert abs(row["largest_obliquity_deg"] - largest) < 1e-12 * largest, row
