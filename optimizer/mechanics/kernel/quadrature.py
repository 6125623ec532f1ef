"""Parts and nodes of Gauss-Legendre quadratures of curves over pieces of the turn, element by element; compiled.

By arrays every step is an operation of its own, which costs more than its arithmetic.

Shapes: N designs of C curves, P pieces, n nodes.
"""

import numpy as np

from optimizer.numerics.compiling import in_place


@in_place
def equal_parts(left_out, size, share, order, most, parts):  # type: ignore[no-untyped-def]
    """Write into how many equal parts pieces are cut, so that no curve is short by more than a share of its size.

    Parameters
    ----------
    left_out : (N, C, P) what polynomials of the quadrature's degree leave out of pieces.
    size : (N, C) of the curves.
    order : power of the parts by which less is left out in each.
    most : parts of a piece at most.
    parts : (N, P) that are written.
    """
    designs, curves, pieces = left_out.shape
    for d in range(designs):
        for p in range(pieces):
            largest = 0.0
            for c in range(curves):
                largest = max(largest, left_out[d, c, p] / (size[d, c] if size[d, c] > 0.0 else 1.0))
            parts[d, p] = min(max(np.ceil((largest / share) ** (1.0 / order)), 1.0), most)


@in_place
def gauss_nodes(centre, half, parts, node, weight, angle, within, share):  # type: ignore[no-untyped-def]
    """Write the nodes of all parts, those of one piece after those of another.

    A design that has fewer than others has its last ones once more, which count for nothing.

    Parameters
    ----------
    centre, half, parts : (N, P) rad, rad, and equal parts of each piece.
    node, weight : of a part, from -1 to 1.
    angle, within, share : (N, n) rad, centres [rad] of the pieces in which they are, and half widths of the parts times
        weights, which are written.
    """
    designs, pieces = centre.shape
    for d in range(designs):
        n = 0
        for p in range(pieces):
            wide, count = half[d, p], parts[d, p]
            own = wide / count
            for number in range(int(count)):
                middle = centre[d, p] + wide * ((2.0 * number + 1.0) / count - 1.0)
                for k in range(node.size):
                    angle[d, n], within[d, n] = middle + own * node[k], centre[d, p]
                    share[d, n] = own * weight[k]
                    n += 1
        for k in range(n, angle.shape[1]):
            angle[d, k], within[d, k], share[d, k] = angle[d, n - 1], within[d, n - 1], share[d, n - 1]
