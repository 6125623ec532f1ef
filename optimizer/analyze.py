"""The machine as it stands, or with counterweights of the request."""

import time

from optimizer.errors import refuse
from optimizer.formulation.balance_shafts import fitted
from optimizer.formulation.counterweights import mass_and_angle, too_heavy
from optimizer.formulation.placement import on_webs
from optimizer.mechanics.shapes import fitted_masses
from optimizer.outputs.registry import fields, prepare
from schemas.answer.answers import AnalyzeAnswer
from schemas.base.mappings import or_mapping
from schemas.request.requests import AnalyzeRequest


@or_mapping(AnalyzeRequest)
def analyze(request: AnalyzeRequest) -> AnalyzeAnswer:
    """What a machine does without and with the counterweights of the request.

    Raises
    ------
    MissingInput
        if the machine lacks what a requested output needs.
    OutOfRange
        if a counterweight is more than its envelope holds.
    """
    start = time.perf_counter()
    request = on_webs(request)
    mass, angle = mass_and_angle(request.machine, request.counterweights)
    refuse(too_heavy(request.machine, request.counterweights, "counterweights"))
    # what is cut from a plate has the radius that its mass gives it
    machine = fitted_masses(request.machine, mass)
    scene = prepare(request, request.outputs, machine=machine)
    reporting = time.perf_counter()
    counterweights = fitted(machine, mass, angle)
    figures = fields(scene.beside(counterweights.on_shafts), counterweights.on_crank, request.outputs)
    end = time.perf_counter()
    return AnalyzeAnswer.of_figures(
        {
            **figures,
            **counterweights.fields,
            "reference_plane_m": float(scene.layout.reference_plane),
            "effects": scene.simulated.uses,
            "timing": {
                "total_ms": (end - start) * 1e3,
                "solve_ms": 0.0,
                "mechanics_ms": scene.mechanics_ms,
                "certificate_ms": 0.0,
                "report_ms": (end - reporting) * 1e3,
            },
        }
    )
