"""Programs as compiled loops take them; without the compiler, which those who make them do not need."""

from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real


class Region(NamedTuple):
    """The limits of N programs in the usual order in memory."""

    radius: Real  # (N, K)
    max_mass: Real  # (N, K)
    budget: Real  # (N,)
    free: np.ndarray  # (N, K) bool
    centre: Complex  # (N, K)
    cosine: Real  # (N, K)
    sine: Real  # (N, K)
    turn: Complex  # (N, K) of webs that are alike; (N, 0) where none are, and so on
    leader: np.ndarray  # (K,) first web of the unit of each web
    mirrored: np.ndarray  # (K,) bool
    members: Real  # (K,) webs of that unit


class Programs(NamedTuple):
    """N programs in the usual order in memory. Their work is written to by whoever holds the interpreter."""

    owner: np.ndarray  # (J,) row of a term
    group: np.ndarray  # (R,)
    scalar: np.ndarray  # (J + I,) bool
    scatter: Real  # (2,) of the terms, and of what is under ceilings
    constant: Complex  # (N, J + I) of the terms, then of what is under ceilings
    influence: Real  # (N, J + I, K) real parts
    across: Real  # (N, J + I, K) imaginary parts; (N, J + I, 0) where all are real, and so is the next
    magnitude: Real  # (N, J + I, K)
    floor: Real  # (N, R)
    cap: Real  # (N, I)
    tolerant_cap: Real  # (N, I) cap up to which a ceiling counts as kept
    size: Real  # (N, I)
    region: Region
    numbers: Real  # (6, ...) work, as are the next
    vectors: Complex  # (4, ...)
    places: np.ndarray  # (2, K)

    @property
    def arrays(self) -> tuple[np.ndarray, ...]:
        """All of them one by one: numba looks through tuples for the types of arrays, which takes longer than a loop.

        :func:`optimizer.program.kernel.values.programs_of` puts them together again.
        """
        return (*self[:12], *self.region, *self[13:])
