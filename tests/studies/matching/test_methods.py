"""Every method of matching that is kept closes a gap that the others leave, at twelve rows or fewer."""

from tests.studies.matching.methods import Case, answer, gap


def test_sets_of_parts_prove_what_exchange_leaves_open() -> None:
    """Regression: ten rows, one class; docs/decisions/0009-matching-methods.md."""
    case = Case(10, 1, "the same from both ends")
    exchange, sets = (answer(case, 0, without) for without in (("exhausted", "near_to_nothing"), ("near_to_nothing",)))
    assert gap(exchange) > 1e-2
    assert exchange.status == "inaccurate"
    assert gap(sets) < 1e-9
    assert sets.status == "optimal"
    assert sets.certificate.objective <= exchange.certificate.objective


def test_four_lists_come_nearer_where_classes_balance() -> None:
    """Regression: twelve rows, two classes."""
    case = Case(12, 2, "the same from both ends")
    sets, lists = (answer(case, 1, without) for without in (("near_to_nothing",), ()))
    assert lists.certificate.objective < 0.6 * sets.certificate.objective
    assert lists.status == "optimal"
