"""Counterweights that are at least so heavy beside webs whose limits are as far away as none."""

import copy
from typing import Any

import pytest

from optimizer import optimize
from schemas.request.requests import OptimizeRequest
from service.documents.examples import bodies


def _request(example: str, webs: tuple[int, ...], most: float) -> OptimizeRequest:
    body: dict[str, Any] = copy.deepcopy(bodies("")[example])
    for web in body["machine"]["webs"]:
        web["min_fitted_mass_kg"] = web["max_mass_kg"] / 3.0
    for k in webs:
        body["machine"]["webs"][k]["max_mass_kg"] = most
    body["accuracy"] = {"time_limit_s": 1.0}
    return OptimizeRequest.model_validate(body)


@pytest.mark.parametrize("example", ["2d12", "v8-cross-plane", "single-vertical"])
@pytest.mark.parametrize("webs", [(0,), (0, 1)])
@pytest.mark.parametrize("most", [1e12, 1e15])
def test_an_answer_is_what_its_status_says(example: str, webs: tuple[int, ...], most: float) -> None:
    """Analytic: of wider limits nothing is worse than nothing at all, and a bound is below what nearer limits reach."""
    far, near = (optimize(_request(example, webs, limit_kg)) for limit_kg in (most, 1e4))
    assert far.status in ("optimal", "inaccurate")
    assert far.certificate is not None
    assert near.certificate is not None
    size = far.certificate.yardstick
    assert far.certificate.objective <= far.certificate.objective_without_counterweights + 1e-9 * size
    assert far.certificate.lower_bound is not None
    assert far.certificate.lower_bound <= near.certificate.objective + 1e-9 * size
    for counterweight, web in zip(far.counterweights, _request(example, webs, most).machine.webs, strict=True):
        assert counterweight.mass_kg == 0 or counterweight.mass_kg >= (web.min_fitted_mass_kg or 0.0)
    if far.status == "optimal":
        assert far.certificate.relative_gap is not None
        assert far.certificate.relative_gap <= 1e-3
