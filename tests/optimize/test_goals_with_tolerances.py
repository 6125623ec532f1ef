"""Goals in their order where reciprocating masses are off: each is judged with the masses that are worst for itself."""

from typing import Any

import pytest

from optimizer.optimize import optimize
from tests.pairs.asking import body_of

EXTERNAL = {"goal": "external", "allowance": 0.05}
STEPS = {"masses_kg": [3.0, 6.0, 12.0], "angle_step_deg": 30.0}
#: kinds of counterweights, by what a machine has for them
KINDS: dict[str, dict[str, Any]] = {"any masses": {}, "a catalogue": {"catalogue": STEPS}}


@pytest.mark.parametrize("kind", KINDS)
def test_an_earlier_goal_comes_to_its_own_worst_case(kind: str) -> None:
    """Independent: the same goal alone. With the masses that are worst for the answer it came to 2 % less."""
    body: dict[str, Any] = body_of("twin", []) or {}
    body |= {"machine": body["machine"] | KINDS[kind], "tolerances": {"reciprocating_mass_relative": 0.2}}
    ordered = optimize(body | {"objective": {"priorities": [EXTERNAL, {"goal": "mass"}]}})
    proof, alone = ordered.certificate, optimize(body).certificate
    assert proof is not None
    assert alone is not None
    external, mass = proof.goals
    size = 1e-6 * alone.yardstick
    assert external.value == pytest.approx(alone.objective, rel=0, abs=size)
    assert external.lower_bound == pytest.approx(alone.lower_bound, rel=0, abs=size)
    # analytic: the allowance is a share of the reference value
    assert external.limit == pytest.approx(alone.objective + 0.05 * alone.yardstick, rel=0, abs=2 * size)
    assert proof.objective <= external.limit
    assert mass.value == ordered.total_mass_kg


def test_time_that_ends_leaves_no_goal_below_its_own_worst_case(monkeypatch: pytest.MonkeyPatch) -> None:
    """Independent: the same goal alone, where after the first round no time was left for worse masses."""
    body: dict[str, Any] = body_of("twin", []) or {}
    body |= {"machine": body["machine"] | KINDS["a catalogue"], "tolerances": {"reciprocating_mass_relative": 0.2}}
    alone = optimize(body).certificate
    monkeypatch.setattr("optimizer.solve.choice.MOST_ROUNDS", 1)
    proof = optimize(body | {"objective": {"priorities": [EXTERNAL, {"goal": "mass"}]}}).certificate
    assert proof is not None
    assert alone is not None
    assert alone.lower_bound is not None
    external, _ = proof.goals
    assert external.value >= alone.lower_bound
    assert external.value <= external.limit
    assert proof.objective <= external.limit
