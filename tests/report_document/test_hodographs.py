"""Hodographs of every order, from the phasors of an answer."""

import json

import numpy as np
import pytest

from optimizer.optimize import optimize
from schemas.request.requests import OptimizeRequest
from service.documents.examples import load
from service.report.blocks import Figure
from service.report.chapters.orders import _ellipse, orders


def test_every_order_that_is_more_than_dust_is_drawn() -> None:
    body = json.loads(load("2d12")) | {"outputs": ["orders"]}
    found = optimize(OptimizeRequest.model_validate(body)).orders
    assert found is not None
    drawn = [block for block in orders(found).blocks if isinstance(block, Figure)]
    assert [figure.caption.split(":")[0] for figure in drawn] == ["Order 1", "Order 2", "Order 4"]
    assert [len(figure.drawings) for figure in drawn] == [2, 2, 2]


def test_the_ellipse_is_where_the_vector_goes_analytic() -> None:
    body = json.loads(load("v60")) | {"outputs": ["orders"]}
    found = optimize(OptimizeRequest.model_validate(body)).orders
    assert found is not None
    for one in found.before[:2]:
        co, counter = one.force.co_rotating, one.force.counter_rotating
        turn = np.exp(1j * np.linspace(0.0, 2.0 * np.pi, 3601))
        force = (co.real_N + 1j * co.imag_N) * turn + (counter.real_N + 1j * counter.imag_N) / turn
        major, minor, axis_deg = _ellipse(one.force, "N")
        assert major == pytest.approx(np.max(np.abs(force)), rel=1e-5)
        assert minor == pytest.approx(np.min(np.abs(force)), abs=1e-5 * major)
        along = force * np.exp(-1j * np.deg2rad(axis_deg))
        assert np.max(along.real) == pytest.approx(major, rel=1e-5)
