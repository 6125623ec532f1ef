"""Programs and requests for the ladders."""

import json
from collections.abc import Sequence
from typing import Any

import numpy as np

from optimizer.program.limits import Limits
from optimizer.program.rows import combined, statement, weighted_peak
from optimizer.responses.response import Phasors, Response
from optimizer.studies.accuracy.methods import LadderProgram
from optimizer.studies.accuracy.rivals.sampled import OverTheTurn, WeightedResponse
from schemas.request.accuracy import AccuracyRequest
from service.documents.examples import load
from tests.program.cases import random_limits, random_point, random_responses


def free_limits(reach: Sequence[float]) -> Limits:
    webs = len(reach)
    return Limits(
        radius=np.ones(webs),
        max_mass=np.array(reach),
        free=np.ones(webs, bool),
        centre=np.ones(webs, complex),
        half_angle_cos=np.zeros(webs),
        half_angle_sin=np.ones(webs),
        max_total_mass=np.asarray(np.inf),
    )


def single(co: complex, counter: complex, reach: float) -> LadderProgram:
    """One force, one web: the smallest peak is max(|co| - reach, 0) + |counter|."""
    response = Response("force", "N", Phasors(np.asarray(co), np.asarray(counter)), np.ones(1))
    return LadderProgram(
        statement(combined([weighted_peak(response, 1.0)], "sum"), [], free_limits([reach])),
        OverTheTurn((WeightedResponse(response, 1.0),), "sum", ()),
    )


def random_task(
    seed: int, combine: str, weights: tuple[float, float], sectors: bool, budget: bool, ceilings: bool
) -> LadderProgram:
    """Two responses with random phasors; the ceilings, if any, are met by some point."""
    rng = np.random.default_rng(seed)
    webs = int(rng.integers(1, 7))
    limits, responses = random_limits(rng, webs, sectors, budget), random_responses(rng, webs)
    inside = random_point(rng, limits)
    allowed = [(response, 1.05 * float(response.to(inside).peak)) for response in responses] if ceilings else []
    return LadderProgram(
        statement(
            combined([weighted_peak(response, 1.0, *weights) for response in responses], combine), allowed, limits
        ),
        OverTheTurn(
            tuple(WeightedResponse(response, 1.0, *weights) for response in responses),
            combine,
            tuple((WeightedResponse(response, 1.0), most) for response, most in allowed),
        ),
    )


def body(name: str, **objective: Any) -> dict[str, Any]:
    document: dict[str, Any] = json.loads(load(name))
    document["objective"] = {**document.get("objective", {}), **objective}
    return document


def request(name: str, repeats: int = 1, **objective: Any) -> AccuracyRequest:
    return AccuracyRequest.model_validate({**body(name, **objective), "repeats": repeats})
