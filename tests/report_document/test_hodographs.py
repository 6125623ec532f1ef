"""Hodographs of every order, from the phasors of an answer."""

import json
from collections.abc import Iterable

import numpy as np
import pytest

from optimizer.optimize import optimize
from schemas.answer.outputs import OrdersComparison
from schemas.request.requests import OptimizeRequest
from service.documents.examples import load
from service.report.blocks import Block, Chapter, Figure, Paragraph, Table
from service.report.chapters.orders import _ellipse, order_hodographs, orders


def _orders(name: str) -> tuple[OrdersComparison, Chapter]:
    comparison = optimize(OptimizeRequest.model_validate(json.loads(load(name)) | {"outputs": ["orders"]})).orders
    assert comparison is not None
    return comparison, orders(comparison)


def test_orders_that_are_more_than_small_are_listed_and_ellipses_that_are_no_lines_drawn() -> None:
    """Analytic: opposed rows move along one axis; orders above the first of a V do not."""
    comparison, chapter = _orders("2d12")
    (listed,) = [block for block in chapter.blocks if isinstance(block, Table)]
    assert [row[0] for row in listed.rows] == ["1", "2", "4"]
    # the first order is drawn in a chapter of its own
    assert _figures(chapter.blocks) == []
    words = " ".join(block.text for block in chapter.blocks if isinstance(block, Paragraph))
    assert "Of order 6 force and moment are below a thousandth of the largest." in words
    assert "The vectors of order 2, 4 run along straight lines" in words
    # the picture by itself has them all
    assert [figure.caption.split(":")[0] for figure in order_hodographs(comparison)] == [
        "Order 1",
        "Order 2",
        "Order 4",
    ]
    assert len(_figures(_orders("v60")[1].blocks)) >= 1


def _figures(blocks: Iterable[Block]) -> list[Figure]:
    return [block for block in blocks if isinstance(block, Figure)]


def test_the_ellipse_is_where_the_vector_goes_analytic() -> None:
    body = json.loads(load("v60")) | {"outputs": ["orders"]}
    comparison = optimize(OptimizeRequest.model_validate(body)).orders
    assert comparison is not None
    for order in comparison.before[:2]:
        co, counter = order.force.co_rotating, order.force.counter_rotating
        turn = np.exp(1j * np.linspace(0.0, 2.0 * np.pi, 3601))
        force = (co.real_N + 1j * co.imag_N) * turn + (counter.real_N + 1j * counter.imag_N) / turn
        major, minor, axis_deg = _ellipse(order.force, "N")
        assert major == pytest.approx(np.max(np.abs(force)), rel=1e-5)
        assert minor == pytest.approx(np.min(np.abs(force)), abs=1e-5 * major)
        along = force * np.exp(-1j * np.deg2rad(axis_deg))
        assert np.max(along.real) == pytest.approx(major, rel=1e-5)
