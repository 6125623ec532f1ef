"""Whatever stands in a request or in an answer of any kind is judged or refused, and nothing is raised."""

import random

import pytest

from tests.verification.answers import pair
from tests.verification.anything import judged, paths, replaced

#: one of each kind of program
KINDS = ("plates, sectors", "balance shaft", "tolerances", "matching")
MORE = (
    "roll", "balance shaft, orders", "scenarios over the turn", "priorities", "ceilings over the turn", "bending",
    "infeasible over the turn", "continuous shaft", "groups", "bearings, rms", "catalogue over the turn",
)  # fmt: skip
VALUES = (
    None, True, 0, -1, 1, 1e308, -1e308, 5e-324, float("nan"), float("inf"), 10**400, "", "x", "5 kg", "\ud800", [], {},
    [[]], {"name": "a"}, [None], 1e-9, 0.5, 3, "bearing:A", "roll", "force:x", 2**70,
)  # fmt: skip


def changed(name: str, count: int, seed: int) -> None:
    """So many times one to three places of request and answer hold something else."""
    request, answer = pair(name)
    fields = {"request": request, "answer": answer}
    chance, places = random.Random(seed), [path for path in paths(fields) if path]
    for _ in range(count):
        variant = fields
        for path in chance.sample(places, chance.randint(1, 3)):
            try:
                variant = replaced(variant, path, chance.choice(VALUES))
            except TypeError:
                # what it stood in is no longer there
                continue
        judged(variant["request"], variant["answer"])


@pytest.mark.parametrize("name", KINDS)
def test_some_of_anything_is_judged(name: str) -> None:
    changed(name, 25, 1)


@pytest.mark.nightly
@pytest.mark.parametrize("name", [*KINDS, *MORE])
def test_anything_is_judged(name: str) -> None:
    changed(name, 500, 2)


#: what once raised: kind, place, value
ONCE_RAISED = (
    ("roll", ("request", "machine", "throws", 0, "crank_radius_m"), -1e308),
    ("roll", ("request", "machine", "throws", 0, "rows", 1, "reciprocating_mass_kg"), -1e308),
    ("roll", ("request", "machine", "throws", 0, "rows", 1, "connecting_rod", "length_m"), 1e308),
    ("scenarios over the turn", ("request", "machine", "throws", 0, "crank_radius_m"), 0.5),
    (
        "scenarios over the turn",
        ("answer", "certificate", "multipliers", "objective", "terms", 11, "angle_deg"),
        1,
    ),
)


@pytest.mark.parametrize(("name", "path", "value"), ONCE_RAISED)
def test_what_once_raised_is_judged(name: str, path: tuple[str | int, ...], value: float) -> None:
    request, answer = pair(name)
    variant = replaced({"request": request, "answer": answer}, path, value)
    judged(variant["request"], variant["answer"])


def test_counterweights_of_another_machine_are_broken() -> None:
    """Groups of webs that the answer does not have once raised."""
    request, _ = pair("groups")
    _, answer = pair("scroll-oldham")
    judged(request, answer)
