"""A limit is added in one file of its own and a registration: here what pulls at a web at the speed of the machine.

One crank with a rotating mass, and one web opposite: the counterweight m R takes m R omega^2 from the force.
"""

import numpy as np
import pytest

from optimizer.formulation.limits import WEB_LIMITS, MassLimit, limits
from optimizer.formulation.task import Task
from optimizer.mechanics.layout import stacked
from optimizer.numerics.arrays import Real, mapped
from optimizer.outputs.registry import prepare
from optimizer.program.sensitivity import shadow_prices
from optimizer.solve.certify import Certified, certified
from optimizer.solve.prices import Priced, of_limits
from optimizer.studies.sweep.counterweights import optimal
from schemas.machine.machine import Machine
from schemas.request.requests import OptimizeRequest

NAME = "max_pull"
RPM, OMEGA = 600.0, 20.0 * np.pi
LARGEST = 1500.0  # N
CRANK, RADIUS = 1.0, 0.2  # kg m of the rotating mass, m


def _force_per_kg(machine: Machine) -> Real:
    omega = np.asarray(machine.speed_rpm) * (np.pi / 30.0)
    return stacked([web.counterweight_radius_m for web in machine.webs]) * np.square(omega)[..., None]


@pytest.fixture(autouse=True)
def _registered(monkeypatch: pytest.MonkeyPatch) -> None:
    limit = MassLimit("N", lambda machine: np.full(len(machine.webs), LARGEST), _force_per_kg)
    monkeypatch.setitem(WEB_LIMITS, NAME, limit)  # type: ignore[misc] # not in the contract


def _request(max_mass: float) -> OptimizeRequest:
    throw = {"position_m": 0.0, "crank_radius_m": 0.1, "crank_angle_deg": 30.0, "rotating_mass_kg": 10.0, "rows": []}
    web = {"name": "w", "position_m": 0.0, "counterweight_radius_m": RADIUS, "max_mass_kg": max_mass}
    machine = {"kind": "reciprocating", "speed_rpm": RPM, "throws": [throw], "webs": [web]}
    return OptimizeRequest.model_validate({"machine": machine})


def _solved(request: OptimizeRequest) -> tuple[Certified, list[str], dict[str, Priced]]:
    """The optimum, the limits that it touches, and all prices in N per unit."""
    scene, machine = prepare(request, ("residual",)), request.machine
    best = certified(
        request.machine,
        request.objective,
        scene.responses,
        np.array([scene.omega_squared]),
        Task.of(request).demand,
    )
    touched = [name for name, limit in WEB_LIMITS.items() if limit.touched(machine, best.mass_kg, best.angle_deg)[0, 0]]
    prices = mapped(shadow_prices(best.program, best.unbalance, best.optima.multipliers), lambda array: array[0])
    bounds = of_limits(machine, prices)
    return best, touched, {bound.limit: bound._replace(price=bound.price * scene.omega_squared) for bound in bounds}


def test_it_is_kept_certified_touched_and_priced_by_its_name() -> None:
    """Analytic: what the largest force leaves, but for what optima may differ by; a newton more is a newton less."""
    best, touched, prices = _solved(_request(20.0))
    assert best.status == "optimal", best.reason
    assert best.mass_kg[0, 0] == pytest.approx(LARGEST / (RADIUS * OMEGA**2), rel=1e-5)
    assert best.certificate["objective"][0] == pytest.approx(CRANK * OMEGA**2 - LARGEST, abs=1.01e-6 * CRANK * OMEGA**2)
    assert touched == [NAME]
    assert prices[NAME].price == pytest.approx(1.0, rel=1e-6)
    assert (prices[NAME].unit, prices[NAME].size) == ("N", LARGEST)
    assert prices["max_mass"].price == 0.0


def test_of_two_largest_masses_the_smaller_is_the_one_that_binds() -> None:
    """Analytic: a kilogram takes R omega^2."""
    best, touched, prices = _solved(_request(1.0))
    assert best.mass_kg[0, 0] == pytest.approx(1.0, rel=1e-5)
    assert touched == ["max_mass"]
    assert prices["max_mass"].price == pytest.approx(RADIUS * OMEGA**2, rel=1e-6)
    assert prices[NAME].price == 0.0


def test_where_neither_binds_neither_is_touched(monkeypatch: pytest.MonkeyPatch) -> None:
    """Analytic: the crank is balanced by CRANK / R."""
    monkeypatch.setitem(WEB_LIMITS, NAME, MassLimit("N", lambda _: np.array([np.inf]), _force_per_kg))  # type: ignore[misc]
    best, touched, prices = _solved(_request(20.0))
    assert best.mass_kg[0, 0] == pytest.approx(CRANK / RADIUS, rel=1e-5)
    assert touched == []
    assert NAME not in prices


def test_rows_of_a_sweep_know_it_at_every_speed() -> None:
    """Analytic: slow shafts are balanced, fast ones as far as the force lets them."""
    rpm = np.array([100.0, 300.0, 600.0, 1200.0])
    request = _request(20.0)
    columns = request.model_copy(update={"machine": request.machine.model_copy(update={"speed_rpm": rpm})})
    omega = rpm * np.pi / 30.0
    assert limits(columns.machine, rpm.shape).max_mass[:, 0] == pytest.approx(
        np.minimum(20.0, LARGEST / (RADIUS * omega**2)), rel=1e-12
    )
    body, _ = optimal(columns, rpm.size)
    assert body["status"].tolist() == ["optimal"] * rpm.size
    left = np.maximum(CRANK * omega**2 - LARGEST, 0.0)
    assert body["objective"] == pytest.approx(left, abs=1.1e-6 * np.max(CRANK * omega**2))
