"""The entry to what is read of curves over the whole turn, their peaks and their crossings; compiled.

Both expand the rows, and to compile that anew takes most of an entry's time.
"""

import numpy as np

from optimizer.mechanics.kernel.crossings import crossings
from optimizer.mechanics.kernel.search import search
from optimizer.numerics.compiling import kernel
from optimizer.responses.kernel.parts import Best, Members

_NOWHERE, _NUMBERS = np.zeros(0, np.int64), np.zeros(0)
#: where crossings are sought
NO_MEMBERS = Members(_NOWHERE, _NOWHERE, np.zeros(0, complex), _NUMBERS, _NUMBERS, _NUMBERS)
NO_BEST = Best(_NUMBERS, _NUMBERS, _NUMBERS, _NOWHERE, _NOWHERE)
#: where peaks are
NO_LEVELS = _NUMBERS


@kernel
def peaks_or_crossings(cubics, members, best, level, rows, sums, middle, motion):  # type: ignore[no-untyped-def]
    """The curves (G,) at their peaks, which it improves; of levels (N,) the angles (N, n) at which curves cross them
    and what their integrals may be off by (N,)."""
    if level.size > 0:
        angles, error = crossings(cubics, level, rows, sums, middle)
        return np.empty(0, np.complex128), angles, error
    return search(cubics, members, best, rows, sums, middle, motion), np.empty((0, 0)), np.empty(0)
