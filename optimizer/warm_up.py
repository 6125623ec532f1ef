"""Load and compile before the first request, which would otherwise wait for seconds."""


def warm_up() -> None:
    """Import cvxpy and clarabel, and solve a small machine once, both stages."""
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
    optimize(OptimizeRequest.model_validate({"machine": machine}))
