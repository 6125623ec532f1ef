"""Over the whole turn where a response nearly cancels: the objective is that of the peaks beside it."""

import copy
from typing import Any

import pytest

from optimizer import optimize
from schemas.request.requests import OptimizeRequest
from service.documents.examples import bodies


def _with_shaft(example: str, speed_ratio: int) -> dict[str, Any]:
    """A machine with a balance shaft that has a web at either end of the crankshaft."""
    machine = copy.deepcopy(bodies("")[example]["machine"])
    ends = [throw["position_m"] for throw in machine["throws"]]
    web = {"counterweight_radius_m": 0.05, "max_mass_kg": 100}
    webs = [{"name": f"s{k}", "position_m": z, **web} for k, z in enumerate((min(ends), max(ends)))]
    machine["balance_shafts"] = [{"name": "s", "speed_ratio": speed_ratio, "x_m": 0.1, "y_m": 0.0, "webs": webs}]
    return {"machine": machine, "objective": {"orders": "all", "moment_weight": 1.0}}


@pytest.mark.parametrize(
    "body",
    [
        {**bodies("")["lanchester-four"], "objective": {"orders": "all", "moment_weight": 1.0}},
        _with_shaft("inline-four-engine", -2),
        _with_shaft("inline-four-engine", 2),
    ],
)
def test_the_objective_is_that_of_the_peaks(body: dict[str, Any]) -> None:
    """Analytic: a sum of the peak force and the peak moment, here with a moment that counterweights leave at 0."""
    answer = optimize(OptimizeRequest.model_validate(body))
    assert answer.status == "optimal"
    assert answer.certificate is not None
    assert answer.residual is not None
    assert answer.residual.turn is not None
    assert answer.residual.turn.after is not None
    after = answer.residual.turn.after
    assert after.moment_peak_Nm <= 1e-9 * after.force_peak_N
    size = answer.certificate.yardstick
    assert answer.certificate.objective == pytest.approx(after.force_peak_N + after.moment_peak_Nm, abs=1e-9 * size)
