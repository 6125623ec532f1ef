"""Peaks over the turn of responses to counterweights where the masses of the rows scatter."""

from collections.abc import Sequence

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.responses.curve import TurnResponse
from optimizer.responses.moving_curves import with_harmonics
from optimizer.responses.worst_masses import Worst, worst_peaks


def peaks_astray(
    responses: Sequence[TurnResponse], masses: Sequence[float], unbalance: Complex, tolerance: Real
) -> Worst:
    """Peaks (responses,) with counterweights (K,) kg m and the worst masses; the value is that without counterweights.

    Parameters
    ----------
    masses : (responses,) shares by which the mass of every row may be off.
    tolerance : (responses,) of upper - lower, relative to lower.
    """
    together: dict[tuple[int, float], list[int]] = {}
    for k, (response, share) in enumerate(zip(responses, masses, strict=True)):
        # what turns makes another curve of each
        key = id(response.curves) if response.turning is None else id(response)
        together.setdefault((key, share), []).append(k)
    groups = list(together.items())
    brackets = [
        _peaks([responses[k] for k in group], share, unbalance, tolerance[group]) for (_, share), group in groups
    ]
    order = np.argsort(np.concatenate([group for _, group in groups]))
    return Worst(*(np.concatenate(part)[order] for part in zip(*brackets, strict=True)))


def _peaks(responses: Sequence[TurnResponse], share: float, unbalance: Complex, tolerance: Real) -> Worst:
    """Those of the same curves, or of one to which counterweights add what turns."""
    first, number = responses[0], np.array([response.number for response in responses], dtype=np.intp)
    by = first.harmonics(unbalance)
    if by is None:
        offset = np.array([response.offset(unbalance) for response in responses], dtype=complex)
        return worst_peaks(first.curves.pieces, first.curves.parts, share, offset, number, tolerance)
    assert first.number == 0  # a component is the only one of its curves
    pieces, still = with_harmonics(first.curves.pieces, 0, by), np.zeros(1, dtype=complex)
    brackets = worst_peaks(pieces, first.curves.parts, share, still, number, tolerance)
    return brackets._replace(value=brackets.value - by.at(brackets.angle))
