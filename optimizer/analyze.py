"""The machine as it stands, or with given counterweights."""

import time
from dataclasses import replace

from optimizer.balance_shafts import fitted
from optimizer.figures.counterweights import as_given
from optimizer.outputs import fields, prepare
from schemas.answers import AnalyzeAnswer, Timing
from schemas.requests import AnalyzeRequest


def analyze(request: AnalyzeRequest) -> AnalyzeAnswer:
    """What a machine does without and with the given counterweights.

    Raises
    ------
    MissingInput
        if the machine lacks what a requested output needs.
    """
    start = time.perf_counter()
    scene = prepare(request)
    reporting = time.perf_counter()
    given = fitted(request.machine, *as_given(request))
    found = fields(replace(scene, shafts=given.on_shafts), given.on_crank)
    end = time.perf_counter()
    return AnalyzeAnswer(
        **found,
        **given.fields,
        reference_plane_m=float(scene.layout.reference_plane),
        effects=scene.simulated.uses,
        timing=Timing(
            total_ms=(end - start) * 1e3,
            solve_ms=0.0,
            mechanics_ms=scene.mechanics_ms,
            certificate_ms=0.0,
            report_ms=(end - reporting) * 1e3,
        ),
    )
