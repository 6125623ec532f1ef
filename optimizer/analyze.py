"""The machine as it stands, or with given counterweights."""

import time
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from optimizer.errors import refuse
from optimizer.formulation.balance_shafts import fitted
from optimizer.formulation.counterweights import as_given
from optimizer.formulation.placement import on_webs
from optimizer.mechanics.shapes import fitted_masses, plates
from optimizer.outputs.registry import fields, prepare
from schemas.answer.answers import AnalyzeAnswer, Timing
from schemas.base.model import FieldProblem
from schemas.request.requests import AnalyzeRequest

#: by which a mass that was answered may be above what its envelope holds
_ROUNDING = 1e-12


def analyze(request: AnalyzeRequest) -> AnalyzeAnswer:
    """What a machine does without and with the given counterweights.

    Raises
    ------
    MissingInput
        if the machine lacks what a requested output needs.
    OutOfRange
        if a counterweight is more than its envelope holds.
    """
    start = time.perf_counter()
    request = on_webs(request)
    mass, angle = as_given(request.machine, request.counterweights)
    refuse(_too_heavy(request))
    # what is cut from a plate has the radius that its mass gives it
    request = request.model_copy(update={"machine": fitted_masses(request.machine, mass)})
    scene = prepare(request)
    reporting = time.perf_counter()
    given = fitted(request.machine, mass, angle)
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


def _too_heavy(request: AnalyzeRequest) -> Iterator[FieldProblem]:
    """Counterweights that are more than the envelope of their web holds."""
    cut, webs = plates(request.machine), request.machine.webs
    if cut is None:
        return
    most = {webs[k].name: mass for k, mass in zip(cut.webs.tolist(), cut.mass(cut.most).tolist(), strict=True)}
    for index, one in enumerate(request.counterweights):
        if one.mass_kg > most.get(str(one.web), np.inf) * (1.0 + _ROUNDING):
            message = f"the envelope of this web holds {most[str(one.web)]:.6g} kg at most"
            yield FieldProblem(("counterweights", index, "mass_kg"), message)
