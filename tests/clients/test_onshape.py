"""The example for Onshape, against calls as its reference lists them; it was never run against Onshape itself."""

import json
import os
import subprocess
import sys
import threading
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from itertools import pairwise
from math import cos, pi, radians, sin
from pathlib import Path
from typing import Any

import pytest

from tests.clients.conftest import CLIENT, ROOT
from tests.mechanics.crankshaft.shafts import Drawing, Json

EXAMPLE = ROOT / "examples" / "onshape" / "counterweight_onshape.py"
STUDIO = "/api/v9/partstudios/d/DOC/w/WORK/e/ELEMENT"
MASS = 352.4


def edge(name: str, start: list[float], middle: list[float], end: list[float]) -> Json:
    return {"id": name, "geometry": {"startPoint": start, "midPoint": middle, "endPoint": end}}


def recorded(drawing: Drawing) -> Json:
    """Body details of a drawing, in the fields of Onshape's reference."""
    faces, edges = [], []
    for n, face in enumerate(drawing.faces()):
        own = list(edges_of(face, n))
        edges += own
        coedges = [{"edgeId": fields["id"], "orientation": True} for fields in own]
        about = {"id": f"J{n}", "orientation": True, "loops": [{"type": "OUTER", "coedges": coedges}]}
        if face["type"] == "plane":
            surface = {"type": "plane", "origin": face["centre_m"], "normal": face["normal"]}
            faces.append({**about, "area": face.get("area_m2", 0.01), "surface": surface})
        elif face["type"] == "cylinder":
            low, high = face["ends_m"]
            area = radians(face.get("angle_deg", 360.0)) * face["radius_m"] * (high - low)
            surface = {"type": "cylinder", "origin": face["centre_m"], "axis": [0, 0, 1], "radius": face["radius_m"]}
            faces.append({**about, "area": area, "surface": surface})
        else:
            faces.append({**about, "area": 0.001, "surface": {"type": "torus"}})
    return {"bodies": [{"id": "JHD", "type": "solid", "faces": faces, "edges": edges}]}


def edges_of(face: Json, n: int) -> Iterator[Json]:
    points = face.get("points_m")
    if face["type"] == "cylinder" and points is None:
        (x, y, _), r = face["centre_m"], face["radius_m"]
        for k, z in enumerate(face["ends_m"]):
            yield edge(f"E{n}.{k}", [x + r, y, z], [x - r, y, z], [x + r, y, z])
    elif points is not None:
        # lists of a drawing: ends of straight sides, or both rims of an arc, point by point
        for k, (start, end) in enumerate(pairwise(points)):
            yield edge(f"E{n}.{k}", start, [(a + b) / 2 for a, b in zip(start, end, strict=True)], end)
    else:
        (x, y, z), r = face["centre_m"], 0.05
        for k, angle in enumerate((0.0, pi)):
            ends = [[x + r * cos(angle + turn), y + r * sin(angle + turn), z] for turn in (0.0, pi / 2, pi)]
            yield edge(f"E{n}.{k}", *ends)


PROPERTIES = {
    "bodies": {
        "-all-": {
            "mass": [MASS, MASS, MASS],
            "volume": [MASS / 7850] * 3,
            "centroid": [0.0, 0.0, 0.0] * 3,
            "inertia": [22.9, 0, 5.61, 0, 24.3, 0, 5.61, 0, 3.65] * 3,
        }
    }
}


@pytest.fixture
def onshape() -> Iterator[str]:
    answers = {f"{STUDIO}/bodydetails": recorded(Drawing()), f"{STUDIO}/massproperties?massAsGroup=true": PROPERTIES}

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            body = json.dumps(answers[self.path]).encode()
            self.send_response(200 if self.headers["Authorization"] == "Basic YWNjZXNzOnNlY3JldA==" else 401)
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, *_: object) -> None:
            return

    with ThreadingHTTPServer(("127.0.0.1", 0), Handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_address[1]}"
        server.shutdown()


def printed(onshape: str, url: str, *arguments: str) -> Any:
    environment = {
        **os.environ, "ONSHAPE_URL": onshape, "ONSHAPE_KEYS": "access:secret", "COUNTERWEIGHT_URL": url,
        "PYTHONPATH": str(CLIENT.parent),
    }  # fmt: skip
    command = [sys.executable, str(EXAMPLE), "DOC", "WORK", "ELEMENT", *arguments]
    process = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=120, check=False)
    assert process.returncode == 0, process.stderr
    return json.loads(process.stdout)


def test_a_part_studio_becomes_a_machine(onshape: str, url: str, tmp_path: Path) -> None:
    shaft = printed(onshape, url)
    assert [throw["crank_radius_m"] for throw in shaft["throws"]] == pytest.approx([0.14, 0.14])
    assert [web["envelope"]["thickness_m"] for web in shaft["webs"]] == pytest.approx([0.07] * 4)
    assert [web["envelope"]["inner_radius_m"] for web in shaft["webs"]] == pytest.approx([0.12] * 4)
    # analytic: a couple of 5.61 kg m2 in planes 0.97 m apart
    assert [unbalance["x_kg_m"] for unbalance in shaft["unbalances"]] == pytest.approx([5.61 / 0.97, -5.61 / 0.97])
    path = tmp_path / "machine.json"
    rows = [{"axis_deg": axis, "reciprocating_mass_kg": 250} for axis in (0, 180)]
    path.write_text(json.dumps({"machine": {"speed_rpm": 500, "throws": [{"rows": [row]} for row in rows]}}))
    answer = printed(onshape, url, str(path))
    assert answer["status"] == "optimal"
    assert answer["total_mass_kg"] > 0
