"""The mean over the symmetries of a program: alike where the program is, no worse in any term, no heavier."""

import json
from pathlib import Path

import numpy as np
import pytest

from optimizer.formulation.formulate import responses
from optimizer.formulation.goals import cone_program
from optimizer.mechanics.inertia import reciprocating, rotating
from optimizer.mechanics.layout import layout
from optimizer.numerics.arrays import Complex
from optimizer.optimize import optimize
from optimizer.program.methods.symmetry import symmetric
from optimizer.program.statement import Statement
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.machine.webs import Sector, Web
from schemas.request.objective import Objective
from schemas.request.requests import OptimizeRequest
from tests.builders import machine, throw, web

EXAMPLES = Path(__file__).parents[2] / "examples"
PLANES = (-0.5, -0.2, 0.2, 0.5)


def program(design: ReciprocatingMachine, **objective: float) -> Statement:
    plan = layout(design)
    quantities = responses(plan, rotating(plan).plus(reciprocating(plan, 1)), Objective())
    return cone_program(design, Objective.model_validate(objective), quantities, plan.omega**2).alone()


def two_throws(first: float, second: float, webs: list[Web], kg: tuple[float, float] = (9.0, 9.0)) -> Statement:
    throws = [throw(a, z=z, rotating_kg=m) for a, z, m in zip((first, second), (-0.3, 0.3), kg, strict=True)]
    return program(machine(*throws, webs=webs))


def four_webs() -> list[Web]:
    return [web(str(k), z) for k, z in enumerate(PLANES)]


def some(webs: int) -> Complex:
    rng = np.random.default_rng(7)
    return (rng.uniform(-1, 1, webs) + 1j * rng.uniform(-1, 1, webs))[None]


def no_worse(statement: Statement, u: Complex, values: Complex) -> bool:
    sizes = np.all(statement.norms.sizes(values) <= statement.norms.sizes(u) * (1 + 1e-12) + 1e-15)
    return bool(sizes and statement.mass(values)[0] <= statement.mass(u)[0] * (1 + 1e-12))


def test_webs_in_one_place_get_their_mean() -> None:
    """Analytic: nothing else is alike, so that nothing else moves."""
    webs = [web("a", 0.1), web("b", 0.1), web("c", 0.1, radius_m=0.1), web("d", 0.4)]
    statement, u = two_throws(10.0, 70.0, webs, (9.0, 5.0)), some(4)
    matrix = symmetric(statement, u)
    assert matrix[0, 0] == matrix[0, 1] == pytest.approx(0.5 * (u[0, 0] + u[0, 1]), rel=1e-15)
    assert np.array_equal(matrix[0, 2:], u[0, 2:])
    assert no_worse(statement, u, matrix)


@pytest.mark.parametrize(("first", "second"), [(0.0, 180.0), (25.0, 205.0)])
def test_opposite_cranks_are_alike_from_both_ends(first: float, second: float) -> None:
    """Analytic: u_k and -u of the other end are one, and along the cranks, whose plane is a mirror."""
    statement, u = two_throws(first, second, four_webs()), some(4)
    actual = symmetric(statement, u)[0]
    assert actual == pytest.approx(-actual[::-1], abs=1e-15)
    assert np.abs((actual * np.exp(-1j * np.radians(first))).imag) == pytest.approx(0.0, abs=1e-15)
    assert no_worse(statement, u, actual[None])


def test_cranks_at_an_angle_are_mirror_images_from_both_ends() -> None:
    """Analytic: with cranks at +-40 degrees of 30 the other end is the mirror image at 30 degrees."""
    statement, u = two_throws(70.0, -10.0, four_webs()), some(4)
    actual = symmetric(statement, u)[0]
    mirrored = np.exp(2j * np.radians(30.0)) * np.conj(actual[::-1])
    assert actual == pytest.approx(mirrored, abs=1e-14)
    assert np.abs(actual.imag).max() > 0.01
    assert no_worse(statement, u, actual[None])


@pytest.mark.parametrize(
    "statement",
    [
        two_throws(10.0, 70.0, [web(str(k), z) for k, z in enumerate((-0.5, -0.1, 0.2, 0.6))]),
        two_throws(0.0, 90.0, four_webs(), (9.0, 5.0)),
        two_throws(70.0, -10.0, [*four_webs()[:3], web("3", 0.5, max_mass_kg=2.0)]),
    ],
    ids=["no mirror of the webs", "unequal throws", "an unequal web"],
)
def test_what_is_not_alike_stays(statement: Statement) -> None:
    u = some(4)
    assert np.array_equal(symmetric(statement, u), u)


def test_sectors_have_to_be_alike_too() -> None:
    """Analytic: at cranks of +-40 degrees about 30 the sector of an end is the mirror image of that of the other."""

    def in_sector(centre: float) -> Statement:
        webs = four_webs()
        for k, at in ((0, 250.0), (3, centre)):
            webs[k] = webs[k].model_copy(update={"sector": Sector(centre_deg=at, half_angle_deg=20)})
        return two_throws(70.0, -10.0, webs)

    u = np.exp(1j * np.radians([255.0, 240.0, 180.0, 185.0]))[None]
    assert not np.array_equal(symmetric(in_sector(170.0), u), u)
    assert np.array_equal(symmetric(in_sector(190.0), u), u)


def test_many_programs_are_each_as_if_alone() -> None:
    alike, unlike = two_throws(0.0, 180.0, four_webs()), two_throws(0.0, 90.0, four_webs(), (9.0, 5.0))
    u = some(4)
    for programs in (alike, unlike):
        both = programs.subset(np.array([0, 0]))
        values = np.stack([u[0], 2 * u[0]])
        assert np.array_equal(symmetric(both, values)[:1], symmetric(programs, u))


def test_of_kinds_that_differ_nothing_is_alike() -> None:
    statement, u = two_throws(0.0, 180.0, four_webs()), some(4)
    assert not np.array_equal(symmetric(statement, u, np.array([0, 1, 1, 0])), u)
    matrix = symmetric(statement, u, np.array([0, 1, 2, 3]))
    # the plane of the cranks is a mirror all the same
    assert np.abs(matrix.imag).max() == 0.0


def test_it_can_be_left_out() -> None:
    body = json.loads((EXAMPLES / "v8-cross-plane.json").read_bytes())
    plain, answer = (
        optimize(OptimizeRequest.model_validate({**body, "objective": {"symmetric": symmetric}}))
        for symmetric in (False, True)
    )
    assert plain.status == answer.status == "optimal"
    masses = [counterweight.mass_kg for counterweight in answer.counterweights]
    assert masses == pytest.approx(masses[::-1], rel=1e-12)
    assert plain.total_mass_kg == pytest.approx(answer.total_mass_kg, rel=1e-9)
    assert answer.certificate is not None
    assert answer.certificate.relative_gap is not None
    assert answer.certificate.relative_gap <= 1e-6


def test_the_two_columns_of_the_2d12_are_not_alike() -> None:
    """Independent: its masses differ, and both ways to make its webs alike come to more than what is proven."""
    request = OptimizeRequest.model_validate(json.loads((EXAMPLES / "2d12.json").read_bytes()))
    answer = optimize(request)
    assert answer.certificate is not None
    assert [round(counterweight.mass_kg, 4) for counterweight in answer.counterweights] == [60.0, 60.0, 52.7004, 60.0]
    design = request.machine
    assert isinstance(design, ReciprocatingMachine)
    statement = program(design)
    square = float(layout(design).omega ** 2)
    for masses in ((60.0, 60.0, 56.3502, 56.3502), (60.0, 60.0, 60.0, 60.0), (58.1751,) * 4):
        u = 0.25 * np.array(masses) * np.array([-1, -1, 1, 1])
        assert float(statement.objective(u[None])[0]) * square > answer.certificate.objective * 1.0001


@pytest.mark.parametrize("seed", range(6))
def test_the_order_of_the_webs_changes_nothing(seed: int) -> None:
    """Independent: webs in any order, some in one place, most with a partner at the other end, get the same means."""
    rng = np.random.default_rng(seed)
    places = rng.choice([0.1, 0.2, 0.35, 0.5], 9)
    webs = [web(str(k), z) for k, z in enumerate(np.concatenate([places, -places[:7]]).tolist())]
    u, order = some(16), rng.permutation(16)
    matrix = symmetric(two_throws(10.0, 190.0, webs), u)
    again = symmetric(two_throws(10.0, 190.0, [webs[k] for k in order]), u[:, order])
    assert not np.array_equal(matrix, u)
    np.testing.assert_allclose(again, matrix[:, order], rtol=1e-13, atol=1e-15)
