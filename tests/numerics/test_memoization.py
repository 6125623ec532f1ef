"""What is made once for all that asks for it."""

from optimizer.numerics.memoization import remembered, remembered_of_pair


def test_what_was_made_of_the_very_same_is_not_made_again() -> None:
    # regression: as many as there were different ones in turn
    made: list[tuple[object, ...]] = []

    @remembered
    def single(one: object) -> int:
        made.append((one,))
        return len(made)

    @remembered_of_pair
    def both(one: object, other: object) -> int:
        made.append((one, other))
        return len(made)

    # equal lists that are not the same
    first, second = [1], [1]
    assert [single(first), single(first), single(second), single(first)] == [1, 1, 2, 3]
    made.clear()
    assert [both(first, second), both(first, second)] == [1, 1]
    assert [both(second, second), both(second, first), both(first, second)] == [2, 3, 4]
    assert made[-1] == (first, second)
