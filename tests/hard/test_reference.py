"""The reference against closed forms, and against points and bounds of its own.

Every expected number here is analytic unless it says otherwise.
"""

import subprocess
import sys

import pytest

from tests.hard.cases.case import Body, machine, row, single_row, throw, web
from tests.hard.interior import mp
from tests.hard.program import unit
from tests.hard.reference import OPTIMUM_SHARE, reference

pytestmark = pytest.mark.nightly

_OMEGA = 60.0
_TIGHT = mp.mpf(10) ** -15


def _square(body: Body) -> mp.mpf:
    return (mp.mpf(body["machine"]["speed_rpm"]) * mp.pi / 30) ** 2


def _close(left: mp.mpf, right: mp.mpf, scale: mp.mpf | None = None) -> bool:
    return abs(left - right) <= _TIGHT * (abs(right) if scale is None else scale)


@pytest.mark.parametrize("angle", [0, 90, 180, 270, -90, 36000090])
def test_right_angles_are_exact(angle: float) -> None:
    """Analytic: powers of j."""
    assert unit(angle) == [1, mp.mpc(0, 1), -1, mp.mpc(0, -1)][(angle // 90) % 4]


@pytest.mark.parametrize("combine", ["sum", "max"])
def test_single_row_keeps_half(combine: str) -> None:
    """Analytic: the peak m r omega^2 falls to one half; its counterweight m r/(2 R) less what optima may differ."""
    body = {"machine": machine(single_row(), [web("a", 0.0)], omega=_OMEGA), "objective": {"combine": combine}}
    standard = reference(body)
    product = mp.mpf(10.0) * mp.mpf(0.1)
    whole = product * _square(body)
    assert _close(standard.rest, whole)
    assert _close(standard.objective, whole / 2)
    assert _close(standard.mass, (product / 2 - OPTIMUM_SHARE * product) / mp.mpf(0.2))
    assert _close(standard.force, whole / 2 + OPTIMUM_SHARE * whole)


def test_unequal_v90_keeps_half_the_difference() -> None:
    """Analytic (seed 002): (m1 - m2) r/2 omega^2 remains of an unequal V 90."""
    body = {"machine": machine([throw(0, 45, [row(0, 10), row(90, 7)])], [web("a", 0.0)], omega=_OMEGA)}
    assert _close(reference(body).objective, mp.mpf(0.1) * 3 / 2 * _square(body))


def test_w60_is_cancelled() -> None:
    """Analytic: three equal rows 60 degrees apart turn with the shaft."""
    rows = [row(axis, 10) for axis in (30, 90, 150)]
    body = reference({"machine": machine([throw(0, 10, rows)], [web("a", 0.0)], omega=_OMEGA)})
    assert abs(body.objective) <= _TIGHT * body.rest


@pytest.mark.parametrize("limit", [0.0, 1e-9, 1.0])
def test_one_web_that_is_full(limit: float) -> None:
    """Analytic: a rotor of m r less all that the web can carry, at the full mass of the web."""
    body = {"machine": machine([throw(0, 77, [], rotating=8)], [web("a", 0.0, limit)]), "objective": {}}
    body["accuracy"] = {"relative_gap": 1e-12}
    standard = reference(body)
    left = mp.mpf(0.1) * 8 - mp.mpf(0.2) * mp.mpf(limit)
    assert _close(standard.objective, left * _square(body))


def test_two_planes_cancel_a_rotor() -> None:
    """Analytic: two webs carry the rotor by the lever rule."""
    body = {"machine": machine([throw(0.1, 30, [], rotating=8)], [web("a", -0.25), web("b", 0.5)])}
    body["accuracy"] = {"relative_gap": 1e-12}
    standard = reference(body)
    assert abs(standard.objective) <= _TIGHT * standard.rest
    mass = mp.mpf(0.1) * 8 / mp.mpf(0.2)
    assert abs(standard.mass - mass) <= 1e-11 * mass


def test_half_disc_edge() -> None:
    """Analytic: with its sector 30 degrees off, a web gains the cosine: |f - e^{j 30} u| >= f sin 30."""
    sector = (180.0 + 40.0, 10.0)
    body = {"machine": machine([throw(0, 0, [], rotating=8)], [web("a", 0.0, 100, 0.2, sector)])}
    assert _close(reference(body).objective, mp.mpf(0.1) * 8 * mp.sin(mp.pi / 6) * _square(body))


@pytest.mark.parametrize("half", [1e-6, 60.0, 90.0])
def test_sectors_that_point_away(half: float) -> None:
    """Analytic: nothing is gained, so nothing is fitted."""
    webs = [web(str(k), 0.0, 5, 0.2, (0, half)) for k in range(3)]
    body = reference({"machine": machine([throw(0, 0, [], rotating=4)], webs)})
    assert body.mass == 0
    assert _close(body.objective, body.rest)


@pytest.mark.parametrize(("factor", "feasible"), [(1 - 1e-9, False), (1 + 1e-9, True), (0.5, False), (2.0, True)])
def test_ceiling_about_the_floor(factor: float, feasible: bool) -> None:
    """Analytic: the floor of a single row is m r omega^2/2; the excess is relative to the force that turns along."""
    body = {"machine": machine(single_row(), [web("a", 0.0)], omega=_OMEGA)}
    floor = mp.mpf(10.0) * mp.mpf(0.1) / 2 * _square(body)
    body["objective"] = {"force_ceiling_N": float(floor * factor)}
    standard = reference(body)
    assert standard.feasible == feasible
    ceiling = mp.mpf(body["objective"]["force_ceiling_N"])
    assert abs(standard.excess - (floor - ceiling) / max(floor, abs(ceiling - floor))) <= 1e-20


def test_budget_shared_by_unlike_radii() -> None:
    """Analytic: in one plane the budget goes to the larger radius."""
    webs = [web("a", 0.0, 3.0, 0.05), web("b", 0.0, 3.0, 0.5)]
    body = {"machine": machine([throw(0, 0, [], radius=1.0, rotating=8)], webs, max_total_mass_kg=4.0)}
    left = 8 - mp.mpf(3) * mp.mpf(0.5) - mp.mpf(1) * mp.mpf(0.05)
    assert _close(reference(body).objective, left * _square(body))


def test_the_reference_shares_no_code_with_the_package() -> None:
    """Independent means that nothing of what is tested is even loaded."""
    code = "import sys, tests.hard.reference; print(sorted({'numpy', 'optimizer', 'schemas'} & set(sys.modules)))"
    process = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert process.stdout.strip() == "[]"
