"""Where curves over the turn cross a level, by the cubics of their pieces; compiled.

Shapes: N curves of P pieces each.
"""

import numpy as np

from optimizer.numerics.compiling import inner, kernel

#: halvings of an interval, between which Newton's method takes over
_STEPS = 24


@kernel
def crossings(cubic, half, level):  # type: ignore[no-untyped-def]
    """Curves (m,), pieces, places from -1 to 1 and the bounds of these at which cubics (N, P, 4) are levels (N,).

    Then the curves and pieces at whose first ends they jump across. Pieces without half widths (N, P) are none.
    """
    number, pieces = half.shape
    curve, piece = np.empty(3 * number * pieces, np.int64), np.empty(3 * number * pieces, np.int64)
    place, low, high = np.empty(curve.size), np.empty(curve.size), np.empty(curve.size)
    jumped, at = np.empty(number * pieces, np.int64), np.empty(number * pieces, np.int64)
    ends, value, one = np.empty(4), np.empty(4), np.empty(4)
    count, jumps = 0, 0
    for n in range(number):
        before = np.nan
        # what comes before the first piece is the last that has a width
        for p in range(pieces):
            if half[n, p] > 0.0:
                _shifted(cubic[n, p], level[n], one)
                before = _at(one, 1.0)
        for p in range(pieces):
            if not half[n, p] > 0.0:
                continue
            _shifted(cubic[n, p], level[n], one)
            _turning(one, ends)
            for k in range(4):
                value[k] = _at(one, ends[k])
            if before * value[0] <= 0.0:
                jumped[jumps], at[jumps] = n, p
                jumps += 1
            before = value[3]
            # between its ends and where it turns a cubic has at most one root
            for k in range(3):
                if value[k] * value[k + 1] < 0.0:
                    curve[count], piece[count], low[count], high[count] = n, p, ends[k], ends[k + 1]
                    place[count] = _root(one, ends[k], ends[k + 1], value[k])
                    count += 1
    return (
        (curve[:count].copy(), piece[:count].copy()),
        place[:count].copy(),
        (low[:count].copy(), high[:count].copy()),
        (jumped[:jumps].copy(), at[:jumps].copy()),
    )


@inner
def _shifted(cubic, level, out):  # type: ignore[no-untyped-def]
    """A cubic (4,), of which the real part counts, above a level."""
    for k in range(4):
        out[k] = cubic[k].real
    out[0] -= level


@inner
def _at(cubic, place):  # type: ignore[no-untyped-def]
    return cubic[0] + place * (cubic[1] + place * (cubic[2] + place * cubic[3]))


@inner
def _turning(cubic, ends):  # type: ignore[no-untyped-def]
    """Both ends of a piece and where its cubic turns between, rising; where it does not, an end."""
    slope, bend, third = cubic[1], cubic[2], cubic[3]
    square = bend * bend - 3.0 * slope * third
    # the larger root first, the smaller by it: nothing cancels
    larger = -(bend + np.copysign(np.sqrt(max(square, 0.0)), bend))
    one, other = larger / (3.0 * third), slope / larger
    one = min(max(one, -1.0), 1.0) if square > 0.0 and np.isfinite(one) else 1.0
    other = min(max(other, -1.0), 1.0) if square > 0.0 and np.isfinite(other) else 1.0
    ends[0], ends[1], ends[2], ends[3] = -1.0, min(one, other), max(one, other), 1.0


@inner
def _root(cubic, low, high, at_low):  # type: ignore[no-untyped-def]
    """Root of a cubic that changes its sign once between low and high."""
    place = 0.5 * (low + high)
    for _ in range(_STEPS):
        value = _at(cubic, place)
        if value * at_low > 0.0:
            low = place
        else:
            high = place
        slope = cubic[1] + place * (2.0 * cubic[2] + place * 3.0 * cubic[3])
        step = place - value / (1.0 if slope == 0.0 else slope)
        place = step if low < step < high else 0.5 * (low + high)
    return place
