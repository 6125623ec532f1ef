"""Every hard case of the effects meets its demands; the references agree with definitions of their own."""

from collections import Counter

import mpmath
import pytest

from tests.hard_effects.battery import CASES
from tests.hard_effects.case import Case
from tests.hard_effects.cases_inertia import harmonic
from tests.hard_effects.exact import State, mp
from tests.hard_effects.exact_turn import Machine
from tests.hard_effects.machines import MACHINES
from tests.night import ALL, every, part

#: what is compared at many angles, each of which takes milliseconds at 50 digits
_LONG = ("motion", "turn", "pins")
#: by day one of so many of these
_STEP = 3 if ALL else 6


@pytest.mark.parametrize(
    "case",
    part(4, (case for case in CASES if case.subject not in _LONG))
    + [instance for subject in _LONG for instance in every(_STEP, (case for case in CASES if case.subject == subject))],
    ids=lambda case: case.id,
)
def test_errors_against_fifty_digits(case: Case) -> None:
    findings = list(case.findings())
    assert findings
    # independent: the evaluations at 50 digits
    missed = [
        f"{finding.quantity}: {finding.error:.1e} > {finding.demanded:.1e}"
        for finding in findings
        if not finding.error <= finding.demanded
    ]
    assert not missed, f"{case.why}: {missed}"


def test_every_case_has_a_name_and_a_reason() -> None:
    assert max(Counter(case.id for case in CASES).values()) == 1
    assert all(case.why for case in CASES)
    assert len(CASES) >= 90


@pytest.mark.nightly
@pytest.mark.parametrize("hard", MACHINES[:6] + MACHINES[8:12], ids=lambda hard: hard.name)
def test_reference_of_motion_and_work(hard: object) -> None:
    """Analytic: velocity and acceleration are derivatives of the travel, the torque is that of the work."""
    for row in Machine(hard.body).rows:  # type: ignore[attr-defined]
        for phi in (0.3, 1.2, 2.7, 4.1, 6.0):
            with mp.workdps(60):
                state = State(row, mp.mpf(phi))
                rate, bend = (mp.diff(lambda x, row=row: State(row, x).displacement, state.phi, n) for n in (1, 2))
                power = mp.diff(lambda x, row=row: State(row, x).work, state.phi)
            assert abs(state.velocity - row.omega * rate) < mp.mpf("1e-20") * row.omega * row.radius
            assert abs(state.acceleration - row.omega**2 * bend) < mp.mpf("1e-15") * abs(state.acceleration)
            assert abs(state.torque - power) < mp.mpf("1e-15") * (abs(power) + 1)


@pytest.mark.nightly
@pytest.mark.parametrize("length", [1.001, 1.5, 4.0])
@pytest.mark.parametrize("order", [2, 4, 6])
def test_reference_of_the_harmonics(order: int, length: float) -> None:
    """Analytic: Fourier coefficients of the acceleration, by quadrature."""
    with mpmath.workdps(25):
        rod = mpmath.mpf(length)

        def acceleration(phi: mpmath.mpf) -> mpmath.mpf:
            s, c, q = mpmath.sin(phi), mpmath.cos(phi), mpmath.sqrt(rod**2 - mpmath.sin(phi) ** 2)
            return c + (c**2 - s**2) / q + s**2 * c**2 / q**3

        near = [mpmath.pi / 2 - mpmath.mpf(d) for d in (1, 0.3, 0.1, 0.03, 0.01, 0.0)]
        whole = mpmath.quad(lambda x: acceleration(x) * mpmath.cos(order * x), [0, *near]) * 4 / mpmath.pi
        # even orders alone: the first one has no part in the mean of both halves of the half turn
        odd = mpmath.quad(lambda x: mpmath.cos(x) * mpmath.cos(order * x), [0, mpmath.pi / 2]) * 4 / mpmath.pi
    assert abs(mp.mpmathify(whole - odd) - harmonic(order, mp.mpf(1), mp.mpf(length))) < mp.mpf("1e-12")


@pytest.mark.nightly
@pytest.mark.parametrize("hard", MACHINES[:1] + MACHINES[2:3] + MACHINES[10:11], ids=lambda hard: hard.name)
def test_reference_of_the_torque_integrals(hard: object) -> None:
    """Independent: mean torque by quadrature of the torque between its breaks."""
    machine = Machine(hard.body)  # type: ignore[attr-defined]
    with mp.workdps(15):
        edges = sorted({*machine.watched()[::4], *machine.breaks, 2 * mp.pi})
        whole = mp.quad(machine.torque, edges, maxdegree=3)
        assert abs(whole / (2 * mp.pi) - machine.mean) < 1e-9 * machine.size
