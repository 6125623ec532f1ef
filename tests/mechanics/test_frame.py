"""Responses that are sums of force and moment in fixed shares: analytic."""

import numpy as np
import pytest

from optimizer.mechanics.frame import FORCE, MOMENT, Shares, first_order, phasors
from optimizer.mechanics.inertia import Wrench
from optimizer.numerics.arrays import Real
from optimizer.responses.response import Phasors, Response


def _response(name: str, baseline: Phasors, influence: Real, against: Real | None = None) -> Response:
    return Response(name, "N", baseline, influence, counter_influence=against)


_PULL, _COUPLE = (
    Phasors(np.array(1.0 + 2.0j), np.array(3.0 - 1.0j)),
    Phasors(np.array(-2.0 + 1.0j), np.array(0.5j)),
)
_FORCE = _response("force", _PULL, np.array([1.0, 1.0]), np.array([1.0, 0.0]))
_MOMENT = _response("moment", _COUPLE, np.array([-0.4, 0.6]), np.array([0.2, -0.7]))


def test_a_sum_has_its_shares_of_force_and_moment() -> None:
    """2 F + 3 M, which webs change in the same shares, those that turn backwards too."""
    response = first_order("support", "N", Shares(2.0, 3.0), _FORCE, _MOMENT)
    assert (response.name, response.unit) == ("support", "N")
    assert (response.baseline.co, response.baseline.counter) == (-4.0 + 7.0j, 6.0 - 0.5j)
    assert response.influence == pytest.approx([0.8, 3.8], rel=1e-15)
    assert response.counter_influence == pytest.approx([2.6, -2.1], rel=1e-15)


def test_shares_of_every_design() -> None:
    response = first_order("support", "N", Shares(np.array([2.0, 0.0]), np.array([3.0, 1.0])), _FORCE, _MOMENT)
    assert response.influence == pytest.approx(np.array([[0.8, 3.8], [-0.4, 0.6]]), rel=1e-15)
    assert response.baseline.co.tolist() == [-4.0 + 7.0j, _COUPLE.co]


@pytest.mark.parametrize("without", [_FORCE, _MOMENT])
def test_without_webs_that_turn_backwards_none_are_counted(without: Response) -> None:
    plain = _response(without.name, without.baseline, without.influence)
    both = [plain if without is response else response for response in (_FORCE, _MOMENT)]
    assert first_order("support", "N", Shares(2.0, 3.0), *both).counter_influence is None


def test_force_and_moment_are_themselves() -> None:
    assert first_order("any", "N", FORCE, _FORCE, _MOMENT) is _FORCE
    assert first_order("any", "N", MOMENT, _FORCE, _MOMENT) is _MOMENT
    assert phasors(FORCE, Wrench(_PULL, _COUPLE)) is _PULL
    assert phasors(MOMENT, Wrench(_PULL, _COUPLE)) is _COUPLE


def test_what_cancels_to_rounding_is_nothing() -> None:
    couple = Phasors(_PULL.co / 3.0, _PULL.counter / 3.0)
    harmonics = phasors(Shares(1.0, -3.0), Wrench(_PULL, couple))
    assert (harmonics.co, harmonics.counter) == (0.0, 0.0)
