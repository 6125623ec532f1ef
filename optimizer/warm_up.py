"""Load and compile before the first request, which would otherwise wait for seconds."""


def warm_up() -> None:
    """Solve a small machine by the compiled method, both stages, and one that only the reference solver can answer.

    The second loads cvxpy and clarabel: that ceilings cannot be kept is its finding alone.

    Raises
    ------
    RuntimeError
        if either is answered with another status than it has.
    """
    from optimizer.optimize import optimize
    from schemas.requests import OptimizeRequest

    throw = {
        "position_m": 0.0,
        "crank_radius_m": 0.1,
        "crank_angle_deg": 0.0,
        "rows": [{"axis_deg": 0.0, "reciprocating_mass_kg": 10.0}],
    }
    webs = [
        {"name": name, "position_m": position, "counterweight_radius_m": 0.1, "max_mass_kg": 10.0}
        for name, position in (("a", -0.1), ("b", 0.1))
    ]
    machine = {"kind": "reciprocating", "speed_rpm": 1000.0, "throws": [throw], "webs": webs}
    for objective, status in (({}, "optimal"), ({"force_ceiling_N": 1.0}, "infeasible")):
        answer = optimize(OptimizeRequest.model_validate({"machine": machine, "objective": objective}))
        if answer.status != status:
            raise RuntimeError(f"the warm-up was answered {answer.status} where {status} is right")
