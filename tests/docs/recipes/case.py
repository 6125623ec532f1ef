"""A band of speeds, as CONTRIBUTING adds it, asked for in every way."""

from math import pi

from starlette.testclient import TestClient

from optimizer.studies.sweep import run_chunk
from schemas.sweep.request import SweepRequest
from service.app import create_app
from service.settings import Settings

# a rotating unbalance of 1 kg m, and a web in its plane that takes 0.4 of that
throw = {"position_m": 0, "crank_radius_m": 0.1, "crank_angle_deg": 0, "rotating_mass_kg": 10, "rows": []}
web = {"name": "w", "position_m": 0, "counterweight_radius_m": 0.2, "max_mass_kg": 2, "throw": 0}
machine = {"kind": "reciprocating", "speed_rpm": 600, "throws": [throw], "webs": [web]}
band, fast = {"lowest_rpm": 300, "highest_rpm": 900}, (30 * pi) ** 2
row = {"axis_deg": 90, "reciprocating_mass_kg": 8, "connecting_rod": {"length_m": 0.35}}
bearings = [
    {"name": name, "position_m": place, "diameter_m": 0.1, "length_m": 0.1} for name, place in (("a", -0.3), ("b", 0.3))
]
piston = {**machine, "throws": [throw | {"rows": [row]}], "bearings": bearings}
chosen = machine | {"catalogue": {"masses_kg": [1.5, 3], "angle_step_deg": 30}}
ends = [{"name": name, "changes": [{"path": "/machine/speed_rpm", "value": band[name]}]} for name in band]


def near(figure, expected, size=fast):
    assert abs(figure - expected) < 2e-6 * size, (figure, expected)


with TestClient(create_app(Settings(), warm=False)) as client:

    def ask(machine, status="optimal", **more):
        body = {"machine": machine, **more}
        answer = client.post("/v1/optimize", json=body)
        assert answer.status_code == 200, answer.text
        document = answer.json()
        assert document["status"] == status, document
        claims = client.post("/v1/verify", json={"request": body, "answer": document}).json()
        assert claims["verdict"] != "broken", claims
        return document, claims["not_covered"]

    def refused(path, body, pointer):
        answer = client.post(path, json=body)
        assert (answer.status_code, answer.json()["errors"][0]["pointer"]) == (422, pointer), answer.text

    # analytic: the largest force is that of the highest speed
    optimum, missed = ask(machine, speed_band=band)
    near(optimum["worst_case"]["objective"], 0.6 * fast)
    near(optimum["certificate"]["objective"], 0.6 * fast)
    near(optimum["price_of_robustness"]["nominal"], 0.6 * (20 * pi) ** 2)
    assert not missed, missed
    rows = {row["name"]: row["value"] for row in optimum["certificate"]["multipliers"]["objective"]["rows"]}
    near(rows["sum in speed_band highest_rpm"], 1.0, 1.0)
    # analytic: 0.3 of 1 kg m are chosen
    optimum, _ = ask(chosen, speed_band=band)
    near(optimum["worst_case"]["objective"], 0.7 * fast)
    # analytic: what is off adds 0.001 kg m
    optimum, _ = ask(machine, speed_band=band, tolerances={"unbalance_kg_m": 0.001})
    near(optimum["worst_case"]["objective"], 0.601 * fast)
    # analytic: the slow end keeps a ceiling that the fast end cannot
    optimum, _ = ask(machine, "infeasible", speed_band=band, objective={"force_ceiling_N": 0.5 * fast})
    why = optimum["infeasibility"]
    assert why["scenarios"] == ["speed_band highest_rpm"], why
    near(why["smallest_force_N"], 0.6 * fast)
    # metamorphic: whatever is asked for, it is two scenarios
    for more in (
        {"objective": {"orders": "all"}},
        {"objective": {"bearing_weight": 1}},
        {"objective": {"force_weight": 0, "bending_weight": 1}, "tolerances": {"reciprocating_mass_relative": 0.1}},
        {"objective": {"priorities": [{"goal": "external", "allowance": 0.1}, {"goal": "mass"}]}},
    ):
        both = ({"speed_band": band}, {"scenarios": ends})
        near(*(ask(piston, **fields, **more)[0]["worst_case"]["objective"] for fields in both), 3 * fast)
    # beside scenarios it is two more cases, and no two have one name
    three = [{"name": "faster still", "changes": [{"path": "/machine/speed_rpm", "value": 1200}]}]
    optimum, _ = ask(machine, speed_band=band, scenarios=three)
    near(optimum["worst_case"]["objective"], 0.6 * (40 * pi) ** 2, 2 * fast)
    taken = [three[0] | {"name": "speed_band lowest_rpm"}]
    refused("/v1/optimize", {"machine": machine, "speed_band": band, "scenarios": taken}, "/speed_band")
    refused("/v1/optimize", {"machine": machine, "speed_band": band | {"lowest_rpm": 900}}, "/speed_band/highest_rpm")
    slow = machine | {"overspeed_rpm": 800}
    refused("/v1/optimize", {"machine": slow, "speed_band": band}, "/speed_band")
    ladder = client.post("/v1/accuracy", json={"machine": machine, "speed_band": band, "repeats": 1}).json()
    near(ladder["reference"]["objective"], 0.6 * fast)
    alone = [row["setting"] for row in ladder["ladder"] if row["method"] == "one_scenario"]
    assert alone == ["scenario speed_band lowest_rpm", "scenario speed_band highest_rpm"], alone
    # analytic: force and moment are both smallest at 0.4 kg m
    body = {"machine": machine, "speed_band": band, "multipliers": True}
    traded = client.post("/v1/pareto", json=body).json()
    (point,) = traded["fronts"][0]["points"]
    near(point["weighted_force_peak_N"], 0.6 * fast)
    near(point["worst_case"]["force_peak_N"], 0.6 * fast)
    claims = client.post("/v1/verify", json={"request": body, "answer": traded}).json()
    assert claims["verdict"] == "held", claims
    steps = {"mass_step_kg": 0.5, "angle_step_deg": 30}
    rounded = client.post("/v1/round", json={"request": {"machine": machine, "speed_band": band}, **steps})
    assert rounded.status_code == 200, rounded.text
    near(rounded.json()["rounding"]["optimum"]["objective"], 0.6 * fast)
    page = client.post("/v1/report", json={"machine": machine, "speed_band": band}, headers={"Accept": "text/html"})
    assert page.status_code == 200, page.text
    assert "speed_band highest_rpm" in page.text, page.text[:500]
    schema = client.get("/openapi.json").json()["components"]["schemas"]["OptimizeRequest"]["properties"]
    assert schema["speed_band"]["x-group"] == schema["scenarios"]["x-group"]

# a row of a sweep has the largest force of its band, whatever the speed of its design
axis = {"path": "/machine/speed_rpm", "values": [500, 600]}
sent = SweepRequest.model_validate({"base": {"machine": machine, "speed_band": band}, "axes": [axis]})
for entry in run_chunk(sent.model_dump_json().encode(), 0, 2).to_pylist():
    near(entry["worst_case_force_peak_N"], 0.6 * fast)
