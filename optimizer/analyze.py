"""The machine as it stands, or with given counterweights."""

import time

import numpy as np

from optimizer.figures.counterweights import as_given, counterweights, unbalance
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
    mass, angle = as_given(request)
    found = fields(scene, unbalance(mass, angle, scene.layout.webs.radius))
    end = time.perf_counter()
    return AnalyzeAnswer(
        **found,
        counterweights=counterweights(request.machine, mass, angle),
        total_mass_kg=float(np.sum(mass)),
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
