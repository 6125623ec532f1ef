"""A pseudo-random permutation of numbers, compiled: :func:`optimizer.studies.sweep.designs.permuted`.

A Feistel network on the smallest domain of 2^bits that holds all numbers. Those that it sends beyond are sent on until
they come back (cycle walking), which keeps it one to one.
"""

import numpy as np

from optimizer.numerics.compiling import in_place, inner


@in_place
def permute(numbers, count, bits, keys, places, beyond):  # type: ignore[no-untyped-def]
    """Some of the numbers 0..count-1 to where they are sent, in place.

    Parameters
    ----------
    numbers : (n,) uint64.
    bits : those of count - 1, at least 2.
    keys : (rounds,) uint64, an even number.
    places, beyond : (n,) int64 and uint64, work.
    """
    _send(numbers, numbers.size, bits, keys)
    left = 0
    for n in range(numbers.size):
        if numbers[n] >= count:
            places[left], beyond[left] = n, numbers[n]
            left += 1
    while left > 0:
        _send(beyond, left, bits, keys)
        still = 0
        for n in range(left):
            if beyond[n] >= count:
                places[still], beyond[still] = places[n], beyond[n]
                still += 1
            else:
                numbers[places[n]] = beyond[n]
        left = still


@inner
def _send(numbers, size, bits, keys):  # type: ignore[no-untyped-def]
    """Keyed permutation of 0..2^bits-1 of the first of some numbers, in place, all of them one round at a time."""
    unit = np.uint64(1)
    low_bits = np.uint64(bits // 2)
    high_bits = np.uint64(bits) - low_bits
    for key in keys:
        low_mask, high_mask = (unit << low_bits) - unit, (unit << high_bits) - unit
        for n in range(size):
            high, low = numbers[n] >> low_bits, numbers[n] & low_mask
            # finaliser of splitmix64 (Steele, Lea, Flood 2014): every bit depends on every bit
            word = low + key
            word = (word ^ (word >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
            word = (word ^ (word >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
            word = word ^ (word >> np.uint64(31))
            # the halves change places, and with them their widths
            numbers[n] = (low << high_bits) | ((high ^ word) & high_mask)
        low_bits, high_bits = high_bits, low_bits
