"""Assignments of weighed parts: each part is on one row, and rows weigh what is on them."""

import copy
from collections.abc import Callable
from typing import Any

import pytest

from schemas.match.request import MatchRequest
from service.verification import checker
from tests.studies.matching.cases import machine, matched, parts
from tests.verification.answers import pair

Answer = dict[str, Any]


@pytest.fixture(scope="module")
def files() -> tuple[Answer, Answer]:
    """A request as it is read, and its answer."""
    body = {"machine": machine([0.0, 180.0, 90.0, 270.0], [0.0] * 4), "parts": parts(1, 4, 4)}
    request = MatchRequest.model_validate(body).model_dump(mode="json", by_alias=True)
    return request, matched(body).model_dump(mode="json", by_alias=True)


def test_a_genuine_assignment_is_held(files: tuple[Answer, Answer]) -> None:
    """Independent: all assignments are compared here, one after the other."""
    verdict = checker().verify(*files)
    assert verdict["verdict"] == "held"
    assert {"assignments", "rows", "objective", "lower_bound", "before", "after"} <= {
        claim["claim"] for claim in verdict["claims"]
    }


def test_a_fixed_weight_is_on_its_web_whatever_is_listed() -> None:
    """Regression: it was taken for a counterweight that nobody asked for."""
    design = machine([0.0, 180.0, 90.0, 270.0], [0.0] * 4)
    place = {"name": "w", "position_m": 0.1, "counterweight_radius_m": 0.2}
    design["webs"] = [place | {"fixed": {"mass_kg": 2.0, "angle_deg": 30.0}}]
    body = {"machine": design, "parts": parts(1, 4, 4)}
    fields = MatchRequest.model_validate(body).model_dump(mode="json", by_alias=True)
    answer = matched(body).model_dump(mode="json", by_alias=True)
    assert checker().verify(fields, answer)["verdict"] == "held"
    answer["counterweights"][0]["mass_kg"] = 2.1
    assert checker().verify(fields, answer)["verdict"] == "broken"


@pytest.mark.parametrize(("where", "field"), [("assignments", "throw"), ("rows", "throw")])
def test_a_row_is_named_by_whole_numbers(files: tuple[Answer, Answer], where: str, field: str) -> None:
    """Regression: the fraction of a number was cut off."""
    request, answer = files[0], copy.deepcopy(files[1])
    assignment = next(row for row in answer[where] if row[field])
    assignment[field] *= 1.001
    assert checker().verify(request, answer)["verdict"] == "broken"


def swap_names(answer: Answer) -> None:
    first, second = answer["assignments"][:2]
    first["part"], second["part"] = second["part"], first["part"]


def double(answer: Answer) -> None:
    answer["assignments"][1]["part"] = answer["assignments"][0]["part"]


def drop(answer: Answer) -> None:
    del answer["assignments"][0]


def elsewhere(answer: Answer) -> None:
    answer["assignments"][0]["throw"] = 9


def lighter(answer: Answer) -> None:
    answer["rows"][0]["reciprocating_mass_kg"] -= 0.01


def fewer_rows(answer: Answer) -> None:
    answer["rows"].pop()


def without_mass(answer: Answer) -> None:
    del answer["assignments"][0]["mass_kg"]


def without_proof(answer: Answer) -> None:
    del answer["certificate"]["lower_bound"]


@pytest.mark.parametrize(
    "tampered", [swap_names, double, drop, elsewhere, lighter, fewer_rows, without_mass, without_proof]
)
def test_what_is_wrong_with_it_is_broken(files: tuple[Answer, Answer], tampered: Callable[[Answer], None]) -> None:
    request, answer = copy.deepcopy(files)
    tampered(answer)
    assert checker().verify(request, answer)["verdict"] == "broken"


def better_bound(answer: Answer) -> None:
    answer["certificate"]["lower_bound"] = answer["certificate"]["objective"] * 1.01


@pytest.mark.parametrize("factor", [1.0, 1.001])
@pytest.mark.parametrize("across", [(1.0, 1.0), (1.0, 0.2), (0.3, 1.0)])
def test_a_bound_is_below_all_assignments(across: tuple[float, float], factor: float) -> None:
    """Independent: all assignments, whose best comes from the answer's own search."""
    weights = dict(zip("xy", across, strict=True))
    body = {
        "machine": machine([0.0, 100.0, 220.0], [0.0] * 3),
        "parts": parts(5, 3, 3),
        "objective": {"direction_weights": weights},
    }
    request, answer = MatchRequest.model_validate(body).model_dump(mode="json", by_alias=True), matched(body)
    wrong = answer.model_dump(mode="json", by_alias=True)
    wrong["certificate"]["lower_bound"] = wrong["certificate"]["objective"] * factor
    claims = {claim["claim"]: claim["verdict"] for claim in checker().verify(request, wrong)["claims"]}
    assert claims["lower_bound"] == ("held" if factor == 1.0 else "broken")


@pytest.mark.parametrize("tampered", [swap_names, better_bound])
def test_nuts_are_on_rows_or_beside_the_machine(tampered: Callable[[Answer], None]) -> None:
    request, answer = pair("matching")
    assert checker().verify(request, answer)["verdict"] == "held"
    nut = answer["spares"].pop()
    assert checker().verify(request, answer)["verdict"] == "broken"
    answer["spares"].append(nut)
    tampered(answer)
    assert checker().verify(request, answer)["verdict"] == "broken"


def test_parts_beside_a_heavy_row_are_compared_to_their_last_digits() -> None:
    """Regression: what a part does was the difference of two machines, in which a heavy row left few digits of it."""
    body = {
        "machine": machine([0.0, 90.0, 70.0], [180.0, 90.0, 120.0]),
        "parts": [{"class": "part", "names": ["a", "b", "c"], "masses_kg": [4.1e5, 4.7e5, 4.3e5]}],
        "objective": {"direction_weights": {"x": 0.0, "y": 1.0}, "moment_weight": 0.0},
    }
    body["machine"]["throws"][0]["rows"][0]["reciprocating_mass_kg"] = 3e11
    answer = matched(body).model_dump(mode="json", by_alias=True)
    assert checker().verify(body, answer)["verdict"] == "held"
    answer["certificate"]["lower_bound"] *= 1.0 + 1e-7
    assert checker().verify(body, answer)["verdict"] == "broken"


def _with_weights(**limits: Any) -> Answer:
    """Two cranks whose counterweights are there already, beyond the limits of what would be chosen."""
    webs = [
        {"name": name, "position_m": z, "counterweight_radius_m": 0.2, "max_mass_kg": 1.0, **limits}
        for name, z in (("a", -0.4), ("b", 0.4), ("c", 0.0))
    ]
    body = {
        "machine": machine([0.0, 100.0], [0.0] * 2),
        "parts": parts(5, 2, 2),
        "counterweights": [
            {"web": "a", "mass_kg": 3.0, "angle_deg": 20.0},
            {"web": "b", "mass_kg": 2.0, "angle_deg": 500.0},
            {"web": "c", "mass_kg": 0.0, "angle_deg": 77.0},
        ],
    }
    body["machine"] |= {"webs": webs, "max_total_mass_kg": 1.0, "web_groups": [{"name": "all", "webs": ["a", "b"]}]}
    return body


def test_what_is_on_the_machine_keeps_no_limits() -> None:
    """Limits, sectors and groups are of what is chosen; one of no mass has no angle."""
    body = _with_weights(sector={"centre_deg": 180.0, "half_angle_deg": 10.0})
    answer = matched(body)
    assert [weight.angle_deg for weight in answer.counterweights] == [20.0, 140.0, 0.0]
    document = answer.model_dump(mode="json", by_alias=True)
    assert checker().verify(body, document)["verdict"] == "held"
    # not that of the request, though all that is made of it agrees
    turned = copy.deepcopy(body)
    turned["counterweights"][1]["angle_deg"] = 141.0
    assert checker().verify(turned, document)["verdict"] == "broken"
