"""Harmonics of the piston's acceleration: against the spectrum of its exact motion, and against the first terms."""

from collections.abc import Iterator

import numpy as np

from optimizer.mechanics.slider_crank import acceleration_harmonic
from tests.validation.comparison import Comparison

_RATIOS = (0.2, 0.3)
_SAMPLES = 4096


def comparisons() -> Iterator[Comparison]:
    """Orders 2, 4, 6 and 8; those of 6 and 8 are given wrongly by tools that truncate the series too early."""
    turn = 2.0 * np.pi * np.arange(_SAMPLES) / _SAMPLES
    for lam in _RATIOS:
        machine = f"piston, rod ratio {lam}"
        place = np.cos(turn) + np.sqrt(1.0 - (lam * np.sin(turn)) ** 2) / lam
        spectrum = np.fft.rfft(place).real / (_SAMPLES / 2)
        # leading terms; the next one is smaller by some lam^2 each
        leading = {2: lam + lam**3 / 4, 4: -(lam**3) / 4, 6: 9 * lam**5 / 128, 8: -5 * lam**7 / 256}
        after = {2: 15 * lam**5 / 128, 4: 3 * lam**5 / 16, 6: 45 * lam**7 / 512, 8: 35 * lam**9 / 1024}
        for order, first in leading.items():
            ours = float(acceleration_harmonic(order, np.asarray(lam)))
            # twice differentiated: order squared
            exact = float(spectrum[order]) * order**2
            yield Comparison(machine, f"order {order}, spectrum", "independent", exact, ours, 1e-13 * order**2, "-")
            words = f"order {order}, leading terms"
            yield Comparison(machine, words, "analytic", first, ours, 1.5 * after[order], "-")
