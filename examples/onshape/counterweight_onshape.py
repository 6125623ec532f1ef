"""A crankshaft of an Onshape part studio, read by the service: its throws, webs, bearings and unbalance.

    ONSHAPE_KEYS=access:secret python counterweight_onshape.py DOCUMENT WORKSPACE ELEMENT [machine.json]

Two calls of Onshape list faces and mass; POST /v1/shaft reads the shaft. `machine.json` is a request without what the
faces show: its rows stand throw by throw. With it the answer to the whole request is printed, else the shaft. Needs
`counterweight.py` beside it. COUNTERWEIGHT_URL says where the service is, ONSHAPE_URL where Onshape is.
"""

from __future__ import annotations

import base64
import json
import os
import sys
from math import degrees
from typing import Any, Dict, List, Sequence
from urllib.request import Request, urlopen

from counterweight import Service

Json = Dict[str, Any]
_ONSHAPE = "https://cad.onshape.com"
#: that the service takes of one face
_MOST_POINTS = 64


def call(path: str) -> Json:
    """One call of Onshape, with the keys of the environment."""
    keys = base64.b64encode(os.environ["ONSHAPE_KEYS"].encode()).decode()
    headers = {"Authorization": f"Basic {keys}", "Accept": "application/json"}
    with urlopen(Request(os.environ.get("ONSHAPE_URL", _ONSHAPE) + path, headers=headers), timeout=60) as answer:
        content: Json = json.load(answer)
    return content


def faces_of(details: Json) -> List[Json]:
    """Faces of all solids as the service takes them; Onshape lists metres."""
    faces = []
    for body in details["bodies"]:
        edges = {edge["id"]: edge["geometry"] for edge in body["edges"]}
        for face in body["faces"]:
            names = [coedge["edgeId"] for loop in face["loops"] for coedge in loop["coedges"]]
            faces.append({"name": f"{body['id']} {face['id']}", **_face(face, [edges[name] for name in names])})
    return faces


def _face(face: Json, edges: Sequence[Json]) -> Json:
    surface, kind = face["surface"], face["surface"]["type"].lower()
    points = [edge[end] for edge in edges for end in ("startPoint", "midPoint", "endPoint")]
    samples = {"points_m": points if len(points) <= _MOST_POINTS else []}
    if kind == "plane":
        normal = [value if face["orientation"] else -value for value in surface["normal"]]
        centre = [sum(values) / len(points) for values in zip(*points)]
        return {"type": "plane", "centre_m": centre, "normal": normal, "area_m2": face["area"], **samples}
    if kind != "cylinder":
        return {"type": "other", **samples}
    origin, axis, radius = surface["origin"], surface["axis"], surface["radius"]
    along = [sum((p - o) * a for p, o, a in zip(point, origin, axis)) for point in points]
    low, high = min(along), max(along)
    # of a whole cylinder both rims are closed; of a part the area says how far it goes
    angle = degrees(face["area"] / (radius * (high - low)))
    whole = angle > 359.0
    return {
        "type": "cylinder",
        "centre_m": origin,
        "axis": axis,
        "radius_m": radius,
        "ends_m": [low, high],
        "angle_deg": 360.0 if whole else angle,
        "outer": face["orientation"],
        **({} if whole else samples),
    }


def body_of(properties: Json) -> Json:
    """All parts together; Onshape gives each figure with its smallest and largest value behind it."""
    whole = properties["bodies"]["-all-"]
    tensor = whole["inertia"][:9]
    return {
        "mass_kg": whole["mass"][0],
        "volume_m3": whole["volume"][0],
        "centre_m": whole["centroid"][:3],
        "inertia_kg_m2": [tensor[:3], tensor[3:6], tensor[6:]],
    }


def machine_of(shaft: Json, description: Json) -> Json:
    """A request with what the faces show and what a description says besides."""
    rows = [throw.get("rows", []) for throw in description["machine"].get("throws", [])]
    if len(rows) != len(shaft["throws"]):
        raise SystemExit(f"the faces show {len(shaft['throws'])} throws, {len(rows)} are described")
    parts = {name: shaft[name] for name in ("webs", "bearings", "unbalances")}
    throws = [{**throw, "rows": on} for throw, on in zip(shaft["throws"], rows)]
    return {**description, "machine": {"kind": "reciprocating", **description["machine"], **parts, "throws": throws}}


def main(document: str, workspace: str, element: str, machine: str = "") -> None:
    """Print the shaft, or the answer about the whole machine."""
    studio = f"/api/v9/partstudios/d/{document}/w/{workspace}/e/{element}"
    faces = faces_of(call(f"{studio}/bodydetails"))
    body = body_of(call(f"{studio}/massproperties?massAsGroup=true"))
    service = Service(os.environ.get("COUNTERWEIGHT_URL", "http://127.0.0.1:8000"))
    shaft = service.shaft({"faces": faces, "bodies": [body]})
    serious = [f"{doubt['pointer']}: {doubt['message']}" for doubt in shaft["doubts"] if doubt["serious"]]
    if serious:
        raise SystemExit("\n".join(serious))
    if machine:
        with open(machine) as file:
            shaft = service.optimize(machine_of(shaft, json.load(file)))
    print(json.dumps(shaft, indent=2))


if __name__ == "__main__":
    main(*sys.argv[1:])
