"""Curves over the turn as sums over the rows, piece by piece; compiled.

Shapes: N designs of C curves, R rows, P pieces.
"""

import numpy as np

from optimizer.numerics.compiling import inner, kernel


@kernel
def sums_of_rows(weights, constant, points, bounds, radius, half):  # type: ignore[no-untyped-def]
    """Pieces of N C curves: cubics (N C, P, 4) in units of half widths, what they leave out (N C, P), and the size
    (N C,) of what is added up.

    Parameters
    ----------
    weights, constant : (N, C, R), (N, C).
    points : (1 or 2, 4, N, R, P) coefficients of the rows, of vectors real and imaginary parts.
    bounds, radius : (1 or 2, 1, N, R, P), (N, R, P) enclosures of the fourth.
    half : (N, P) rad.
    """
    number, curves, rows = weights.shape
    parts, pieces = points.shape[0], half.shape[1]
    cubic = np.empty((number * curves, pieces, 4), np.complex128)
    rest, size = np.empty((number * curves, pieces)), np.empty(number * curves)
    # coefficients and the bound's middle, each real and imaginary
    total, length = np.empty((2, 5, pieces)), np.empty((rows, pieces))
    added, off = np.empty(pieces), np.empty(pieces)
    for n in range(number):
        for r in range(rows):
            for p in range(pieces):
                length[r, p] = _length(points[0, 0, n, r, p], points[1, 0, n, r, p] if parts > 1 else 0.0)
        for c in range(curves):
            total[:], added[:], off[:] = 0.0, 0.0, 0.0
            for r in range(rows):
                weight = weights[n, c, r]
                if weight == 0.0:
                    continue
                share = abs(weight)
                for p in range(pieces):
                    added[p] += share * length[r, p]
                    off[p] += share * radius[n, r, p]
                for k in range(5):
                    one = points[0, k, n, r] if k < 4 else bounds[0, 0, n, r]
                    for p in range(pieces):
                        total[0, k, p] += weight.real * one[p]
                    if weight.imag != 0.0:
                        for p in range(pieces):
                            total[1, k, p] += weight.imag * one[p]
                    if parts > 1:
                        other = points[1, k, n, r] if k < 4 else bounds[1, 0, n, r]
                        for p in range(pieces):
                            total[0, k, p] -= weight.imag * other[p]
                            total[1, k, p] += weight.real * other[p]
            curve, largest = n * curves + c, 0.0
            for p in range(pieces):
                wide = 1.0
                for k in range(4):
                    cubic[curve, p, k] = complex(total[0, k, p] * wide, total[1, k, p] * wide)
                    wide *= half[n, p]
                cubic[curve, p, 0] += constant[n, c]
                rest[curve, p] = (_length(total[0, 4, p], total[1, 4, p]) + off[p]) * wide
                largest = max(largest, added[p])
            size[curve] = largest + abs(constant[n, c])
    return cubic, rest, size


@inner
def _length(along, across):  # type: ignore[no-untyped-def]
    """Magnitude of a vector; of a scalar for less."""
    return abs(along) if across == 0.0 else np.hypot(along, across)
