"""Parts matched with counterweights as a workshop makes them: the best assignment, each with its best choice."""

from collections.abc import Callable, Iterator
from itertools import permutations
from typing import Any

import numpy as np
import pytest

from optimizer.analyze import analyze
from optimizer.errors import OutOfRange
from optimizer.optimize import optimize
from optimizer.studies.matching.match import match
from schemas.match.answer import MatchAnswer
from schemas.match.request import MatchRequest
from service.common.validation import InvalidRequest, check, pointer
from tests.night import part

Machine = dict[str, Any]
#: asked of the match and of every assignment by itself, of the yardstick
GAP = 1e-6
PISTONS, RODS = [14.0, 11.5, 9.0], [4.0, 2.5]


def machine(**changes: Any) -> Machine:
    """Three throws at right angles with a web beside each, which cannot carry all that is wanted."""
    cranks, places = (0.0, 90.0, 225.0), (-0.5, 0.0, 0.5)
    throws = [
        {"position_m": z, "crank_radius_m": 0.1, "crank_angle_deg": crank, "rotating_mass_kg": 6.0,
         "rows": [{"axis_deg": 90, "reciprocating_mass_kg": 3.0}]}
        for z, crank in zip(places, cranks, strict=True)
    ]  # fmt: skip
    webs = [
        {"name": str(n), "position_m": z - 0.1, "throw": n, "counterweight_radius_m": 0.15, "max_mass_kg": 5.0}
        for n, z in enumerate(places)
    ]
    return {"kind": "reciprocating", "speed_rpm": 600, "throws": throws, "webs": webs, **changes}


def on_webs(design: Machine, **fields: Any) -> Machine:
    return design | {"webs": [web | fields for web in design["webs"]]}


def cut(design: Machine) -> Machine:
    plate = {"shape": "sector", "inner_radius_m": 0.05, "outer_radius_m": 0.14, "thickness_m": 0.02}
    fields = ("name", "position_m", "throw")
    return design | {"webs": [{name: web[name] for name in fields} | {"envelope": plate} for web in design["webs"]]}


def fixed(design: Machine) -> Machine:
    design["webs"][1]["fixed"] = {"mass_kg": 2.0, "angle_deg": 200.0}
    design["webs"][1].pop("hole_angles_deg", None)
    return design


ALIKE = {"web_groups": [{"name": "two", "webs": ["0", "2"]}]}
MIRRORED = {"web_groups": [{"name": "two", "webs": ["0", "2"], "mirror": True}]}
STOCK = {"catalogue": {"masses_kg": [2.0, 3.5, 5.0], "angle_step_deg": 45}}
STEPS = {"catalogue": {"mass_step_kg": 0.5, "angle_step_deg": 30, "max_part_numbers": 1}, "max_counterweights": 2}

KINDS: dict[str, Callable[[], Machine]] = {
    "groups": lambda: machine(**ALIKE),
    "mirrored groups": lambda: machine(**MIRRORED),
    "a fixed weight": lambda: fixed(machine()),
    "a catalogue": lambda: machine(**STOCK),
    "one size, two pieces": lambda: machine(**STEPS),
    "holes beside a fixed weight": lambda: fixed(on_webs(machine(**STOCK), hole_angles_deg=[30.0, 170.0, 250.0])),
    "a catalogue in groups": lambda: machine(**STOCK, **MIRRORED),
    "minimum masses": lambda: on_webs(machine(), min_fitted_mass_kg=4.5),
    "minimum masses in groups": lambda: on_webs(machine(**ALIKE), min_fitted_mass_kg=4.0),
    "plates": lambda: cut(machine()),
    "plates in groups, under a budget": lambda: cut(machine(**ALIKE, max_total_mass_kg=5.0)),
}


def body(fields: Machine, **more: Any) -> dict[str, Any]:
    places = [{"throw": n, "row": 0} for n in range(2)]
    parts = [
        {"class": "piston", "names": ["P1", "P2", "P3"], "masses_kg": PISTONS},
        {"class": "rod", "names": ["R1", "R2"], "masses_kg": RODS, "rows": places},
    ]
    return {"machine": fields, "parts": parts, "choose_counterweights": True, "accuracy": {"relative_gap": GAP}} | more


def assignments() -> Iterator[tuple[float, ...]]:
    """What the rows get in each of the twelve."""
    for pistons in permutations(PISTONS):
        for rods in permutations(RODS):
            yield pistons[0] + rods[0], pistons[1] + rods[1], pistons[2]


def heavier(design: Machine, masses: tuple[float, ...]) -> Machine:
    throws = [
        throw | {"rows": [throw["rows"][0] | {"reciprocating_mass_kg": 3.0 + mass}]}
        for throw, mass in zip(design["throws"], masses, strict=True)
    ]
    return design | {"throws": throws}


#: those whose every assignment takes a second; every night: `pytest tests/studies/matching -m nightly`
LONG = ("minimum masses", "plates in groups, under a budget")


@pytest.mark.parametrize(
    "kind", part(2, (pytest.param(kind, marks=pytest.mark.nightly) if kind in LONG else kind for kind in KINDS))
)
def test_the_best_of_all_assignments(kind: str) -> None:
    """Brute force: every assignment optimised by itself (independent of the search and of its minorants)."""
    fields = KINDS[kind]()
    values, bounds = [], []
    for masses in assignments():
        answer = optimize({"machine": heavier(fields, masses), "accuracy": {"relative_gap": GAP, "time_limit_s": 30}})
        assert answer.certificate is not None
        assert answer.certificate.lower_bound is not None
        values.append(answer.certificate.objective)
        bounds.append(answer.certificate.lower_bound)
    reply = match(body(fields))
    proof = reply.certificate
    assert reply.status == "optimal"
    assert proof.lower_bound is not None
    size = proof.yardstick
    assert proof.objective == pytest.approx(min(values), abs=2 * GAP * size)
    assert proof.lower_bound <= min(values) + 1e-9 * size
    assert proof.objective >= min(bounds) - 1e-9 * size
    # as they are listed is the first
    assert proof.objective_as_listed == pytest.approx(values[0], abs=2 * GAP * size)
    judged(fields, reply)


def judged(design: Machine, answer: MatchAnswer) -> None:
    """The counterweights are those of the machine's rules, and the figures are theirs."""
    rows = tuple(row.reciprocating_mass_kg - 3.0 for row in answer.rows)
    free = [counterweight for counterweight in answer.counterweights if not counterweight.fixed]
    carried = [
        counterweight.model_dump(include={"web", "mass_kg", "angle_deg"})
        for counterweight in free
        if counterweight.mass_kg > 0
    ]
    again = analyze({"machine": heavier(design, rows), "counterweights": carried})
    assert again.residual is not None
    assert again.residual.after is not None
    assert again.residual.after.force.peak_N == pytest.approx(answer.residual.after.force.peak_N, rel=1e-12)
    mass = {counterweight.web: counterweight.mass_kg for counterweight in answer.counterweights}
    if "web_groups" in design:
        assert mass["0"] == mass["2"]
    least = design["webs"][0].get("min_fitted_mass_kg")
    if least is not None:
        assert all(weight == 0.0 or weight >= least for weight in mass.values())
    catalogue = design.get("catalogue", {})
    if "masses_kg" in catalogue:
        assert {counterweight.mass_kg for counterweight in free} <= {0.0, *catalogue["masses_kg"]}
    if "max_part_numbers" in catalogue:
        assert len({counterweight.mass_kg for counterweight in free} - {0.0}) <= 1
        assert sum(1 for counterweight in free if counterweight.mass_kg > 0.0) <= 2
    if "max_total_mass_kg" in design:
        assert sum(mass.values()) <= design["max_total_mass_kg"] * (1 + 1e-9)


def test_given_counterweights_are_as_they_are() -> None:
    """What the machine would choose from plays no part, and what was cut has the radius of its mass."""
    carried = [{"web": "0", "mass_kg": 1.2, "angle_deg": 170.0}]
    for design in (machine(**STOCK, **ALIKE), cut(machine(**ALIKE))):
        answer = match(body(design, choose_counterweights=False, counterweights=carried))
        best = np.inf
        for masses in assignments():
            after = analyze({"machine": heavier(design, masses), "counterweights": carried}).residual
            assert after is not None
            assert after.after is not None
            span = 1.1
            best = min(best, after.after.force.peak_N + after.after.moment.peak_Nm / span)
        assert answer.certificate.objective == pytest.approx(best, rel=1e-9)
        assert answer.status == "optimal"


def test_a_search_that_the_time_ends_says_its_gap() -> None:
    """Of each assignment 0.001 s is not enough for so many options; the bound is one of them all."""
    design = machine(catalogue={"mass_step_kg": 0.05, "angle_step_deg": 2, "max_part_numbers": 2})
    answer = match(body(design, accuracy={"relative_gap": 1e-9, "time_limit_s": 0.001}))
    assert answer.status == "inaccurate"
    assert "time" in answer.status_reason
    proof = answer.certificate
    assert proof.lower_bound is not None
    assert 0.0 < proof.lower_bound <= proof.objective


@pytest.mark.parametrize(
    ("function", "where"),
    [
        (lambda: machine(**STOCK, web_groups=[{"name": "g", "webs": ["0", "9"]}]), "/machine/web_groups/0/webs/1"),
        (lambda: machine(catalogue={"masses_kg": [2.0], "angle_step_deg": 7}), "/machine/catalogue/angle_step_deg"),
        (lambda: on_webs(machine(), max_mass_kg=None), "/machine/webs/0/max_mass_kg"),
        (lambda: on_webs(machine(**ALIKE), min_fitted_mass_kg=4.0, max_mass_kg=None), "/machine/webs/0/max_mass_kg"),
    ],
)
def test_what_cannot_be_chosen_names_its_field(function: Callable[[], Machine], where: str) -> None:
    with pytest.raises(InvalidRequest) as caught:
        check(MatchRequest, body(function()))
    assert where in [pointer(problem.path) for problem in caught.value.problems]


def test_what_is_found_out_later_names_its_field_too() -> None:
    heavy = [{"web": "0", "mass_kg": 100.0, "angle_deg": 0.0}]
    unlike = machine(**ALIKE)
    unlike["webs"][2]["max_mass_kg"] = 4.0
    for payload, where in (
        (body(cut(machine()), choose_counterweights=False, counterweights=heavy), "/counterweights/0/mass_kg"),
        (body(unlike), "/machine/web_groups/0/webs/1"),
    ):
        with pytest.raises(OutOfRange) as caught:
            match(payload)
        assert [pointer(problem.path) for problem in caught.value.problems] == [where]
