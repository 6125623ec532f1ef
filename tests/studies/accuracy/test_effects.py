"""The ladder of simulated effects."""

from functools import partial

import numpy as np
import pytest

from optimizer.analyze import analyze
from optimizer.mechanics.layout import layout
from optimizer.studies.accuracy.effects import (
    STEPS_DEG,
    _breaks,
    _by_panels,
    _by_samples,
    _by_search,
    _inertia_torque,
    _torque,
    effects_ladder,
)
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.accuracy import EffectRow
from schemas.request.requests import AnalyzeRequest
from schemas.request.scene import Fidelity
from tests.analyze.engines import engine
from tests.builders import RADIUS, machine, row, throw
from tests.studies.accuracy.problems import body


def compressor() -> ReciprocatingMachine:
    design = AnalyzeRequest.model_validate({"machine": body("2d12")["machine"]}).machine
    assert isinstance(design, ReciprocatingMachine)
    return design


def ladder(plan: ReciprocatingMachine) -> dict[tuple[str, str, str], EffectRow]:
    rows = effects_ladder(plan, layout(plan), 1)
    return {(row.quantity, row.method, row.setting): row for row in rows}


def errors(fields: dict[tuple[str, str, str], EffectRow], quantity: str) -> list[float]:
    """Errors of the samples, from coarse to fine."""
    chosen = [fields[quantity, "samples", f"{step:g} deg"].relative_error for step in STEPS_DEG]
    assert None not in chosen
    return [value for value in chosen if value is not None]


def test_the_reference_is_what_the_service_answers() -> None:
    """Independent of the ladder: mean torque and energy of /v1/analyze, with its own estimates."""
    query = AnalyzeRequest.model_validate({"machine": body("2d12")["machine"], "outputs": ["torque"]})
    torque = analyze(query).torque
    assert torque is not None
    coarse = ladder(compressor())
    plan = compressor()
    sampled = _by_samples(partial(_torque, plan, layout(plan), Fidelity()), 5.0)
    for quantity, figure, value in (
        ("mean_torque", "mean", torque.mean_torque_Nm),
        ("fluctuation_energy", "energy", torque.fluctuation_energy_J),
    ):
        relative_error = coarse[quantity, "samples", "5 deg"].relative_error
        assert relative_error == pytest.approx(abs(sampled[figure] - value) / value, rel=1e-6)  # type: ignore[index]
        own = coarse[quantity, "panels", "exact kinematics"].relative_error
        assert own is not None
        assert own < 1e-10


def test_samples_converge_to_the_panels() -> None:
    """Independent: two methods of integration meet; analytic: trapezoids with kinks fall as the square of the step."""
    scale = ladder(compressor())
    for quantity in ("mean_torque", "fluctuation_energy"):
        far = errors(scale, quantity)
        assert far[-1] < 1e-5
        assert far[-1] < 1e-3 * far[0]
    assert errors(scale, "peak_torque")[-1] < 1e-3
    assert errors(scale, "peak_torque")[0] > 0.05


def test_an_engine_is_looked_at_over_both_turns() -> None:
    """Independent: two methods of integration meet over the 720 degrees in which a cylinder fires once."""
    design = ReciprocatingMachine.model_validate(engine([0.0]))
    scale = ladder(design)
    for quantity in ("mean_torque", "fluctuation_energy"):
        assert errors(scale, quantity)[-1] < 1e-4
        own = scale[quantity, "panels", "exact kinematics"].relative_error
        assert own is not None
        assert own < 1e-9


def test_the_peak_is_above_every_sample_and_no_higher_than_the_densest() -> None:
    """Independent: 200,000 samples come within 1e-5 of the searched peak, from below."""
    plan = compressor()
    arrays = layout(plan)
    torque = partial(_torque, plan, arrays, Fidelity())
    peak = _by_search(torque, _breaks(plan, arrays, True))["peak"]
    dense = float(np.max(np.abs(torque(np.linspace(0.0, 2.0 * np.pi, 200_001)))))
    assert dense <= peak * (1.0 + 1e-12)
    assert dense == pytest.approx(peak, rel=1e-5)


def test_an_infinite_rod_gives_the_torque_of_a_sine() -> None:
    """Analytic: T = -1/2 m r^2 w^2 sin 2 phi for a scotch yoke: peak m r^2 w^2 / 2, energy range the same."""
    plan = machine(throw(0.0, row(0.0, 10.0, length_m=None)))
    arrays = layout(plan)
    scale = ladder(plan)
    size = 10.0 * RADIUS**2 * float(arrays.omega) ** 2
    # at 15 degrees the samples hold the peak at 45 degrees
    assert scale["peak_inertia_torque", "samples", "15 deg"].relative_error == pytest.approx(0.0, abs=1e-9)
    assert scale["peak_inertia_torque", "samples", "30 deg"].relative_error == pytest.approx(
        1.0 - np.sin(np.deg2rad(60.0)), abs=1e-9
    )
    # order 2 of an infinite rod is exact
    assert scale["inertia_fluctuation_energy", "panels", "kinematics of order 2"].relative_error == pytest.approx(
        0.0, abs=1e-9
    )
    torque = partial(_inertia_torque, plan, arrays, Fidelity())
    assert _by_panels(torque, _breaks(plan, arrays, False))["energy"] == pytest.approx(0.5 * size, rel=1e-9)
    assert _by_search(torque, _breaks(plan, arrays, False))["peak"] == pytest.approx(0.5 * size, rel=1e-9)


def test_the_second_order_is_off_by_the_square_of_the_rod_ratio() -> None:
    """Analytic: what the series leaves out is of order lambda^2 and more: a quarter for half the ratio, roughly."""
    shares = []
    for length in (0.7, 1.4):
        scale = ladder(machine(throw(0.0, row(0.0, 10.0, length_m=length))))
        share = scale["peak_inertia_torque", "search", "kinematics of order 2"].relative_error
        assert share is not None
        shares.append(share)
    assert 2.0 < shares[0] / shares[1] < 12.0


def test_only_machines_with_the_data_have_a_ladder() -> None:
    bare = machine(throw(0.0, row(0.0).model_copy(update={"connecting_rod": None})))
    rotating = machine(throw(0.0, rotating_kg=10.0))
    many = machine(*(throw(0.0, *(row(3.0 * k) for k in range(60))) for _ in range(2)))
    for plan in (bare, rotating, many):
        assert effects_ladder(plan, layout(plan), 1) == ()
    dry = compressor()
    throws = tuple(
        crank.model_copy(update={"rows": tuple(line.model_copy(update={"cylinder": None}) for line in crank.rows)})
        for crank in dry.throws
    )
    quantities = {key[0] for key in ladder(dry.model_copy(update={"throws": throws, "friction": None}))}
    assert quantities == {"peak_inertia_torque", "inertia_fluctuation_energy"}


def test_rows_without_a_mass_have_a_torque_of_nothing() -> None:
    """Regression: no panel held the peak of a torque that is 0 everywhere, and the search failed."""
    scale = ladder(machine(throw(0.0, row(90.0, 0.0))))
    assert scale
    assert all(not row.relative_error for row in scale.values())
