"""A problem without quantities over the turn is a finite program, and the same as its outer approximation."""

import json
from pathlib import Path

import numpy as np
import pytest

from optimizer.formulation.goals import Case, formulate
from optimizer.outputs.registry import prepare
from optimizer.program.cuts.semi_infinite import Problem
from schemas.request.requests import OptimizeRequest

EXAMPLES = Path(__file__).parents[2] / "examples"
NAMES = ("2d12", "single-vertical", "single-horizontal", "m-type-four", "v60", "scroll-oldham")


def problem(name: str, **goal: object) -> Problem:
    body = json.loads((EXAMPLES / f"{name}.json").read_text("utf-8"))
    request = OptimizeRequest.model_validate({"machine": body["machine"], "objective": goal})
    scene = prepare(request, ("residual",))
    case = Case(request.machine, scene.omega_squared, (scene.responses,))
    return formulate(request.machine, request.objective, (case,), scene.omega_squared).program


@pytest.mark.parametrize("combine", ["sum", "max"])
@pytest.mark.parametrize("name", NAMES)
def test_what_is_finite_is_its_own_outer_approximation(name: str, combine: str) -> None:
    program = problem(name, combine=combine, force_ceiling_N=1e5, moment_ceiling_x_Nm=1e5)
    finite, outer = program.finite, program.outer(())
    assert finite is not None
    for norms, second in ((finite.norms, outer.norms), (finite.ceilings.norms, outer.ceilings.norms)):
        # analytic: one formulation, to the bit
        np.testing.assert_array_equal(norms.constant, second.constant)
        np.testing.assert_array_equal(norms.influence, second.influence)
    np.testing.assert_array_equal(finite.floor, outer.floor)
    np.testing.assert_array_equal(finite.ceilings.cap, outer.ceilings.cap)
    np.testing.assert_array_equal(finite.row, outer.row)
    assert finite.names == outer.names
    assert finite.ceilings.names == outer.ceilings.names
