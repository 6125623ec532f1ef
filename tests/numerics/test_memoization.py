"""What is made once for all that asks for it."""

from optimizer.numerics.memoization import remembered, remembered_of_pair


def test_what_was_made_of_the_very_same_is_not_made_again() -> None:
    # regression: as many as there were different ones in turn
    values: list[tuple[object, ...]] = []

    @remembered
    def single(value: object) -> int:
        values.append((value,))
        return len(values)

    @remembered_of_pair
    def both(first: object, second: object) -> int:
        values.append((first, second))
        return len(values)

    # equal lists that are not the same
    first, second = [1], [1]
    assert [single(first), single(first), single(second), single(first)] == [1, 1, 2, 3]
    values.clear()
    assert [both(first, second), both(first, second)] == [1, 1]
    assert [both(second, second), both(second, first), both(first, second)] == [2, 3, 4]
    assert values[-1] == (first, second)
