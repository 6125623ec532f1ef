"""Load and compile before the first request, which would otherwise wait for seconds."""

from typing import Any

_CYLINDER = {
    "bore_m": 0.1,
    "piston_rod_diameter_m": 0.02,
    "suction_pressure_Pa": 1e5,
    "discharge_pressure_Pa": 3e5,
    "relative_clearance": 0.1,
    "expansion_exponent": 1.3,
    "compression_exponent": 1.3,
}


def warm_up() -> None:
    """Solve a small machine by the methods that most questions need: compiled, both stages, and by cuts over the turn;
    follow it over the turn. The modelling layer is loaded by the first program that no other method solves.

    Raises
    ------
    RuntimeError
        if one of them leaves it open: who cannot solve this solves nothing.
    """
    _solve(1.0)
    plain_discs()
    follow_a_turn()
    _solve(1.0, orders="all")


def plain_discs() -> None:
    """Solve a machine whose webs have neither sector nor budget, by the method for such."""
    _solve(None)


def _solve(budget: float | None, **objective: object) -> None:
    from optimizer.optimize import optimize
    from schemas.request.requests import OptimizeRequest

    body = {"machine": {**_machine(), "max_total_mass_kg": budget}, "objective": objective}
    answer = optimize(OptimizeRequest.model_validate(body))
    if answer.status != "optimal":
        raise RuntimeError(f"the warm-up was answered {answer.status}")


def follow_a_turn() -> None:
    """Loads of a rod and of bearings, and the torque, over the whole turn, with gas: peaks, floors and integrals."""
    from optimizer.analyze import analyze
    from schemas.request.requests import AnalyzeRequest

    bearings = [{"name": name, "position_m": position} for name, position in (("a", -0.2), ("b", 0.2))]
    (throw,) = _machine()["throws"]
    (row,) = throw["rows"]
    machine = {**_machine(), "throws": [{**throw, "rows": [{**row, "cylinder": _CYLINDER}]}], "bearings": bearings}
    analyze(AnalyzeRequest.model_validate({"machine": machine, "outputs": ["rod_loads", "torque", "main_bearings"]}))


def match_parts() -> None:
    """Nine parts on as many rows: too many for all of their orders to be listed."""
    import numpy as np

    from optimizer.numerics.kernel.meeting import met
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


def _machine() -> dict[str, Any]:
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
