"""Keys of an Oldham ring (analytic): of two designs, at angles where the sine or the cosine is 0, and between."""

import numpy as np
import pytest

from optimizer.mechanics.oldham import Oldham, keys, pin_losses


def test_keys_carry_the_couple_and_the_ring_and_slide_with_sine_and_cosine() -> None:
    ring = Oldham(*(np.array(pair) for pair in ([0.005, 0.01], [0.05, 0.04], [2.0, 4.0], [0.2, -0.3], [100.0, 300.0])))
    angle = ring.axis[:, None] + np.array([0.0, 0.5 * np.pi, np.pi, np.pi / 6.0])
    actual = keys(ring, np.array([[10.0], [20.0]]), angle)
    # N = T/(2 R), m e omega^2 / 2 and e omega
    for n, (couple, inertia, speed) in enumerate(((100.0, 50.0, 0.5), (250.0, 1800.0, 3.0))):
        cosine, sine = np.array([1.0, 0.0, -1.0, np.sqrt(0.75)]), np.array([0.0, 1.0, 0.0, 0.5])
        assert actual.frame[n] == pytest.approx(np.full(1, couple))
        couples = np.stack([couple - inertia * cosine, -couple - inertia * cosine], axis=-1)
        assert actual.scroll[n] == pytest.approx(couples, rel=1e-12)
        assert actual.frame_speed[n] == pytest.approx(speed * sine, abs=1e-14)
        assert actual.scroll_speed[n] == pytest.approx(speed * np.abs(cosine), abs=1e-14)
        lost = 0.1 * (2.0 * couple * speed * sine + np.sum(np.abs(couples), axis=-1) * speed * np.abs(cosine))
        assert actual.loss(np.array(0.1))[n] == pytest.approx(lost, rel=1e-12)


def test_pins_lose_in_both_journals() -> None:
    load = np.array([[30.0, -10.0], [0.0, 5.0]])
    assert pin_losses(load, np.array(0.02), np.array(0.1), np.array(50.0)) == pytest.approx([4.0, 0.5])
