"""Load and compile before the first request, which would otherwise wait for seconds."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from schemas.request.requests import OptimizeRequest

#: of the objective, what the reference solver is to reach in its first attempt
_GAP = 1e-6


def warm_up() -> None:
    """Solve a small machine by the compiled methods, both stages, and by the reference solver; follow it over the turn.

    Raises
    ------
    RuntimeError
        if either leaves it open: who cannot solve this solves nothing.
    """
    from optimizer.formulation.goals import cone_program
    from optimizer.outputs.registry import prepare
    from optimizer.program.reference.solver import Solver
    from optimizer.program.solution import CONE_PROGRAM

    _solved(1.0)
    request = plain_discs()
    follow_a_turn()
    # seldom asked: what the compiled method leaves open
    scene = prepare(request, ("residual",))
    statement = cone_program(request.machine, request.objective, scene.responses, scene.omega_squared)
    # no gap is small enough, so that an attempt is made
    found = Solver().smallest_objective(statement, -1.0, stop=lambda best: best.method == CONE_PROGRAM)
    if found.method != CONE_PROGRAM or found.gap > _GAP * found.objective:
        raise RuntimeError(f"the reference solver left a gap of {found.gap:g}")


def plain_discs() -> "OptimizeRequest":
    """Solve a machine whose webs have neither sector nor budget, by the method for such."""
    return _solved(None)


def _solved(budget: float | None) -> "OptimizeRequest":
    from optimizer.optimize import optimize
    from schemas.request.requests import OptimizeRequest

    request = OptimizeRequest.model_validate({"machine": {**_machine(), "max_total_mass_kg": budget}})
    answer = optimize(request)
    if answer.status != "optimal":
        raise RuntimeError(f"the warm-up was answered {answer.status}")
    return request


def follow_a_turn() -> None:
    """Loads of a rod and of bearings, and the torque, over the whole turn: with their peaks, floors and integrals."""
    from optimizer.analyze import analyze
    from schemas.request.requests import AnalyzeRequest

    bearings = [{"name": name, "position_m": position} for name, position in (("a", -0.2), ("b", 0.2))]
    machine = {**_machine(), "bearings": bearings}
    analyze(AnalyzeRequest.model_validate({"machine": machine, "outputs": ["rod_loads", "torque", "main_bearings"]}))


def match_parts() -> None:
    """Nine parts on as many rows: too many for all of their orders to be listed."""
    import numpy as np

    from optimizer.studies.matching.kernel.meeting import met
    from optimizer.studies.matching.match import match
    from schemas.match.request import MatchRequest

    throws = [
        {
            "position_m": float(k),
            "crank_radius_m": 0.1,
            "crank_angle_deg": 40.0 * k,
            "rows": [{"axis_deg": 0.0, "reciprocating_mass_kg": 10.0}],
        }
        for k in range(9)
    ]
    machine = {"kind": "reciprocating", "speed_rpm": 1000.0, "throws": throws, "webs": []}
    parts = {"class": "part", "names": [str(k) for k in range(9)], "masses_kg": [1.0 + 0.1 * k**0.5 for k in range(9)]}
    match(MatchRequest.model_validate({"machine": machine, "parts": [parts], "accuracy": {"relative_gap": 1e-12}}))
    met(np.zeros((1, 1)), np.zeros((1, 1)), 1.0, 1)


def _machine() -> dict[str, object]:
    """One row between two webs."""
    throw = {
        "position_m": 0.0,
        "crank_radius_m": 0.1,
        "crank_angle_deg": 0.0,
        "rows": [{"axis_deg": 0.0, "reciprocating_mass_kg": 10.0, "connecting_rod": {"length_m": 0.5}}],
    }
    webs = [
        {"name": name, "position_m": position, "counterweight_radius_m": 0.1, "max_mass_kg": 10.0}
        for name, position in (("a", -0.1), ("b", 0.1))
    ]
    return {"kind": "reciprocating", "speed_rpm": 1000.0, "throws": [throw], "webs": webs}
