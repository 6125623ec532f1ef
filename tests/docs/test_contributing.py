"""What CONTRIBUTING tells a newcomer to write, written into a copy of the packages and asked for in every way."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.commands import run
from tests.docs.reading import ROOT, section

_STEP = re.compile(
    r"`(?P<file>[\w./]+)`,\s(?:new|above\sthe\sline\s(?P<tick>`+)(?P<line>.+?)(?P=tick)):\n\n"
    r"```\w+\n(?P<block>.*?)```\n",
    re.DOTALL,
)
_NUMBERS = ("One", "Two", "Three", "Four", "Five", "Six", "Seven")
_SCRIPT = """
import json, time
from math import asin, degrees
from pathlib import Path

import schemas
from optimizer.studies.sweep import run_chunk
from schemas.request.requests import OptimizeRequest
from schemas.sweep.request import SweepRequest
from service.app import create_app
from service.documents.examples import load
from service.settings import Settings
from starlette.testclient import TestClient

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
    found = answer.json()["obliquity"]["largest_deg"]
    assert all(abs(one - other) < 1e-12 * other for one, other in zip(found, expected, strict=True)), (found, expected)
    page = client.post("/v1/report", json=body, headers={"Accept": "text/html"})
    assert page.status_code == 200 and "Lean of the rods" in page.text
    catalogue = client.get("/v1/effects").json()
    assert "obliquity" in [one["name"] for one in catalogue["outputs"]]
    (effect,) = (one for one in catalogue["effects"] if one["name"] == "obliquity")
    assert effect["needs"] == ["kinematics"]
    use = answer.json()["effects"]["obliquity"]
    assert (use["simulated"], use["needed_by"]) == (True, ["obliquity"])
    without = client.post("/v1/optimize", json=body | {"outputs": ["kinematics"]}).json()["effects"]
    assert (without["obliquity"]["simulated"], without["kinematics"]["simulated"]) == (False, True)
    missing = json.loads(json.dumps(body))
    del missing["machine"]["throws"][0]["rows"][0]["connecting_rod"]
    refused = client.post("/v1/optimize", json=missing)
    assert refused.status_code == 422 and "needed by output 'obliquity'" in refused.text

path = "/machine/throws/0/crank_radius_m"
axis = {"path": path, "values": [0.1, 0.12, 0.14]}
base = {"machine": machine, "outputs": ["obliquity"]}
request = SweepRequest.model_validate({"task": "analyze", "base": base, "axes": [axis]})
rows = run_chunk(request.model_dump_json().encode(), 0, 3).to_pylist()
length = machine["throws"][0]["rows"][0]["connecting_rod"]["length_m"]
for row in rows:
    largest = max(degrees(asin(row[path] / length)), *expected[1:])
    assert abs(row["largest_obliquity_deg"] - largest) < 1e-12 * largest, row
"""


_COMPUTED = """
import sys, time
from pathlib import Path

from service.app import create_app
from service.settings import Settings
from starlette.testclient import TestClient

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
    told = client.get("/metrics").text
    assert 'counterweight_computation_seconds_count{computation="piston_speed"} 1.0' in told
    operation = client.get("/openapi.json").json()["paths"][path]["post"]
    assert (operation["operationId"], operation["summary"]) == ("piston_speed", "Mean speed of pistons")
    listed = Path("docs/api.md").read_text()
    assert "`POST " + path + "`" in listed
"""
_LIMITED = """
import json
from math import pi

from optimizer.studies.sweep import run_chunk
from schemas.sweep.request import SweepRequest
from service.app import create_app
from service.settings import Settings
from starlette.testclient import TestClient

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
        422, "/machine/webs/0/max_unbalance_kg_m",
    )
    page = client.post("/v1/report", json=body, headers={"Accept": "text/html"})
    assert page.status_code == 200 and "largest unbalance" in page.text

axis = {"path": "/machine/webs/0/max_unbalance_kg_m", "values": [0.1, 0.3, 0.5]}
request = SweepRequest.model_validate({"task": "optimize", "base": body, "axes": [axis]})
for row in run_chunk(request.model_dump_json().encode(), 0, 3).to_pylist():
    assert abs(row["objective"] - square * (1 - row[axis["path"]])) < 1.1e-6 * square, row
"""
_RESPONDED = """
import json
from math import pi

from optimizer.studies.sweep import run_chunk
from schemas.sweep.request import SweepRequest
from service.app import create_app
from service.settings import Settings
from starlette.testclient import TestClient

# a rotating unbalance of 1 kg m in the plane 0, a web 0.2 m behind it, and a flange 0.7 m before it
throw = {"position_m": 0, "crank_radius_m": 0.1, "crank_angle_deg": 30, "rotating_mass_kg": 10, "rows": []}
web = {"name": "w", "position_m": -0.2, "counterweight_radius_m": 0.2, "max_mass_kg": 2}
plain = {"kind": "reciprocating", "speed_rpm": 600, "throws": [throw], "webs": [web], "reference_plane_m": 0.1}
free = {**plain, "webs": [web | {"max_mass_kg": 20}]}
square, alone = (20 * pi) ** 2, {"force_weight": 0, "moment_weight": 0, "flange_position_m": 0.7}


def near(found, expected, size=square):
    assert abs(found - expected) < 2e-6 * size, (found, expected)


with TestClient(create_app(Settings(), warm=False)) as client:

    def ask(machine, objective, status="optimal", path="/v1/optimize", **more):
        body = {"machine": machine, "objective": objective, **more}
        answer = client.post(path, json=body)
        assert answer.status_code == 200, answer.text
        found = answer.json()
        assert found["status"] == status, found
        checked = client.post("/v1/verify", json={"request": body, "answer": found})
        assert checked.status_code == 200, checked.text
        claims = checked.json()
        broken = [one for one in claims["claims"] if one["verdict"] == "broken"]
        assert claims["verdict"] != "broken", broken
        return found, claims["not_covered"]

    # analytic: the couple about the flange is 0.7 kg m2 less 0.9 m times the counterweight, of 0.4 kg m here
    found, missed = ask(plain, alone | {"flange_weight": 1})
    near(found["certificate"]["objective"], 0.34 * square)
    assert not missed, missed
    (change,) = found["residual"]["responses"]
    assert (change["response"], change["label"], change["unit"]) == ("flange", "couple about the flange", "N m")
    near(change["before"], 0.7 * square)
    near(change["after"], 0.34 * square)
    limits = {one["limit"]: one for one in found["shadow_prices"]}
    near(limits["max_mass"]["value"], 0.9 * 0.2 * square)
    assert limits["max_mass"]["unit"] == "N m/kg", limits

    # analytic: the force of 1 kg m is taken off as far as the couple may fall below 0, to -0.1
    limited = {"moment_weight": 0, "flange_position_m": 0.7, "flange_ceiling_Nm": 0.1 * square}
    found, missed = ask(free, limited)
    near(found["certificate"]["objective"], square * (1 - 0.8 / 0.9))
    near(found["residual"]["responses"][0]["after"], 0.1 * square)
    assert (found["active_limits"], missed) == (["flange_ceiling"], []), (found["active_limits"], missed)

    # analytic: the least that 0.4 kg m leave
    found, missed = ask(plain, limited, "infeasible")
    why = found["infeasibility"]
    assert (why["conflict"], missed) == (["flange_ceiling_Nm"], []), (why, missed)
    near(why["smallest"][0]["smallest"], 0.34 * square)
    near(why["closest"]["responses"][0]["peak"], 0.34 * square)
    for body in (limited, alone | {"flange_weight": 1}):
        page = client.post(
            "/v1/report", json={"machine": plain, "objective": body}, headers={"Accept": "text/html"}
        )
        assert page.status_code == 200 and "couple about the flange" in page.text, page.text[:500]
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
        one, other = (each["certificate"]["objective"] for each in (couple, force))
        near(one, 0.7 * other, 3 * square)
        if more:
            (worst,) = couple["worst_case"]["responses"]
            near(worst["peak"], 0.7 * couple["worst_case"]["force_peak_N"], 3 * square)
        elif goal == {"orders": "all"}:
            (change,) = couple["residual"]["responses"]
            near(change["turn_after"], one, 3 * square)
    couple, _ = ask(piston, alone | {"flange_weight": 1, "orders": "all", "flange_ceiling_Nm": 1}, "infeasible")
    assert couple["infeasibility"]["conflict"] == ["flange_ceiling_Nm"], couple["infeasibility"]

    # analytic: between no force at 1 kg m and no couple at 0.7/0.9 both rise and fall in proportion
    front, _ = ask(
        free, {"flange_position_m": 0.7}, path="/v1/pareto", points=3, responses=["force", "flange"]
    )
    (traded,) = front["trades"]
    assert [each["response"] for each in traded["responses"]] == ["force", "flange"]
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
"""
#: what is asked of a copy, a file for each of the later recipes
RECIPES = ROOT / "tests" / "docs" / "recipes"
#: tests that read what the entries say
_OTHERS = ("schemas", "effects", "service", "clients", "studies/sweep", "docs", "verification")
_PACKAGES = ("schemas", "optimizer", "service")
_ADDED = ("An effect", "An output", "A computation", "A limit", "A response", "A case", "A kind of choice")


@pytest.fixture(scope="module")
def steps() -> list[re.Match[str]]:
    text = "".join(section("CONTRIBUTING.md", heading) for heading in _ADDED)
    matches = list(_STEP.finditer(text))
    # none of the blocks is passed over
    assert len(matches) == len(re.findall(r"^```\w+$", text, re.MULTILINE))
    return matches


@pytest.fixture(scope="module")
def copy(steps: list[re.Match[str]], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """All that is in the folder of the project, with its compiled kernels, after every step."""
    place = tmp_path_factory.mktemp("copy")
    # what other tests are writing at this moment has a name that is gone in the next
    passing = shutil.ignore_patterns("*.pyc.*", "*.tmp*")
    for path in ROOT.iterdir():
        if path.is_dir() and (not path.name.startswith(".") or path.name == ".ci"):
            shutil.copytree(path, place / path.name, ignore=passing)
        elif path.is_file():
            shutil.copy(path, place)
    for step in steps:
        file, line, block = place / step["file"], step["line"], step["block"]
        if line is None:
            assert not file.exists()
            file.write_text(block)
            continue
        lines = file.read_text().splitlines(keepends=True)
        (above,) = (number for number, text in enumerate(lines) if text.startswith(line))
        apart = "\n\n" if block.startswith(("class ", "def ")) else ""
        file.write_text("".join([*lines[:above], block + apart, *lines[above:]]))
    # else each process reads from source what is no longer that of the bytecode
    _run(place, "-m", "compileall", "-q", *_PACKAGES)
    return place


def _require_success(copy: Path, script: str, *arguments: str) -> None:
    """A script runs without a fault, in a process of its own that has the packages of the copy."""
    file = copy / "script.py"
    file.write_text(script)
    ran = run("tests.docs.recipes", str(file), *arguments, root=copy)
    assert ran.returncode == 0, ran.stdout + ran.stderr


def _run(copy: Path, *arguments: str, timeout_s: float = 900.0) -> str:
    environment = {**os.environ, "PYTHONPATH": str(copy)}
    ran = subprocess.run(
        [sys.executable, *arguments],
        cwd=copy,
        env=environment,
        capture_output=True,
        text=True,
        timeout=timeout_s,
        check=False,
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr
    return ran.stdout


@pytest.mark.parametrize("heading", _ADDED)
def test_it_takes_as_many_files_as_it_says(heading: str) -> None:
    actual_section = section("CONTRIBUTING.md", heading)
    files = {step["file"] for step in _STEP.finditer(actual_section)}
    assert actual_section.lstrip().startswith(f"{_NUMBERS[len(files) - 1]} files")


def test_effect_output_computation_and_limit_are_answered_swept_and_reported(copy: Path, tmp_path: Path) -> None:
    _require_success(copy, _SCRIPT + _COMPUTED + _LIMITED, str(tmp_path))


def test_response_is_weighed_limited_traded_swept_reported_and_checked(copy: Path) -> None:
    _require_success(copy, _RESPONDED)


def test_case_is_solved_chosen_limited_reported_refused_and_checked(copy: Path) -> None:
    _require_success(copy, (RECIPES / "case.py").read_text())


def test_kind_of_choice_goes_with_goals_limits_groups_and_studies(copy: Path) -> None:
    _require_success(copy, (RECIPES / "choice.py").read_text())


def test_the_output_is_shown_by_a_terminal(copy: Path) -> None:
    stdout = run("service", "analyze", "examples/2d12.json", "--output", "obliquity", root=copy).stdout
    assert "Lean of the rods" in stdout
    assert re.search(r"largest angle of any rod, deg\W+\d", stdout)


def test_the_computation_is_a_command(copy: Path, tmp_path: Path) -> None:
    body = tmp_path / "body.json"
    body.write_text('{"stroke_m": "280 mm", "speed_rpm": 500}')
    stdout = run("service", "piston-speed", str(body), root=copy).stdout
    # analytic: two strokes in a turn
    assert re.search(r"mean, m/s\W+4\.6", stdout)


def test_all_is_written_as_the_linter_wants_it(copy: Path) -> None:
    for check in (("check",), ("format", "--check")):
        _run(copy, "-m", "ruff", *check, "--no-cache", *_PACKAGES)


def test_all_keeps_to_the_layers(copy: Path) -> None:
    _run(copy, "-c", "from importlinter.cli import lint_imports_command; lint_imports_command()", "--no-cache")


@pytest.mark.nightly
def test_all_is_typed(copy: Path) -> None:
    # half a minute of CPU where nothing is known of the packages yet: pytest tests/docs/test_contributing.py -m nightly
    root = ROOT / ".mypy_cache"
    if root.exists():
        shutil.copytree(root, copy / ".mypy_cache")
    _run(copy, "-m", "mypy", *_PACKAGES)


@pytest.mark.nightly
@pytest.mark.parametrize("folder", _OTHERS)
def test_the_other_tests_pass_on_the_copy(copy: Path, folder: str) -> None:
    # pytest tests/docs/test_contributing.py -m nightly; this file and the history of commits are not asked of the copy
    itself = ("--ignore", "tests/docs/test_contributing.py", "--ignore", "tests/docs/test_commits.py")
    options = ("-p", "no:cacheprovider", "-n", "0", "-m", "not nightly", *itself)
    _run(copy, "-m", "pytest", *options, f"tests/{folder}", timeout_s=3600.0)


def test_the_documents_have_a_row_for_it(copy: Path) -> None:
    rows = re.findall(r"^\| `(\w+)` \| .* \|$", (copy / "docs" / "api" / "analyze.md").read_text(), re.MULTILINE)
    assert rows.index("obliquity") + 1 == rows.index("pin_loads")
    assert "| `largest_obliquity_deg` |" in (copy / "docs" / "sweeps.md").read_text()
