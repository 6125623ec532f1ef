"""Peaks with the worst masses against every corner of the masses and fine samples of the turn."""

import itertools
from functools import cache

import numpy as np
import pytest

from optimizer.formulation.formulate import of_all_orders
from optimizer.formulation.goals import bearing_responses
from optimizer.mechanics.whole_turn import WholeTurn
from optimizer.numerics.arrays import Complex, Real
from optimizer.outputs.registry import prepare
from optimizer.responses import worst_masses as scattered
from optimizer.responses.boxes import CellBounds, Cells, worst_masses
from optimizer.responses.component import component
from optimizer.responses.curve import TurnResponse, peaks
from optimizer.responses.mass_scatter import peaks_astray
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.objective import Objective
from schemas.request.requests import OptimizeRequest
from tests.hard_turn import machines
from tests.night import every

_STEPS = np.linspace(0.0, 2.0 * np.pi, 721)


@cache
def _responses(name: str, gas: bool, shaft: str) -> tuple[TurnResponse, ...]:
    """Bearing loads, force and moment, and a component of the force."""
    body = (machines.SMALL | machines.MEDIUM | machines.LARGE)[name](gas=gas)
    request = OptimizeRequest.model_validate({"machine": body, "fidelity": {"shaft": shaft}})
    scene = prepare(request, ("residual",))
    assert isinstance(request.machine, ReciprocatingMachine)
    turn: WholeTurn = scene.simulated.result("whole_turn", "objective")
    loads = bearing_responses(request.machine, request.fidelity, turn, scene.laden)
    frame = of_all_orders(turn, scene.laden, Objective())
    return (*loads, *frame, component(frame[0], "y", float(scene.laden.sense)))


def _corners(response: TurnResponse, angle: Real, share: float) -> Complex:
    """The curve with every corner of the masses (corners, n)."""
    parts = share * response.curves.parts.at(response.number, angle)
    signs = np.array(list(itertools.product((-1.0, 1.0), repeat=parts.shape[-1])))
    return response.at(angle) + signs @ parts.T


@pytest.mark.parametrize("share", every(2, [1e-6, 0.02, 0.3, 1.0]))
@pytest.mark.parametrize("size", [0.0, 0.03, 0.5])
@pytest.mark.parametrize(
    ("name", "gas", "shaft"),
    [("twin", True, "continuous"), ("vee", True, "simple_spans"), ("six", False, "continuous")],
)
def test_no_corner_is_worse_and_one_is_as_bad(name: str, gas: bool, shaft: str, size: float, share: float) -> None:
    """Independent: all 2^n corners at every half degree, and one of them at the angle that is told."""
    responses = _responses(name, gas, shaft)
    rng = np.random.default_rng(3)
    count = responses[0].influence.size
    u = size * (rng.normal(size=count) + 1j * rng.normal(size=count))
    worst = peaks_astray(responses, [share] * len(responses), u, np.full(len(responses), 1e-6))
    for response, angle, peak, lower, upper in zip(responses, *worst, strict=True):
        at_steps = np.abs(_corners(response, _STEPS, share) + response.contribution(u, _STEPS))
        assert np.max(at_steps) <= upper
        assert lower <= upper <= lower * (1.0 + 1e-6) + 1e-12
        beside = np.array([angle - 1e-9, angle, angle + 1e-9])  # at a jump one of its limits
        apart = np.min(np.abs(_corners(response, beside, share) - peak))
        assert apart <= 1e-6 * upper
        assert abs(peak + np.ravel(response.contribution(u, beside[1:2]))[0]) == pytest.approx(
            lower, rel=1e-9, abs=1e-12
        )


@pytest.mark.parametrize("share", [0.02, 0.3])
@pytest.mark.parametrize("size", [0.0, 0.03])
@pytest.mark.parametrize(("name", "shaft"), [("twin", "continuous"), ("vee", "simple_spans")])
def test_a_steep_peak_at_a_jump_is_left_to_rounding(
    name: str, shaft: str, size: float, share: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Regression: 700 to 4,800 cells at a tolerance below rounding, where it were up to 330,000 as narrow as 1e-19 rad.

    A valve opens where the peak is, so the curve is steep there, and the rounding of angles is no less in finer cells.
    """
    cells, look = [0], scattered.look

    def counted(some: Cells) -> CellBounds:
        cells[0] += some.member.size
        return look(some)

    monkeypatch.setattr(scattered, "look", counted)
    responses = _responses(name, True, shaft)
    rng = np.random.default_rng(3)
    count = responses[0].influence.size
    u = size * (rng.normal(size=count) + 1j * rng.normal(size=count))
    worst = peaks_astray(responses, [share] * len(responses), u, np.full(len(responses), 1e-14))
    assert np.all(worst.upper - worst.lower <= 1e-12 * worst.lower)
    assert cells[0] < 10_000


def test_sixteen_rows_that_may_be_anything_are_bracketed() -> None:
    """Independent: nothing that is tried by chance comes to more, and the masses that are told come to as much."""
    responses = _responses("sixteen", True, "continuous")[:3]
    u = np.full(responses[0].influence.size, 0.02 - 0.01j)
    worst = peaks_astray(responses, [1.0] * 3, u, np.full(3, 1e-10))
    assert np.all(worst.upper <= worst.lower * (1.0 + 2e-10))
    rng = np.random.default_rng(7)
    for response, upper in zip(responses, worst.upper, strict=True):
        signs = rng.choice((-1.0, 1.0), size=(200, 16))
        parts = response.curves.parts.at(response.number, _STEPS)
        assert np.max(np.abs(response.at(_STEPS) + response.contribution(u, _STEPS) + signs @ parts.T)) <= upper


@pytest.mark.parametrize("most", [1, 5_000, 20_000])
def test_a_bracket_that_is_broken_off_is_as_wide_as_it_is_known(most: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Analytic: the finer bracket lies in every wider one."""
    responses = _responses("vee", True, "continuous")
    u = np.full(responses[0].influence.size, 0.02 - 0.01j)
    share, width = [0.5] * len(responses), np.full(len(responses), 1e-11)
    fine = peaks_astray(responses, share, u, width)
    monkeypatch.setattr(scattered, "_MOST_NUMBERS", most)
    worst = peaks_astray(responses, share, u, width)
    assert np.all(worst.lower <= fine.upper)
    assert np.all(worst.upper >= fine.lower)
    assert np.all(worst.lower <= worst.upper)
    assert np.max(worst.upper / worst.lower) > 1.0 + 1e-10
    if most == 20_000:
        # the first step is done
        assert np.max(worst.upper / worst.lower) < 1.011


def test_a_peak_that_may_be_anything_is_told_by_its_pieces() -> None:
    """Analytic: a bracket as wide as asked, without a cell that is looked at."""
    responses = _responses("vee", True, "continuous")
    u = np.zeros(responses[0].influence.size, dtype=complex)
    worst = peaks_astray(responses, [1e-3] * len(responses), u, np.full(len(responses), 0.25))
    fine = peaks_astray(responses, [1e-3] * len(responses), u, np.full(len(responses), 1e-9))
    assert np.all(worst.lower <= fine.upper)
    assert np.all(worst.upper >= fine.lower)
    assert np.all(worst.upper <= 1.25 * worst.lower + 1e-12)


def test_masses_that_do_not_scatter_leave_the_peak_as_it_is() -> None:
    """Analytic: the same bracket, to its width."""
    responses = _responses("six", True, "simple_spans")
    u = np.full(responses[0].influence.size, 0.01 + 0.02j)
    worst = peaks_astray(responses, [0.0] * len(responses), u, np.full(len(responses), 1e-9))
    plain = peaks(responses, u, 1e-9)
    np.testing.assert_allclose(worst.lower, plain.lower, rtol=2e-9, atol=1e-15)
    np.testing.assert_allclose(worst.upper, plain.upper, rtol=2e-9, atol=1e-15)


def test_worst_signs_of_one_axis_are_those_along_the_vector() -> None:
    """Analytic: rows along one axis all go with the vector, which is |v| + p sum |g|."""
    parts = np.array([[1.0, -2.0, 0.5]]) * np.exp(1j * 0.3)
    signs = worst_masses(np.array([-4.0 * np.exp(1j * 0.3)]), parts)
    np.testing.assert_array_equal(signs, [[-1.0, 1.0, -1.0]])
