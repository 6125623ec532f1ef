"""Places in rising lists; compiled."""

from optimizer.numerics.compiling import inner


@inner
def first_no_less(rows, value):  # type: ignore[no-untyped-def]
    """Which of rows (n, d), in rising order of their first coordinate, is first no less there; n if none is."""
    low, high = 0, len(rows)
    while low < high:
        middle = (low + high) // 2
        if rows[middle, 0] < value:
            low = middle + 1
        else:
            high = middle
    return low
