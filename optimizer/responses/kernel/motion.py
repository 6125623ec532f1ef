"""What the shaft sees of curves, seen along an axis of the frame, and vectors added that turn; compiled.

The frame sees Re(unit e^{j s theta} d(theta)) of a curve d along an axis. Its Taylor polynomials are the products of
those of d and of e^{j s theta}, and by Leibniz's rule no fourth derivative is larger than sum_k C(4, k) |d^(k)|. What
turns at a whole multiple of the shaft's speed adds size e^{j times theta}, whose polynomials have closed forms.
"""

from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.compiling import inner, kernel

#: C(4, k) / 4!
_BINOMIAL = np.array([1.0, 4.0, 6.0, 4.0]) / 24.0
#: as numpy's integer like all else that is handed on
_FIRST = np.int64(0)


class Motion(NamedTuple):
    """What becomes of J curves, before what is constant is added.

    first : number of the first curve, among all of those that they are of.
    unit : of the axis at angle 0; 0 where the vectors themselves count.
    sense : of the rotation, 1 or -1.
    times : (H,) how often each harmonic turns while the shaft turns once.
    size : (J, H) of the harmonics.
    scalar : whether only their real parts count.
    """

    first: int
    unit: complex
    sense: float
    times: Real
    size: Complex
    scalar: bool


#: curves as they are
STILL = Motion(0, 0j, 0.0, np.zeros(0), np.zeros((1, 0), np.complex128), False)


@kernel
def in_motion(motion, centre, half, cubic, rest):  # type: ignore[no-untyped-def]
    """Cubics (m, 4) of the first curve in motion and what they leave out (m,), about centres (m,), in units of half
    widths (m,)."""
    cubic, rest = cubic.copy(), rest.copy()
    for n in range(centre.size):
        rest[n] = into_motion(motion, _FIRST, cubic[n], rest[n], centre[n], half[n])
    return cubic, rest


@inner
def into_motion(motion, curve, cubic, rest, centre, half):  # type: ignore[no-untyped-def]
    """Bring a cubic (4,) of a curve into motion; what it then leaves out."""
    if motion.unit != 0.0:
        rest = _along(motion, cubic, rest, centre, half)
    for h in range(motion.times.size):
        times = motion.times[h]
        angle, size = centre * times, motion.size[curve, h]
        term = size * complex(np.cos(angle), np.sin(angle))
        for k in range(4):
            cubic[k] += term.real if motion.scalar else term
            term *= complex(0.0, times * half / (k + 1.0))
        rest += abs(size) * (times * half) ** 4.0 / 24.0
    return rest


@inner
def _along(motion, cubic, rest, centre, half):  # type: ignore[no-untyped-def]
    """The component along the axis in place of a vector."""
    remainder = rest
    for k in range(4):
        # a derivative is that of the polynomial and what that leaves out of it: i! / (i - k)!, and 4! / (4 - k)!
        largest, falling = 0.0, 1.0
        for i in range(1, k + 1):
            falling *= i
        for i in range(k, 4):
            largest += falling * abs(cubic[i])
            falling *= (i + 1.0) / (i + 1.0 - k)
        remainder += _BINOMIAL[k] * half ** (4.0 - k) * (largest + falling * rest)
    angle = motion.sense * centre
    there = motion.unit * complex(np.cos(angle), np.sin(angle))
    for k in range(3, -1, -1):
        total, term = 0.0, there
        for i in range(k, -1, -1):
            total += (term * cubic[i]).real
            term *= complex(0.0, motion.sense * half / (k - i + 1.0))
        cubic[k] = total
    return remainder
