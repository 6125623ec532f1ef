"""Bad input names the field."""

from copy import deepcopy
from typing import Any

import pytest

from schemas.match.request import MatchRequest
from service.common.validation import InvalidRequest, check, pointer
from tests.studies.matching.cases import machine, parts

BODY: dict[str, Any] = {"machine": machine([0.0, 180.0], [0.0, 0.0], (0.0,)), "parts": parts(1, 2)}


def refused(**changes: Any) -> list[str]:
    with pytest.raises(InvalidRequest) as caught:
        check(MatchRequest, {**deepcopy(BODY), **changes})
    return [pointer(problem.path) for problem in caught.value.problems]


def part(**changes: Any) -> dict[str, Any]:
    return {**parts(1, 2)[0], **changes}


@pytest.mark.parametrize(
    ("changes", "where"),
    [
        ({"parts": []}, "/parts"),
        ({"parts": [part(names=["a"], masses_kg=[1.0])]}, "/parts/0/names"),
        ({"parts": [part(names=["a", "b", "c"], masses_kg=[1.0, 2.0, 3.0])]}, "/parts/0/names"),
        ({"parts": [part(names=[], masses_kg=[])]}, "/parts/0/names"),
        ({"parts": [part(names=["a", "a"])]}, "/parts/0/names/1"),
        ({"parts": [part(masses_kg=[1.0])]}, "/parts/0/masses_kg"),
        ({"parts": [part(masses_kg=[1.0, -1.0])]}, "/parts/0/masses_kg/1"),
        ({"parts": [part(), part()]}, "/parts/1/class"),
        ({"parts": [part(rows=[])]}, "/parts/0/rows"),
        ({"parts": [part(rows=[{"throw": 0, "row": 0}, {"throw": 2, "row": 0}])]}, "/parts/0/rows/1"),
        ({"parts": [part(rows=[{"throw": 0, "row": 0}, {"throw": 0, "row": 0}])]}, "/parts/0/rows/1"),
        ({"parts": [part(rows=[{"throw": -1, "row": 0}, {"throw": 1, "row": 0}])]}, "/parts/0/rows/0/throw"),
        ({"balance_nuts_kg": [-0.1]}, "/balance_nuts_kg/0"),
        ({"counterweights": [{"web": "x", "mass_kg": 1, "angle_deg": 0}]}, "/counterweights/0/web"),
        (
            {"counterweights": [{"web": "w0", "mass_kg": 1, "angle_deg": 0}], "choose_counterweights": True},
            "/counterweights",
        ),
        ({"objective": {"force_ceiling_N": 1.0}}, "/objective/force_ceiling_N"),
        ({"objective": {"bearing_weight": 1.0}}, "/objective/bearing_weight"),
        ({"objective": {"orders": "all"}}, "/objective/orders"),
        ({"accuracy": {"relative_gap": 0}}, "/accuracy/relative_gap"),
        ({"machine": {"kind": "scroll"}}, "/machine/kind"),
    ],
)
def test_the_field_is_named(changes: dict[str, Any], where: str) -> None:
    assert where in refused(**changes)


def test_parts_need_rows_and_chosen_counterweights_a_limit() -> None:
    variant = deepcopy(BODY["machine"])
    variant["webs"][0]["max_mass_kg"] = None
    assert refused(machine=variant, choose_counterweights=True) == ["/machine/webs/0/max_mass_kg"]
    for throw in variant["throws"]:
        throw["rows"] = []
    assert "/machine/throws" in refused(machine=variant)


@pytest.mark.parametrize(
    ("rows", "parts_", "text"),
    [
        (1, 2, "there is 1 row for 2 parts"),
        (2, 1, "there are 2 rows for 1 part"),
        (2, 3, "there are 2 rows for 3 parts"),
    ],
)
def test_rows_and_parts_are_counted(rows: int, parts_: int, text: str) -> None:
    piece = part(names=[str(k) for k in range(parts_)], masses_kg=[1.0] * parts_)
    piece["rows"] = [{"throw": k, "row": 0} for k in range(rows)]
    with pytest.raises(InvalidRequest) as caught:
        check(MatchRequest, {**deepcopy(BODY), "parts": [piece]})
    assert [problem.message.split(";")[0] for problem in caught.value.problems] == [text]
