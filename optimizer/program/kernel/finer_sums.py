"""Sums of products in twice the digits of double numbers, compiled.

Every product and every sum is had with what it was rounded by, and these are summed beside (Ogita, Rump and Oishi,
SIAM J. Sci. Comput. 26 (2005), algorithm 5.3): a sum of n products is off by less than eps of itself and
(n eps)^2 of the sum of their magnitudes.
"""

from optimizer.program.kernel.compiling import inner

#: 2^27 + 1, which splits a number into two halves of its digits (Dekker 1971)
_SPLITTER = 134217729.0


@inner
def add_product(total, rest, a, b):  # type: ignore[no-untyped-def]
    """total + a b, and the rest + what that was rounded by."""
    product = a * b
    large = _SPLITTER * a
    a_high = large - (large - a)
    a_low = a - a_high
    large = _SPLITTER * b
    b_high = large - (large - b)
    b_low = b - b_high
    off = a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low)
    new = total + product
    step = new - total
    return new, rest + (((total - (new - step)) + (product - step)) + off)
