"""The component of OpenMDAO: its gradients are those of differences, and an outer optimiser uses them."""

import importlib.util
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from optimizer.optimize import optimize
from schemas.request.requests import OptimizeRequest
from service.documents.examples import bodies

ROOT = Path(__file__).parents[2]
FLYWHEEL = {"name": "flywheel", "position_m": 0.4, "x_kg_m": 0.3, "y_kg_m": 0.8}


@pytest.fixture(scope="module")
def balance() -> ModuleType:
    """The example, read from its file."""
    spec = importlib.util.spec_from_file_location("openmdao_balance", ROOT / "examples" / "openmdao" / "balance.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def request_2d12() -> dict[str, Any]:
    """The 2D12 with an unbalance of its own."""
    body = bodies()["2d12"]
    body["objective"] = {**body.get("objective", {}), "moment_weight": 1 / 0.56}
    return {**body, "machine": {**body["machine"], "unbalances": [FLYWHEEL]}, "outputs": ["residual"]}


def ask(request: dict[str, Any]) -> dict[str, Any]:
    """What the service does with a body."""
    return optimize(OptimizeRequest.model_validate(request)).model_dump(mode="json")


def test_prices_and_multipliers_are_the_gradients(balance: ModuleType, request_2d12: dict[str, Any]) -> None:
    import openmdao.api as om

    problem = om.Problem(reports=False)
    problem.model.add_subsystem("balance", balance.Balance(request=request_2d12, ask=ask), promotes=["*"])
    problem.setup()
    problem.run_model()
    checked = problem.check_partials(out_stream=None, form="central", step=1e-3)["balance"]
    for name in ("max_mass", "unbalance"):
        peak = checked["peak", name]
        # independent: central differences of the certified optimum
        assert peak["J_fwd"] == pytest.approx(peak["J_fd"], rel=1e-4, abs=1e-1), name
        assert np.max(np.abs(peak["J_fwd"])) > 10.0


def test_slsqp_shares_out_what_there_is(balance: ModuleType, request_2d12: dict[str, Any]) -> None:
    objectives: list[float] = []

    def counted(request: dict[str, Any]) -> dict[str, Any]:
        answer = ask(request)
        objectives.append(answer["certificate"]["objective"])
        return answer

    problem = balance.problem(request_2d12, counted, 160.0)
    problem.run_driver()
    limits, peak = problem.get_val("max_mass"), problem.get_val("peak")[0]
    assert problem.driver.result.success
    assert np.sum(limits) <= 160.0 * (1 + 1e-6)
    assert peak < objectives[0]
    # independent: one budget in place of four limits is the same question, put to the service itself
    webs = [{**web, "max_mass_kg": 160.0} for web in request_2d12["machine"]["webs"]]
    machine = {**request_2d12["machine"], "webs": webs, "max_total_mass_kg": 160.0}
    best = ask({**request_2d12, "machine": machine})["certificate"]["objective"]
    assert peak == pytest.approx(best, rel=1e-4)


def test_what_has_no_optimum_is_said(balance: ModuleType, request_2d12: dict[str, Any]) -> None:
    import openmdao.api as om

    request_2d12["objective"]["force_ceiling_N"] = 1.0
    problem = om.Problem(reports=False)
    problem.model.add_subsystem("balance", balance.Balance(request=request_2d12, ask=ask), promotes=["*"])
    problem.setup()
    with pytest.raises(om.AnalysisError, match="no optimum: infeasible"):
        problem.run_model()
