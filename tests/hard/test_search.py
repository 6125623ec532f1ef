"""Searches for requests that break the certificate or the status; what they find is kept in cases/found.json.

``CHECKED_ANSWERS=every HARD_SEARCH=2000 pytest tests/hard/test_search.py`` searches that many at random; otherwise a
few, always the same.
Expected numbers are independent (the 100-digit reference) or analytic (symmetries of the problem).
"""

import json
import random
from collections.abc import Sequence
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import OptimizeRequest
from tests.hard.cases.case import Body, Case
from tests.hard.interior import mp
from tests.hard.judge import MASS_GAP, judge
from tests.hard.program import goal, machine
from tests.hard.reference import reference
from tests.hard.searches import search
from tests.hard.wild import in_other_units, requests
from tests.verification.checking import optimized

#: what is not certified says so: that is no fault of a wild machine
_HONEST = ("inaccurate, must be", "certified gap")


def _record(body: Body, faults: Sequence[str] = ()) -> str:
    """The request as cases/found.json keeps it, whole."""
    return "\n".join([*faults, json.dumps(body)])


def _answer(body: Body) -> OptimizeAnswer:
    try:
        return optimized(body)
    except Exception as error:
        error.add_note(_record(body))
        raise


@search(8)
@given(requests(max_webs=4))
def test_no_answer_is_wrong(body: Body) -> None:
    """Independent: whatever the status, bounds, objective, limits, masses and peaks agree with the reference."""
    answer = _answer(body)
    verdict = judge(Case("wild", "found by search", body, peaks_unique=False), answer, reference(body))
    faults = verdict.faults
    if answer.status == "inaccurate":
        # its point may be worse than the reference, its claims may not
        faults = [fault for fault in faults if not fault.startswith(_HONEST) and not _above(fault)]
    assert not faults, _record(body, faults)


def _above(fault: str) -> bool:
    return (fault.startswith("objective") and fault.endswith("above")) or "kg, least is" in fault


@search(30)
@given(requests(ceilings=False), st.randoms(use_true_random=False))
def test_no_point_is_below_the_bound(body: Body, rng: random.Random) -> None:
    """Analytic: random points within the limits never beat the certified bound."""
    answer = _answer(body)
    data = machine(body)
    objective = goal(body, data)
    bound = mp.mpf(answer.certificate.lower_bound) / data.omega_squared
    for _ in range(20):
        u = [mp.mpc(0)] * len(data.webs)
        left = data.budget
        for k, web in enumerate(data.webs):
            mass = web.max_mass * mp.mpf(rng.choice([0.0, 1.0, 10.0 ** rng.uniform(-12, 0)]))
            mass = mass if left is None else min(mass, left)
            left = None if left is None else left - mass
            turn = mp.expjpi(2 * mp.mpf(rng.random()))
            if web.cosine is not None:
                turn = web.centre * mp.mpc(web.cosine, web.sine * rng.choice([-1, 1]))
            u[k] = mass * web.radius * turn
        peak = objective.value(data.after(u))
        assert bound <= peak * (1 + mp.mpf("1e-13")) + sum(data.noise), _record(body)


@search(30)
@given(requests())
def test_optimal_keeps_its_word(body: Body) -> None:
    """Analytic: `optimal` means that gap, mass and limits hold in 100-digit numbers."""
    answer = _answer(body)
    if answer.status == "optimal":
        verdict = judge(Case("wild", "found by search", body), answer, None)
        assert not verdict.faults, _record(body, verdict.faults)


@search(30)
@given(requests(), st.integers(-12, 12), st.integers(-6, 6))
def test_units_by_powers_of_two_change_no_bit(body: Body, mass: int, length: int) -> None:
    """Analytic: kilograms and metres are counted in other units, and every figure only changes its exponent."""
    kilogram, metre = 2.0**mass, 2.0**length
    if not _inside(in_other_units(body, kilogram, metre)):
        return
    first, second = _answer(body), _answer(in_other_units(body, kilogram, metre))
    assert first.status == second.status, _record(body)
    newton, newton_metre = kilogram * metre, kilogram * metre**2
    for counterweight, second_counterweight in zip(first.counterweights, second.counterweights, strict=True):
        assert counterweight.mass_kg * kilogram == second_counterweight.mass_kg, _record(body)
        assert counterweight.angle_deg == second_counterweight.angle_deg, _record(body)
    if first.certificate is not None:
        assert first.residual.after.force.peak_N * newton == second.residual.after.force.peak_N, _record(body)
        assert first.residual.after.moment.peak_Nm * newton_metre == second.residual.after.moment.peak_Nm, _record(body)
        assert first.certificate.relative_gap == second.certificate.relative_gap, _record(body)
        assert first.certificate.lower_bound * newton == second.certificate.lower_bound, _record(body)


def _inside(body: Body) -> bool:
    """Whether the request is still within the ranges of the fields, and no length is so small that it counts as 0."""
    data = body["machine"]
    if any(0 < abs(plane["position_m"]) < 1e-200 for plane in (*data["throws"], *data["webs"])):
        return False
    try:
        OptimizeRequest.model_validate(body)
    except ValueError:
        return False
    return True


@search(24)
@given(requests(), st.randoms(use_true_random=False))
def test_the_order_of_webs_does_not_matter(body: Body, rng: random.Random) -> None:
    """Analytic: objective and mass are those of the same machine."""
    webs = list(body["machine"]["webs"])
    rng.shuffle(webs)
    _same(body, {**body, "machine": {**body["machine"], "webs": webs}})


@search(24)
@given(requests(max_webs=4), st.integers(0, 3))
def test_a_web_in_two_halves_is_the_same_web(body: Body, number: int) -> None:
    """Analytic: two webs of half the limit in one place do what one did."""
    webs = list(body["machine"]["webs"])
    split = webs[number % len(webs)]
    halves = [{**split, "name": f"{split['name']}{half}", "max_mass_kg": split["max_mass_kg"] / 2} for half in "ab"]
    webs[number % len(webs) : number % len(webs) + 1] = halves
    _same(body, {**body, "machine": {**body["machine"], "webs": webs}})


def _same(body: Body, second_body: Body) -> None:
    """The bounds of either answer hold for the other, and so do status, objective and mass."""
    first, second = _answer(body), _answer(second_body)
    data = machine(body)
    objective = goal(body, data)
    noise = 64 * float(sum((max((abs(t.share) for t in objective.terms if t.response == r), default=0) * data.noise[r]
                            for r in (0, 1)), mp.mpf(0)) * data.omega_squared)  # fmt: skip
    assert "infeasible" not in (first.status, second.status) or first.status == second.status, _record(body)
    if first.certificate is None or second.certificate is None:
        return
    # a ceiling may be exceeded by 1e-9, and what that is worth is not known here
    if any(name.endswith(("_N", "_Nm")) for name in body["objective"]):
        return
    for answer, two in ((first, second), (second, first)):
        a, b = answer.certificate, two.certificate
        rest = a.objective_without_counterweights
        assert a.lower_bound <= b.objective + 1e-13 * rest + noise, _record(body)
        if answer.status == two.status == "optimal":
            assert abs(a.objective - b.objective) <= 1.0001e-6 * rest + noise, _record(body)
            _same_mass(answer, two, body)


def _same_mass(answer: OptimizeAnswer, two: OptimizeAnswer, body: Any) -> None:
    """No bound of one is above the mass of the other, but for what optima may differ."""
    assert answer.certificate.mass_lower_bound_kg <= two.total_mass_kg * (1 + MASS_GAP), _record(body)
