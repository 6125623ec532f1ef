"""What counterweights cut from plates cost beside those of the same machine at the radii that they come to.

Both take turns, and times are those of the processor, the least of many: others on the machine count little.
"""

import json
import time
from collections.abc import Mapping
from typing import Any

from optimizer.mechanics.shapes import plates
from optimizer.optimize import optimize
from schemas.request.requests import OptimizeRequest
from tests.benchmarks.cases import EXAMPLES

_ROW = {"outer_radius_m": 0.095, "thickness_m": 0.03, "max_half_angle_deg": 60}
_2D12 = {"inner_radius_m": 0.08, "outer_radius_m": 0.32, "thickness_m": 0.06, "max_half_angle_deg": 75}
_V8 = {"inner_radius_m": 0.03, "outer_radius_m": 0.12, "thickness_m": 0.03}


def cut(name: str, figures: Mapping[str, Any], *shapes: str, webs: int | None = None) -> dict[str, Any]:
    """An example with plates in place of radii and masses, of shapes that take turns; of another number of webs."""
    body: dict[str, Any] = json.loads((EXAMPLES / f"{name}.json").read_bytes())
    machine = body["machine"]
    if webs is not None:
        machine["webs"] = [{"name": str(k), "position_m": -0.35 + 0.1 * k} for k in range(webs)]
    for k, web in enumerate(machine["webs"]):
        for field in ("counterweight_radius_m", "max_mass_kg"):
            web.pop(field, None)
        web["envelope"] = {**figures, "shape": shapes[k % len(shapes)]}
    return body


def budgeted() -> dict[str, Any]:
    body = cut("2d12", _2D12, "segment")
    body["machine"]["max_total_mass_kg"] = 80.0
    return body


def grouped() -> dict[str, Any]:
    body = cut("2d12", _2D12, "segment")
    body["machine"]["web_groups"] = [{"name": name, "webs": [f"{name}a", f"{name}b"]} for name in "12"]
    return body


KINDS = {
    "one row, two sectors": cut("plate-single", _ROW, "sector"),
    "one row, two segments": cut("plate-single", _ROW, "segment"),
    "2D12, 4 sectors": cut("2d12", _2D12, "sector"),
    "2D12, 4 segments": cut("2d12", _2D12, "segment"),
    "2D12, 2 of each": cut("2d12", _2D12, "sector", "segment"),
    "2D12, 2 groups of segments": grouped(),
    "2D12, 4 segments of 80 kg in all": budgeted(),
    "2D12, 8 segments": cut("2d12", _2D12, "segment", webs=8),
    "2D12, 4 of each": cut("2d12", _2D12, "sector", "segment", webs=8),
    "V8, 8 sectors": cut("v8-cross-plane", _V8, "sector"),
    "V8, 8 segments": cut("v8-cross-plane", _V8, "segment"),
}


def plate_and_radius(body: dict[str, Any]) -> tuple[OptimizeRequest, OptimizeRequest]:
    """A request with plates, and the same with radii: as far out as what was cut, with all that the plates hold."""
    request = OptimizeRequest.model_validate(body)
    answer, cut, plain = optimize(request), plates(request.machine), json.loads(json.dumps(body))
    assert cut is not None
    most = cut.unbalance(cut.most).tolist()
    for web, counterweight, unbalance in zip(plain["machine"]["webs"], answer.counterweights, most, strict=True):
        del web["envelope"]
        web |= {"counterweight_radius_m": counterweight.radius_m, "max_mass_kg": unbalance / counterweight.radius_m}
    return request, OptimizeRequest.model_validate(plain)


def seconds(body: dict[str, Any], repeats: int) -> tuple[float, float]:
    """Least seconds of the processor of an answer with plates, and of one with the same radii, warm."""
    both = plate_and_radius(body)
    least = [float("inf")] * len(both)
    for _ in range(repeats):
        for k, request in enumerate(both):
            began = time.process_time()
            optimize(request)
            least[k] = min(least[k], time.process_time() - began)
    return least[0], least[1]
