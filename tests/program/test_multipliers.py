"""Sharper multipliers: each has the property that it is made for, and proves what it says."""

from dataclasses import replace

import numpy as np
import pytest

from optimizer.program.certificate import Multipliers, mass_lower_bound, objective_lower_bound, spread
from optimizer.program.multipliers import (
    mass_multipliers,
    objective_multipliers,
    resting_multipliers,
    supporting_multipliers,
)
from optimizer.program.statement import Statement
from tests.program.test_leading_axes import KINDS, WEBS, _multipliers, _program

#: between all limits, in no sector
_INSIDE = np.array([0.3, 0.4j, -0.2, 0.1 - 0.1j])


def _slope(program: Statement, proof: Multipliers) -> np.ndarray:
    of_terms = np.sum(np.conj(program.norms.influence) * proof.term[:, None], axis=0)
    return of_terms + np.sum(np.conj(program.ceilings.norms.influence) * proof.ceiling[:, None], axis=0)


def _wide(kind: str, seed: int = 1) -> Statement:
    """With limits far from what is inside, and terms of which each tells something else."""
    program = _program(seed, kind)
    influence = np.random.default_rng(seed).normal(size=program.norms.influence.shape)
    return replace(
        program,
        norms=replace(program.norms, influence=influence),
        limits=replace(program.limits, max_mass=np.full(WEBS, 100.0)),
    )


@pytest.mark.parametrize("kind", [kind for kind in KINDS if "scatter" not in kind])
def test_what_needs_no_solver_proves_the_floor_and_the_machine_as_it_is(kind: str) -> None:
    """Analytic: where nothing may be fitted, both are the objective's own."""
    program = _program(2, kind)
    nothing = replace(program, limits=replace(program.limits, max_mass=np.zeros(WEBS)))
    floors, rest = resting_multipliers(nothing)
    assert np.all(floors.term == 0.0)
    largest = sum(max(nothing.floor[nothing.group == g]) for g in range(nothing.group[-1] + 1))
    assert objective_lower_bound(nothing, floors) == pytest.approx(largest, rel=1e-13)
    assert objective_lower_bound(nothing, rest) == pytest.approx(float(nothing.at_rest), rel=1e-13)
    assert not np.any(rest.ceiling)
    assert not np.any(floors.ceiling)


def test_terms_that_are_nothing_at_rest_have_no_multiplier() -> None:
    program = _program(2, "plain")
    program = replace(program, norms=replace(program.norms, constant=np.zeros(program.row.size, complex)))
    _, rest = resting_multipliers(program)
    assert np.all(rest.term == 0.0)


@pytest.mark.parametrize("kind", ["plain", "ceiling", "scalar, ceiling", "group", "scatter"])
def test_webs_between_their_limits_gain_nothing_by_the_nearest_multipliers(kind: str) -> None:
    """Property: the slope of every such web is 0, or what scattering costs; nothing nearer has that."""
    program = _wide(kind)
    solver = _multipliers(4, program)
    first, sharp = objective_multipliers(program, _INSIDE, solver)
    assert first is solver
    usable = solver.admissible(program)
    cost = np.broadcast_to(spread(program, usable), (WEBS,))
    np.testing.assert_allclose(_slope(program, sharp), -cost * _INSIDE / np.abs(_INSIDE), atol=1e-11)
    assert np.all(sharp.row >= usable.row)
    assert np.all(sharp.row[program.row] >= np.abs(sharp.term) * (1.0 - 1e-14))
    if any(program.norms.scalar):
        assert np.all(np.abs(sharp.term[np.array(program.norms.scalar)].imag) < 1e-14)


def test_a_touched_limit_leaves_the_multipliers_as_they_are() -> None:
    """At the budget nothing is sharpened, and a web at its own limit may gain."""
    program = _wide("plain")
    solver = _multipliers(4, program)
    limits = program.limits
    mass = float(program.mass(_INSIDE))
    for budget, count in ((mass, 1), (mass * (1.0 + 1e-7), 1), (mass * (1.0 + 1e-5), 2)):
        limited = replace(program, limits=replace(limits, max_total_mass=np.asarray(budget)))
        assert len(list(objective_multipliers(limited, _INSIDE, solver))) == count
    full = np.abs(_INSIDE) / limits.radius
    touching = replace(program, limits=replace(limits, max_mass=np.where(np.arange(WEBS) == 1, full, 100.0)))
    _, sharp = objective_multipliers(touching, _INSIDE, solver)
    assert np.flatnonzero(np.abs(_slope(touching, sharp)) > 1e-9).tolist() == [1]
    every = replace(program, limits=replace(limits, max_mass=full))
    assert len(list(objective_multipliers(every, _INSIDE, solver))) == 1


def test_a_web_at_the_edge_of_its_sector_touches_a_limit() -> None:
    program = _wide("plain")
    edge = np.exp(1j * np.deg2rad(30.0))
    ones = np.ones(WEBS)
    inside = np.abs(_INSIDE) * np.array([1.0, edge, np.conj(edge), np.exp(0.4j)])
    limits = replace(
        program.limits,
        free=ones < 0,
        centre=ones + 0j,
        half_angle_cos=edge.real * ones,
        half_angle_sin=edge.imag * ones,
    )
    _, sharp = objective_multipliers(replace(program, limits=limits), inside, _multipliers(4, program))
    # of the last the direction is within: 22.9 of 30 degrees
    assert np.flatnonzero(np.abs(_slope(program, sharp)) > 1e-9).tolist() == [1, 2]


@pytest.mark.parametrize("kind", ["plain", "ceiling", "scatter", "sector, budget"])
def test_a_mass_is_proven_by_as_much_as_no_untouched_web_gains_from(kind: str) -> None:
    """Analytic: by the sharper ones the web that gains most gains its own mass."""
    program = _program(1, kind)
    solver = _multipliers(4, program).times(np.asarray(50.0))
    point = program.limits.into(0.01 * _INSIDE)
    first, sharp = mass_multipliers(program, point, solver)
    assert first is solver
    cost = np.broadcast_to(spread(program, sharp), (WEBS,))
    worth = program.limits.radius * (program.limits.support(-_slope(program, sharp)) - cost)
    assert np.max(worth) == pytest.approx(1.0, rel=1e-12)
    assert np.max(worth) <= 1.0
    # what is worth no more than its mass stays
    assert len(list(mass_multipliers(program, point, sharp.times(np.asarray(0.9))))) == 1
    # a web that is full may gain
    gain = int(np.argmax(worth))
    full = np.where(np.arange(WEBS) == gain, np.abs(point) / program.limits.radius, program.limits.max_mass)
    touched = replace(program, limits=replace(program.limits, max_mass=np.maximum(full, 1e-9)))
    for mass_multiplier in list(mass_multipliers(touched, point, solver))[1:]:
        cost = np.broadcast_to(spread(touched, mass_multiplier), (WEBS,))
        radius = touched.limits.radius * (touched.limits.support(-_slope(touched, mass_multiplier)) - cost)
        assert np.max(np.delete(radius, gain)) == pytest.approx(1.0, rel=1e-12)


@pytest.mark.parametrize("kind", ["plain", "ceiling"])
def test_multipliers_hold_up_a_mass_where_every_web_is_worth_it(kind: str) -> None:
    """Analytic: R conj(H) y = -u/|u|, by terms and ceilings together; two webs have two responses for that."""
    program = _wide(kind).only(np.array([True, False, False, True]))
    u = _INSIDE[[0, 3]]
    multipliers = list(supporting_multipliers(program, u))
    assert len(multipliers) == (2 if "ceiling" in kind else 1)
    for proof in multipliers:
        np.testing.assert_allclose(_slope(program, proof) * program.limits.radius, -u / np.abs(u), atol=1e-10)
        assert np.all(proof.row[program.row] >= np.abs(proof.term))
        assert mass_lower_bound(program, proof, program.objective(u)) <= program.mass(u) * (1.0 + 1e-12)
    if "ceiling" in kind:
        assert not np.any(multipliers[1].term)
        assert np.any(multipliers[0].term)
    # what carries nothing, or next to nothing, holds nothing up
    assert list(supporting_multipliers(program, np.zeros(2, complex))) == []
    (actual_multipliers, *_) = supporting_multipliers(program, np.array([u[0], 1e-8 * u[1]]))
    assert _slope(program, actual_multipliers)[0] * program.limits.radius[0] == pytest.approx(
        -u[0] / abs(u[0]), rel=1e-10
    )
