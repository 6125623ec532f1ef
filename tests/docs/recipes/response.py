"""The couple about a flange, a response as CONTRIBUTING adds it, asked for in every way."""

from math import pi

from starlette.testclient import TestClient

from optimizer.studies.sweep import run_chunk
from schemas.sweep.request import SweepRequest
from service.app import create_app
from service.settings import Settings

# a rotating unbalance of 1 kg m in the plane 0, a web 0.2 m behind it, and a flange 0.7 m before it
throw = {"position_m": 0, "crank_radius_m": 0.1, "crank_angle_deg": 30, "rotating_mass_kg": 10, "rows": []}
web = {"name": "w", "position_m": -0.2, "counterweight_radius_m": 0.2, "max_mass_kg": 2}
plain = {"kind": "reciprocating", "speed_rpm": 600, "throws": [throw], "webs": [web], "reference_plane_m": 0.1}
free = {**plain, "webs": [web | {"max_mass_kg": 20}]}
square, alone = (20 * pi) ** 2, {"force_weight": 0, "moment_weight": 0, "flange_position_m": 0.7}


def near(figure, expected, size=square):
    assert abs(figure - expected) < 2e-6 * size, (figure, expected)


with TestClient(create_app(Settings(), warm=False)) as client:

    def ask(machine, objective, status="optimal", path="/v1/optimize", **more):
        body = {"machine": machine, "objective": objective, **more}
        answer = client.post(path, json=body)
        assert answer.status_code == 200, answer.text
        document = answer.json()
        assert document["status"] == status, document
        checked = client.post("/v1/verify", json={"request": body, "answer": document})
        assert checked.status_code == 200, checked.text
        claims = checked.json()
        broken = [claim for claim in claims["claims"] if claim["verdict"] == "broken"]
        assert claims["verdict"] != "broken", broken
        return document, claims["not_covered"]

    # analytic: the couple about the flange is 0.7 kg m2 less 0.9 m times the counterweight, of 0.4 kg m here
    answer, missed = ask(plain, alone | {"flange_weight": 1})
    near(answer["certificate"]["objective"], 0.34 * square)
    assert not missed, missed
    (change,) = answer["residual"]["responses"]
    assert (change["response"], change["label"], change["unit"]) == ("flange", "couple about the flange", "N m")
    near(change["before"], 0.7 * square)
    near(change["after"], 0.34 * square)
    limits = {price["limit"]: price for price in answer["shadow_prices"]}
    near(limits["max_mass"]["value"], 0.9 * 0.2 * square)
    assert limits["max_mass"]["unit"] == "N m/kg", limits

    # analytic: the force of 1 kg m is taken off as far as the couple may fall below 0, to -0.1
    limited = {"moment_weight": 0, "flange_position_m": 0.7, "flange_ceiling_Nm": 0.1 * square}
    answer, missed = ask(free, limited)
    near(answer["certificate"]["objective"], square * (1 - 0.8 / 0.9))
    near(answer["residual"]["responses"][0]["after"], 0.1 * square)
    assert (answer["active_limits"], missed) == (["flange_ceiling"], []), (answer["active_limits"], missed)

    # analytic: the least that 0.4 kg m leave
    answer, missed = ask(plain, limited, "infeasible")
    why = answer["infeasibility"]
    assert (why["conflict"], missed) == (["flange_ceiling_Nm"], []), (why, missed)
    near(why["smallest"][0]["smallest"], 0.34 * square)
    near(why["closest"]["responses"][0]["peak"], 0.34 * square)
    for body in (limited, alone | {"flange_weight": 1}):
        page = client.post("/v1/report", json={"machine": plain, "objective": body}, headers={"Accept": "text/html"})
        assert page.status_code == 200
        assert "couple about the flange" in page.text, page.text[:500]
    assert client.post("/v1/report", json={"machine": plain, "objective": limited}).status_code == 200

    # metamorphic: of forces in one plane the couple about another is their sum times the distance
    row = {"axis_deg": 90, "reciprocating_mass_kg": 8, "connecting_rod": {"length_m": 0.35}}
    piston = {**free, "throws": [throw | {"rows": [row]}], "webs": [web | {"position_m": 0, "max_mass_kg": 20}]}
    faster = [{"name": "faster", "changes": [{"path": "/machine/speed_rpm", "value": 700}]}]
    for goal, more in (
        ({"orders": "all"}, {}),
        ({}, {"tolerances": {"mass_relative": 0.02, "angle_deg": 2}}),
        ({}, {"tolerances": {"reciprocating_mass_relative": 0.1}}),
        ({"orders": "all"}, {"tolerances": {"reciprocating_mass_relative": 0.1}}),
        ({}, {"scenarios": faster}),
        ({"direction_weights": {"x": 1, "y": 0.3}}, {}),
    ):
        couple, _ = ask(piston, alone | {"flange_weight": 1} | goal, **more)
        force, _ = ask(piston, {"moment_weight": 0} | goal, **more)
        objective, other = (document["certificate"]["objective"] for document in (couple, force))
        near(objective, 0.7 * other, 3 * square)
        if more:
            (worst,) = couple["worst_case"]["responses"]
            near(worst["peak"], 0.7 * couple["worst_case"]["force_peak_N"], 3 * square)
        elif goal == {"orders": "all"}:
            (change,) = couple["residual"]["responses"]
            near(change["turn_after"], objective, 3 * square)
    couple, _ = ask(piston, alone | {"flange_weight": 1, "orders": "all", "flange_ceiling_Nm": 1}, "infeasible")
    assert couple["infeasibility"]["conflict"] == ["flange_ceiling_Nm"], couple["infeasibility"]

    # analytic: between no force at 1 kg m and no couple at 0.7/0.9 both rise and fall in proportion
    front, _ = ask(free, {"flange_position_m": 0.7}, path="/v1/pareto", points=3, responses=["force", "flange"])
    (traded,) = front["trades"]
    assert [response["response"] for response in traded["responses"]] == ["force", "flange"]
    for point in traded["points"]:
        force, couple = point["values"]
        near(couple, 0.2 * square - 0.9 * force)

axis = {"path": "/objective/flange_position_m", "values": [0.6, 0.7, 0.8]}
base = {"machine": plain, "objective": alone | {"flange_weight": 1}}
request = SweepRequest.model_validate({"task": "optimize", "base": base, "axes": [axis]})
for row in run_chunk(request.model_dump_json().encode(), 0, 3).to_pylist():
    left = square * (row[axis["path"]] - 0.4 * (row[axis["path"]] + 0.2))
    near(row["objective"], left)
    near(row["flange_peak_Nm"], left)
limited = {"moment_weight": 0, "flange_position_m": 0.7}
weighed = {"path": "/objective/flange_weight", "values": [0.0, 1.0]}
request = SweepRequest.model_validate({"base": base | {"objective": limited}, "axes": [weighed]})
for row in run_chunk(request.model_dump_json().encode(), 0, 2).to_pylist():
    near(row["flange_peak_Nm"], 0.34 * square)
