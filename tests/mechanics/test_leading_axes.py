"""Designs beside each other are as each alone: every function of the mechanics, over two leading axes (property)."""

from dataclasses import replace

import numpy as np
import pytest

from optimizer.mechanics.layout import spread
from optimizer.mechanics.scatter import weighted
from optimizer.responses.response import Phasors
from tests.analyze.driven import arrays, random_driven
from tests.mechanics.functions import FUNCTIONS, LEADING, arrays_of, curves_of, designs, together


@pytest.mark.parametrize("name", FUNCTIONS)
def test_designs_together_are_as_each_alone(name: str) -> None:
    function = FUNCTIONS[name]
    columns = list(arrays_of(function(together())))
    actual_arrays = [list(arrays_of(function(design))) for design in designs()]
    assert len(columns) == len(actual_arrays[0]) > 0
    for part, expected in zip(columns, zip(*actual_arrays, strict=True), strict=True):
        alone = np.stack(expected)
        assert part.shape == (*LEADING, *alone.shape[1:])
        size = np.max(np.abs(alone[np.isfinite(alone)]), initial=0.0)
        np.testing.assert_allclose(part.reshape(alone.shape), alone, rtol=1e-10, atol=1e-12 * size)


def test_the_first_curves_of_designs_are_their_own() -> None:
    """Property: whether those of all have been cut in pieces before or not."""
    torque = curves_of(together())
    both = replace(torque, weights=np.concatenate([torque.weights, 2.0 * torque.weights], axis=1),
                   constant=np.concatenate([torque.constant, torque.constant], axis=1))  # fmt: skip
    expected = torque.pieces.cubic
    for _ in range(2):
        np.testing.assert_allclose(both.first(1).pieces.cubic, expected, rtol=1e-12)
        assert len(both.pieces.cubic) == 2 * len(expected)


def test_of_two_designs_each_has_its_own_data() -> None:
    rows = curves_of(together()).whole.rows
    both = {name: value[:2] for name, value in vars(rows).items() if isinstance(value, np.ndarray)}
    pair = replace(rows, designs=2, **both)
    for number in range(2):
        alone = pair.of_designs(slice(number, number + 1))
        assert alone.designs == 1
        for name, value in both.items():
            own = value if len(value) == 1 else value[number : number + 1]
            np.testing.assert_array_equal(getattr(alone, name), own)


def test_what_is_common_to_designs_is_spread_over_all() -> None:
    plan, _ = arrays(random_driven(1, "v", throws=2))
    wide = spread(plan, LEADING)
    assert wide.central == plan.central
    for first, second in zip(arrays_of(wide), arrays_of(plan), strict=True):
        assert first.shape == (*LEADING, *second.shape)
        assert np.array_equal(first, np.broadcast_to(second, first.shape), equal_nan=True)


def test_scatter_of_phasors_is_weighed_as_their_components() -> None:
    """Independent: the components themselves over the turn."""
    rng = np.random.default_rng(4)
    pair = Phasors(*(rng.normal(size=(2, 2)) @ [1, 1j]))
    turn = np.linspace(0.0, 6.0, 50)
    plain, weighed = pair.at(turn), weighted(pair, 0.7, 1.9).at(turn)
    np.testing.assert_allclose(weighed, 0.7 * plain.real + 1.9j * plain.imag, atol=1e-14)
