"""Castings that are there, as CONTRIBUTING adds them, asked for in every way and held against every set by hand."""

from itertools import product

from starlette.testclient import TestClient

from optimizer.studies.sweep import run_chunk
from schemas.sweep.request import SweepRequest
from service.app import create_app
from service.settings import Settings

row = {"axis_deg": 90, "reciprocating_mass_kg": 20, "connecting_rod": {"length_m": 0.35}}
throws = [
    {"position_m": place, "crank_radius_m": 0.1, "crank_angle_deg": angle, "rotating_mass_kg": 9, "rows": [row]}
    for place, angle in ((-0.3, 0), (0.3, 90))
]
castings = [
    [{"mass_kg": mass, "angle_deg": angle} for mass, angle in own]
    for own in (((8, 180), (12, 210), (15, 150)), ((8, 270), (14, 300), (9, 225)))
]
webs = [
    {
        "name": name, "position_m": where, "throw": n, "counterweight_radius_m": 0.12, "max_mass_kg": 14.5,
        "castings": own,
    }
    for n, (name, where, own) in enumerate(zip("ab", (-0.4, 0.4), castings, strict=True))
]  # fmt: skip
bearings = [{"name": name, "position_m": where} for name, where in (("l", -0.6), ("r", 0.6))]
machine = {"kind": "reciprocating", "speed_rpm": 600, "throws": throws, "webs": webs, "bearings": bearings}
#: the heaviest is beyond the limit of its web
options = [[None, *(counterweight for counterweight in own if counterweight["mass_kg"] <= 14.5)] for own in castings]

with TestClient(create_app(Settings(), warm=False)) as client:

    def post(path, body, code=200):
        answer = client.post(path, json=body)
        assert answer.status_code == code, answer.text
        return answer.json()

    def refused(path, body, pointer):
        problems = post(path, body, 422)["errors"]
        assert pointer in [problem["pointer"] for problem in problems], problems

    def ask(machine, **more):
        body = {"machine": machine, "accuracy": {"time_limit_s": 30}, **more}
        response = post("/v1/optimize", body)
        assert response["status"] == "optimal", response
        claims = post("/v1/verify", {"request": body, "answer": response})
        assert claims["verdict"] != "broken", claims
        return response

    def objective(answer):
        return answer["certificate"]["objective"]

    def by_hand(machine, **more):
        """Answers with every set of castings fitted."""
        for some in product(*options):
            fixed = [
                {name: value for name, value in web.items() if name not in ("castings", "max_mass_kg")}
                | {"fixed": table or {"mass_kg": 0, "angle_deg": 0}}
                for web, table in zip(machine["webs"], some, strict=True)
            ]
            yield some, post("/v1/optimize", {"machine": machine | {"webs": fixed}, **more})

    # independent: every set of castings, each fitted by hand
    optimum, every = ask(machine), list(by_hand(machine))
    least = min(objective(answer) for _, answer in every)
    assert abs(objective(optimum) - least) < 1e-9 * least, (objective(optimum), least)
    for fitted, own in zip(optimum["counterweights"], castings, strict=True):
        assert fitted["mass_kg"] == 0 or {"mass_kg": fitted["mass_kg"], "angle_deg": fitted["angle_deg"]} in own, fitted
    peak = optimum["residual"]["after"]["moment"]["peak_Nm"]
    for goal in (
        {"orders": "all"},
        {"bearing_weight": 1},
        {"moment_weight": 0, "moment_ceiling_Nm": 1.02 * peak},
    ):
        least = min(
            objective(answer) for _, answer in by_hand(machine, objective=goal) if answer["status"] != "infeasible"
        )
        reached = objective(ask(machine, objective=goal))
        assert abs(reached - least) < 2e-6 * least, (goal, reached, least)
    light = [
        objective(value)
        for some, value in every
        if sum(counterweight["mass_kg"] for counterweight in some if counterweight) <= 18
    ]
    least, reached = min(light), objective(ask(machine | {"max_total_mass_kg": 18}))
    assert abs(reached - least) < 1e-9 * least, (reached, least)
    faster = [{"name": "faster", "changes": [{"path": "/machine/speed_rpm", "value": 700}]}]
    for more in ({"scenarios": faster}, {"tolerances": {"unbalance_kg_m": 0.01}}):
        least = min(answer["worst_case"]["objective"] for _, answer in by_hand(machine, **more))
        reached = ask(machine, **more)["worst_case"]["objective"]
        assert abs(reached - least) < 2e-6 * least, (more, reached, least)
    most = objective(optimum) + 0.3 * optimum["certificate"]["objective_without_counterweights"]
    fewest = min(sum(value is not None for value in some) for some, value in every if objective(value) <= most)
    few = ask(machine, objective={"priorities": [{"goal": "external", "allowance": 0.3}, {"goal": "pieces"}]})
    assert sum(counterweight["mass_kg"] > 0 for counterweight in few["counterweights"]) == fewest, (
        fewest,
        few["counterweights"],
    )

    # equal castings: in the same places on their own cranks
    turned = [table | {"angle_deg": table["angle_deg"] + 90} for table in castings[0]]
    groups = [{"name": "g", "webs": ["a", "b"]}]
    alike = machine | {"webs": [webs[0], webs[1] | {"castings": turned}], "web_groups": groups}
    first, second = ask(alike)["counterweights"]
    assert first["mass_kg"] == second["mass_kg"], (first, second)
    refused("/v1/optimize", {"machine": machine | {"web_groups": groups}}, "/machine/web_groups/0/webs/1")

    # studies
    front = post("/v1/pareto", {"machine": machine, "counts": {"of": "weights", "least": "objective"}})
    assert front["counts"], front
    ladder = post("/v1/accuracy", {"machine": machine, "repeats": 1})
    assert ladder["choices_ladder"], ladder
    parts = {
        "class": "piston",
        "names": ["p", "q"],
        "masses_kg": [1, 2],
        "rows": [{"throw": n, "row": 0} for n in (0, 1)],
    }
    assert post("/v1/match", {"machine": machine, "parts": [parts], "choose_counterweights": True})["assignments"]
    page = client.post("/v1/report", json={"machine": machine}, headers={"Accept": "text/html"})
    assert page.status_code == 200, page.text
    assert "8 at 180, 12 at 210, 15 at 150" in page.text, page.text[:500]

    # what does not go together says so
    for fields, name in (
        ({"castings": []}, "castings"),
        ({"hole_angles_deg": [180]}, "hole_angles_deg"),
        ({"sector": {"centre_deg": 180, "half_angle_deg": 25}}, "castings/1/angle_deg"),
        ({"fixed": {"mass_kg": 1, "angle_deg": 0}}, "castings"),
    ):
        refused("/v1/optimize", {"machine": machine | {"webs": [webs[0] | fields, webs[1]]}}, f"/machine/webs/0/{name}")
    steps = {"mass_step_kg": 0.5, "angle_step_deg": 30}
    refused("/v1/round", {"request": {"machine": machine}, **steps}, "/request/machine/webs/0/castings")

axis = {"path": "/machine/speed_rpm", "values": [300, 600]}
request = SweepRequest.model_validate({"base": {"machine": machine}, "axes": [axis]})
slow, fast = run_chunk(request.model_dump_json().encode(), 0, 2).to_pylist()
# analytic: with the square of the speed
assert abs(fast["objective"] - objective(optimum)) < 1e-9 * objective(optimum), fast
assert abs(slow["objective"] - objective(optimum) / 4) < 1e-9 * objective(optimum), slow
