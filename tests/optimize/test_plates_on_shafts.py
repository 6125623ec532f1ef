"""Plates on balance shafts, and on webs beside them: cut to the unbalance that the shafts call for."""

from typing import Any

import numpy as np
import pytest

from optimizer.errors import OutOfRange
from optimizer.optimize import optimize
from schemas.answer.answers import OptimizeAnswer
from schemas.answer.counterweights import Counterweight, every_counterweight
from schemas.request.drawings import DrawingsRequest
from schemas.request.requests import OptimizeRequest
from service.common.validation import InvalidRequest, check
from service.drawings.archive import files
from service.drawings.drawing_set import drawings
from tests.drawings.exchange import File
from tests.night import part
from tests.optimize.shafts import WHOLE, at, shaft, single
from tests.verification.checking import optimized

PLATE = {"outer_radius_m": 0.2, "thickness_m": 0.03, "density_kg_m3": 7850.0}
#: kg/m^2, and of half a disc the mass times radius, kg m
AREAL = 0.03 * 7850.0
WIDEST = 2.0 / 3.0 * AREAL * 0.2**3


def with_plate(place: dict[str, Any], shape: str, **plate: float) -> dict[str, Any]:
    """A web whose counterweight is cut from a plate."""
    return {"name": place["name"], "position_m": place["position_m"], "envelope": {"shape": shape, **PLATE, **plate}}


def plated(shape: str, ratio: int = -1, crank: bool = False, **axis: float) -> dict[str, Any]:
    """One cylinder with a plate on its balance shaft, and on its web if that is said."""
    balancer = shaft("back", ratio, **axis)
    balancer["webs"] = [with_plate(place, shape) for place in balancer["webs"]]
    body = single([balancer])
    if crank:
        body["webs"] = [with_plate(place, shape) for place in body["webs"]]
    return body


def answer(body: dict[str, Any], **objective: Any) -> OptimizeAnswer:
    return optimized({"machine": body, "objective": objective})


def on_shaft(optimum: OptimizeAnswer) -> Counterweight:
    (back,) = optimum.balance_shafts
    (weight,) = back.counterweights
    return weight


def test_a_plate_that_takes_half_of_a_single_cylinder_analytic() -> None:
    """U = m r = 2/3 rho t R^3 sin^3 a of a segment, m = rho t R^2 (a - sin a cos a); of a sector sin a, and a."""
    optimum = answer(plated("segment"))
    half = np.arcsin(np.cbrt(0.5 / WIDEST))
    weight = on_shaft(optimum)
    assert optimum.status == "optimal"
    assert optimum.residual.after.force.peak_N <= 2e-6 * WHOLE
    assert weight.mass_kg == pytest.approx(AREAL * 0.2**2 * (half - np.sin(half) * np.cos(half)), rel=1e-5)
    assert weight.shape is not None
    assert weight.shape.chord_height_m == pytest.approx(0.2 * np.cos(half), rel=1e-5)
    assert weight.angle_deg == pytest.approx(270.0, abs=1e-4)
    assert optimum.certificate.mass_lower_bound_kg == pytest.approx(5.0 + weight.mass_kg, rel=1e-5)
    optimum = answer(plated("sector", crank=True))
    half = np.arcsin(0.5 / WIDEST)
    assert optimum.status == "optimal"
    assert [weight.mass_kg for weight in every_counterweight(optimum)] == pytest.approx(
        [AREAL * 0.2**2 * half] * 2, rel=1e-5
    )


@pytest.mark.parametrize(
    ("shape", "ratio", "objective"),
    part(
        3,
        [
            ("segment", -1, {"orders": "all"}),
            ("sector", -1, {"combine": "max"}),
            ("segment", 2, {"orders": "all"}),
            ("sector", 1, {}),
            (
                "segment",
                -1,
                {"orders": "all", "priorities": [{"goal": "external"}, {"goal": "mass"}]},
            ),
            ("sector", -2, {"orders": "all", "roll_weight": 2.0}),
        ],
        rows=True,
    ),
)
def test_the_answer_is_that_of_its_radii_independent(shape: str, ratio: int, objective: dict[str, Any]) -> None:
    """A plate reaches every unbalance up to its largest, as webs do of the radius and the mass that it comes to."""
    body = plated(shape, ratio, crank=True, x_m=0.1, y_m=0.05)
    optimum = answer(body, **objective)
    assert optimum.status == "optimal"
    shafts = (body["webs"], body["balance_shafts"][0]["webs"])
    groups = (optimum.counterweights, optimum.balance_shafts[0].counterweights)
    for webs, weights in zip(shafts, groups, strict=True):
        for place, weight in zip(webs, weights, strict=True):
            del place["envelope"]
            place |= {"counterweight_radius_m": weight.radius_m, "max_mass_kg": weight.mass_kg}
    of_radii = answer(body, **objective)
    first, second = (optimum.certificate, of_radii.certificate)
    size = first.objective_without_counterweights
    assert second.objective == pytest.approx(first.objective, abs=3e-6 * size)
    # all stands in one plane: the force alone, from accelerations
    turn, is_first = np.arange(0.0, 360.0, 0.5), "orders" not in objective
    force = max(abs(at(body, optimum.model_dump(), theta, is_first)[0]) for theta in turn)
    if "roll_weight" not in objective:
        assert first.objective == pytest.approx(force, rel=1e-4)


def _points(x_m: float, y_m: float) -> np.ndarray:
    """Of the solids in their places (n, 3) mm, and their names."""
    request = check(DrawingsRequest, {"machine": plated("segment", x_m=x_m, y_m=y_m, crank=True)})
    solids = dict(files(drawings(request)))["counterweights.step"]
    assert File(solids).products() == ["'Counterweight a'", "'Counterweight back web'"]
    lines = (line for line in solids.decode().splitlines() if "CARTESIAN_POINT" in line)
    return np.array([[float(part) for part in line.split("(", 2)[2].rstrip(");").split(",")] for line in lines])


def test_a_plate_of_a_shaft_is_drawn_where_the_shaft_is() -> None:
    # analytic: all points of the second solid are moved, and none of the first
    shift = _points(0.25, -0.125) - _points(0.0, 0.0)
    moved = np.abs(shift[:, 0]) > 1.0
    assert 0.3 < np.mean(moved) < 0.5
    np.testing.assert_allclose(shift[moved], np.broadcast_to([250.0, -125.0, 0.0], shift[moved].shape), atol=1e-9)
    np.testing.assert_allclose(shift[~moved], 0.0, atol=1e-9)


@pytest.mark.parametrize(
    ("changes", "path"),
    [
        ({"fitted": [{"web": "back web", "mass_kg": 50.0, "angle_deg": 0.0}]}, ("fitted", 0, "mass_kg")),
        (
            {"catalogue": {"mass_step_kg": 1.0, "angle_step_deg": 30.0}},
            ("machine", "balance_shafts", 0, "webs", 0, "envelope"),
        ),
    ],
)
def test_what_does_not_go_with_it_is_named(changes: dict[str, Any], path: tuple[Any, ...]) -> None:
    machine = plated("segment") | {name: value for name, value in changes.items() if name == "catalogue"}
    machine["webs"][0]["max_mass_kg"] = 20.0
    rest = {name: value for name, value in changes.items() if name != "catalogue"}
    with pytest.raises((InvalidRequest, OutOfRange)) as refusal:
        optimize(check(OptimizeRequest, {"machine": machine, **rest}))
    assert [problem.path for problem in refusal.value.problems] == [path]
