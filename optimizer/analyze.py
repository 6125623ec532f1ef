"""The machine as it stands, or with given counterweights."""

import time

import numpy as np

from optimizer.figures.counterweights import counterweights, unbalance
from optimizer.outputs import outputs
from optimizer.scene import prepare
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
    given = {counterweight.web: counterweight for counterweight in request.counterweights}
    fitted = [given.get(web.name) for web in request.machine.webs]
    mass = np.array([one.mass_kg if one else 0.0 for one in fitted], dtype=float)
    angle = np.array([one.angle_deg % 360.0 if one else 0.0 for one in fitted], dtype=float)
    fields = outputs(scene, unbalance(mass, angle, scene.layout.webs.radius))
    end = time.perf_counter()
    return AnalyzeAnswer(
        **fields,
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
