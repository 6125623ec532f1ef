"""The eight stages of seed 002 for its own layouts and for any other."""

from functools import partial
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.mechanics.inertia import counterweights, first_order_responses, reciprocating, rotating
from optimizer.mechanics.layout import layout
from optimizer.mechanics.slider_crank import acceleration_harmonic, acceleration_harmonic_order_2
from optimizer.numerics.arrays import Complex
from schemas.answer.outputs import Stage
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.machine.throws import Throw
from tests.builders import OMEGA, RADIUS, all_stages, inline, machine, machines, opposed, row, throw, web

F0 = 10.0 * RADIUS * OMEGA**2  # 3500 N: 10 kg on 0.14 m at 50 rad/s, as in the seeds' reference figures
SPAN = 0.6  # m
TWO = [web("a", 0.5), web("b", -0.5)]
ROOT_HALF = np.sqrt(0.5)
TITLES = ("I", "II", "III", "IV", "V", "VI", "VII", "VIII")

truncated = partial(all_stages, harmonic=acceleration_harmonic_order_2)


def report(throws: list[Throw], unbalance: Any = (0, 0), **rest: Any) -> dict[str, Stage]:
    fitted = None if unbalance is None else np.asarray(unbalance, dtype=complex)
    return {stage.stage: stage for stage in truncated(layout(machine(*throws, webs=TWO, **rest)), fitted)}


def values(fields: dict[str, Stage]) -> list[float]:
    return [fields[s].value for s in TITLES[:6]]


ONE = [throw(0.0, row(90), rotating_kg=10.0)]
LAYOUTS = [
    # I, III, V in F0, F0 and lam F0; II, IV, VI the same times the row spacing; what is balanceable
    pytest.param(ONE, (1, 0, 1, 0, 1, 0), "fully fully partly fully no fully", id="published-single"),
    pytest.param(inline([0, 180], [0.3, -0.3]), (0, 1, 0, 1, 2, 0), "fully fully fully partly no fully",
                 id="published-two-rows-180"),
    pytest.param(inline([0, 90], [0.3, -0.3]), (2**0.5, ROOT_HALF, 2**0.5, ROOT_HALF, 0, 1),
                 "fully fully partly partly fully no", id="published-two-rows-90"),
    pytest.param(opposed([0, 180], [0.3, -0.3]), (0, 1, 0, 1, 0, 1), "fully fully fully partly fully no",
                 id="published-opposed"),
    pytest.param([throw(0.0, row(45), row(135))], (0, 0, 1, 0, 2**0.5, 0), "fully fully fully fully no fully",
                 id="published-v90"),
    pytest.param([throw(0.0, row(60), row(120))], (0, 0, 1.5, 0, 0.75**0.5, 0), "fully fully partly fully no fully",
                 id="analytic-v60"),
    pytest.param([throw(0.0, row(30), row(90), row(150))], (0, 0, 1.5, 0, 1.5, 0), "fully fully fully fully no fully",
                 id="published-w60"),
    pytest.param(opposed([0, 180, 90, 270], [1.3, 0.7, -0.7, -1.3]), (0, 2**0.5, 0, 2**0.5, 0, 0),
                 "fully fully fully partly fully fully", id="analytic-m-type"),
    pytest.param(opposed([0, 180, 240, 60, 120, 300], [2.3, 1.7, 0.3, -0.3, -1.7, -2.3]), (0, 0, 0, 0, 0, 0),
                 "fully fully fully fully fully fully", id="published-six-columns"),
    pytest.param([throw(0.0, row(0), z=0.3), throw(0.0, row(180), z=-0.3)], (0, 0, 2, 0, 0, 1),
                 "fully fully partly fully fully no", id="analytic-pistons-moving-the-same-way"),
]  # fmt: skip


@pytest.mark.parametrize(("throws", "expected", "balanceable"), LAYOUTS)
def test_values_of_layouts(throws: list[Throw], expected: tuple[float, ...], balanceable: str) -> None:
    document = report(throws)
    units = np.array([F0, F0 * SPAN, F0, F0 * SPAN, 0.2 * F0, 0.2 * F0 * SPAN])
    np.testing.assert_allclose(values(document), units * expected, atol=1e-9 * F0)
    assert [document[s].balanceable for s in TITLES[:6]] == balanceable.split()


def test_every_stage_in_order_with_unit_and_words() -> None:
    stages = truncated(layout(machine(*ONE, webs=TWO)), np.zeros(2, complex))
    assert tuple(stage.stage for stage in stages) == TITLES
    assert [stage.unit for stage in stages] == ["N", "N m", "N", "N m", "N", "N m", "kg m", "N"]
    for stage in stages:
        assert all((stage.title, stage.quantity, stage.formula, stage.plane, stage.frequency))
    assert stages[0].frequency == "n = 7.958 Hz"
    assert stages[4].frequency == "2n = 15.915 Hz"


PLANES = [
    pytest.param(ONE, "I", "rotates with the shaft, at 0.0 deg at shaft angle 0", id="rotating"),
    pytest.param(ONE, "II", "none", id="nothing"),
    pytest.param(ONE, "III", "along 90.0 deg (fixed direction)", id="line"),
    pytest.param([throw(0.0, row(60), row(120))], "III", "ellipse, major axis 90.0 deg", id="ellipse"),
    pytest.param([throw(0.0, row(30), row(90), row(150))], "V", "ellipse, major axis 0.0 deg", id="ellipse-order-2"),
    pytest.param([throw(0.0, row(0), row(60))], "III", "ellipse, major axis 30.0 deg", id="bisector"),
    pytest.param([throw(-0.01, row(45), row(135))], "III", "rotates with the shaft, at 0.0 deg at shaft angle 0",
                 id="never-360"),
    pytest.param(inline([0, 90], [0.3, -0.3]), "II", "rotates with the shaft, at 315.0 deg at shaft angle 0",
                 id="published-lags-crank-1-by-45"),
    # the second order of a 60 degree V is a circle: its backward phasors at 3 g = 90 and -90 degrees cancel
    pytest.param([throw(0.0, row(30), row(-30))], "V", "rotates with the shaft, at 0.0 deg at shaft angle 0",
                 id="second-order-circle"),
    # backward phasors at 2 g - d = -30 and 150 degrees cancel
    pytest.param([throw(30.0, row(0)), throw(-30.0, row(60))], "III",
                 "rotates with the shaft, at 0.0 deg at shaft angle 0", id="two-pins"),
    # two crank pins half a turn apart with axes a quarter of a turn apart: only the backward phasor is left
    pytest.param([throw(0.0, row(0)), throw(180.0, row(90))], "III",
                 "rotates against the shaft, at 0.0 deg at shaft angle 0", id="backward"),
]  # fmt: skip


@pytest.mark.parametrize(("throws", "stage", "plane"), PLANES)
def test_planes_analytic(throws: list[Throw], stage: str, plane: str) -> None:
    assert report(throws)[stage].plane == plane


def test_the_backward_phasor_cannot_be_balanced_at_all_analytic() -> None:
    document = report([throw(0.0, row(0)), throw(180.0, row(90))])
    assert document["III"].balanceable == "no"
    assert document["VIII"].balanceable == "no"


def test_the_summary_says_what_is_left() -> None:
    """Half the reciprocating mass on: a circle of half the force against the shaft, and the second order as it was."""
    both = -(10.0 + 5.0) * RADIUS / 2 * np.ones(2)
    viii = report(ONE, both)["VIII"]
    assert viii.value == pytest.approx((1 + 1 + 0.2) * F0)  # analytic
    assert viii.remaining == pytest.approx((0.5 + 0.2) * F0)  # analytic
    assert viii.plane == (
        "first-order force 1750 N, rotates against the shaft, at 180.0 deg at shaft angle 0; "
        "second-order force 700 N, along 90.0 deg (fixed direction)"
    )
    assert viii.frequency == "n = 7.958 Hz, 2n = 15.915 Hz"
    assert viii.balanceable == "partly"
    # what rounding leaves is not mentioned
    assert "order force" not in report(opposed([0, 180], [0.3, -0.3]), [1e-12, 0])["VIII"].plane
    six = opposed([0, 180, 240, 60, 120, 300], [2.3, 1.7, 0.3, -0.3, -1.7, -2.3])
    assert (report(six)["VIII"].plane, report(six)["VIII"].frequency) == ("none", "none")
    assert report([throw(0.0, rotating_kg=3.0)])["VIII"].balanceable == "fully"
    assert report([throw(0.0, row(45), row(135))])["VIII"].balanceable == "partly"


@pytest.mark.parametrize(
    ("rotating_served", "reciprocating_served", "first", "third"),
    [
        pytest.param(0.0, 0.0, 1.0, 1.0, id="analytic-none"),
        pytest.param(0.4, 0.0, 0.6, 1.0, id="analytic-rotating-comes-first"),
        pytest.param(1.0, 0.0, 0.0, 1.0, id="analytic-rotating-only"),
        pytest.param(1.0, 0.25, 0.0, 0.75, id="published-quarter-turned-across"),
        pytest.param(1.0, 0.5, 0.0, 0.5, id="published-half"),
        pytest.param(1.0, 1.0, 0.0, 1.0, id="published-full-overbalance"),
        # iron on the wrong side serves nothing: the rotating force stays, the rest grows
        pytest.param(-0.5, 0.0, 1.0, 1.5, id="analytic-wrong-side"),
    ],
)
def test_superposition_on_a_single_row(
    rotating_served: float, reciprocating_served: float, first: float, third: float
) -> None:
    """Shares of F0; a counterweight of k F0 leaves (1 - k) along and k across (seed 002 lines 253-422)."""
    unbalance = -(rotating_served + reciprocating_served) * 10.0 * RADIUS / 2 * np.ones(2)
    document = report(ONE, unbalance)
    assert document["I"].remaining == pytest.approx(first * F0, abs=1e-9)
    assert document["III"].remaining == pytest.approx(third * F0, abs=1e-9)
    assert document["V"].remaining == document["V"].value


def test_moments_are_shared_out_in_the_same_way_published() -> None:
    """Eq (A) of seed 002 for the rotating moment, half the share of the reciprocating one on top."""
    throws = opposed([0, 180], [0.3, -0.3])
    turning = 10.0 * RADIUS * SPAN / 1.0  # webs 1 m apart
    document = report(throws, [-turning, turning])
    assert (document["II"].remaining, document["IV"].remaining) == pytest.approx((0.0, F0 * SPAN), abs=1e-9)
    record = report(throws, [-1.5 * turning, 1.5 * turning])
    assert (record["II"].remaining, record["IV"].remaining) == pytest.approx((0.0, 0.5 * F0 * SPAN), abs=1e-9)
    assert record["VI"].remaining == record["VI"].value


@pytest.mark.parametrize("harmonic", [acceleration_harmonic, acceleration_harmonic_order_2])
def test_the_second_order_follows_the_kinematics(harmonic: Any) -> None:
    stages = all_stages(layout(machine(*ONE, webs=TWO)), None, harmonic)
    assert stages[4].value == pytest.approx(F0 * float(harmonic(2, np.asarray(0.2))))
    # published: exact 0.202038
    assert all_stages(layout(machine(*ONE)), None)[4].value == pytest.approx(F0 * 0.202038, rel=1e-5)


def test_nothing_remains_to_be_said_where_it_is_infeasible() -> None:
    document = report(inline([0, 90], [0.3, -0.3]), None)
    assert all(stage.remaining is None for stage in document.values())
    assert document["VIII"].plane.startswith("first-order force")


class TestIron:
    """Stage VII."""

    def test_a_single_row_published(self) -> None:
        """m_rot r + m_s r / 2, shared by two counterweights."""
        vii = report(ONE)["VII"]
        assert vii.value == pytest.approx(1.5 * 10.0 * RADIUS)
        assert vii.remaining == vii.value
        assert vii.plane == "planes z = -0.5 m and z = 0.5 m"
        assert vii.balanceable == "fully"

    def test_two_rows_at_180_published(self) -> None:
        """m_np r_np l_np = m_rot r l, and half of m_s r l for the reciprocating masses."""
        vii = report(inline([0, 180], [0.3, -0.3]))["VII"]
        assert vii.value == pytest.approx(2 * 1.5 * 10.0 * RADIUS * SPAN / 1.0)

    def test_what_is_missing_analytic(self) -> None:
        throws = [throw(0.0, row(90), z=0.5, rotating_kg=10.0)]
        half = report(throws, [-0.5 * 1.5 * 10.0 * RADIUS, 0])["VII"]
        assert half.remaining == pytest.approx(0.5 * 1.5 * 10.0 * RADIUS)
        assert report(throws, [-1.5 * 10.0 * RADIUS, 0])["VII"].remaining == pytest.approx(0.0, abs=1e-12)
        wrong = report(throws, [0, -1.5 * 10.0 * RADIUS])["VII"]
        assert wrong.remaining == pytest.approx(2 * 1.5 * 10.0 * RADIUS)

    def test_the_plane_of_moments_does_not_matter(self) -> None:
        throws = inline([0, 100], [0.4, -0.1])
        here, there = (report(throws, [0.3, 0.1j], reference_plane_m=z)["VII"] for z in (None, 1e6))
        assert (here.value, here.remaining) == (there.value, there.remaining)

    @pytest.mark.parametrize(
        ("webs", "plane"),
        [([], "no webs, force only"), ([web("a", 0.25), web("b", 0.25)], "plane z = 0.25 m, force only")],
    )
    def test_without_two_planes_only_the_force_counts(self, webs: list[Any], plane: str) -> None:
        stage = all_stages(layout(machine(*ONE, webs=webs)), np.zeros(len(webs), complex))[6]
        assert stage.value == pytest.approx(1.5 * 10.0 * RADIUS)  # analytic
        assert stage.plane == plane

    def test_counterweights_between_the_outer_planes_can_do_it_all(self) -> None:
        webs = [web("a", 0.5), web("b", 0.2), web("c", -0.3), web("d", -0.5)]
        arrays = layout(machine(*inline([0, 100], [0.4, -0.1]), webs=webs))
        responses = first_order_responses(arrays, rotating(arrays).plus(reciprocating(arrays, 1)))
        inner = np.array([r.influence[1:3] for r in responses], dtype=complex)
        unbalance = np.zeros(4, complex)
        unbalance[1:3] = np.linalg.solve(inner, -np.array([r.baseline.co for r in responses]))
        stages = all_stages(arrays, unbalance)
        assert stages[6].value > 0
        assert stages[6].remaining == pytest.approx(0.0, abs=1e-12)
        assert stages[0].remaining == pytest.approx(0.0, abs=1e-8)
        assert stages[1].remaining == pytest.approx(0.0, abs=1e-8)


@st.composite
def cases(draw: st.DrawFn) -> tuple[ReciprocatingMachine, Complex]:
    part = st.floats(-20.0, 20.0, allow_subnormal=False)
    machine_ = draw(machines())
    return machine_, np.array([complex(draw(part), draw(part)) for _ in machine_.webs], dtype=complex)


@given(cases())
def test_the_stages_add_up(case: tuple[ReciprocatingMachine, Complex]) -> None:
    machine_, unbalance = case
    arrays = layout(machine_)
    stages = {stage.stage: stage for stage in all_stages(arrays, unbalance)}
    wrench = rotating(arrays).plus(reciprocating(arrays, 1)).plus(counterweights(arrays, unbalance))
    square = float(arrays.omega) ** 2
    remaining = {name: float(stage.remaining or 0.0) for name, stage in stages.items()}
    small = 1e-9 * (sum(stage.value + remaining[name] for name, stage in stages.items()) + square)
    # VIII is the first-order residual and the second order
    assert remaining["VIII"] == pytest.approx(float(wrench.force.peak) * square + remaining["V"], abs=small)
    # the parts never hide what the whole has
    assert remaining["I"] + remaining["III"] >= float(wrench.force.peak) * square - small
    assert remaining["II"] + remaining["IV"] >= float(wrench.moment.peak) * square - small
    # no stage of rotating masses is made worse, none of the second order is touched
    assert remaining["I"] <= stages["I"].value + small
    assert remaining["II"] <= stages["II"].value + small
    assert (remaining["V"], remaining["VI"]) == (stages["V"].value, stages["VI"].value)
    # the floor: what turns against the shaft
    assert remaining["III"] >= abs(wrench.force.counter) * square - small
    assert remaining["IV"] >= abs(wrench.moment.counter) * square - small


@pytest.mark.parametrize("mass", [1e-300, 1.0, 1e15])
@pytest.mark.parametrize("speed", [1e-9, 1.0, 1e9])
@pytest.mark.parametrize("length", [1e-12, 1.0, 1e8])
@pytest.mark.parametrize("apart", [1e-300, 1e-12, 1.0, 2e9])
def test_whatever_the_schema_lets_through_gives_finite_figures(
    mass: float, speed: float, length: float, apart: float
) -> None:
    """No figure may be infinite or NaN: the answer refuses those."""
    rows = [row(axis, mass, length_m=5.0 * length) for axis in (0.0, 90.0)]
    throws = [throw(d, *rows[: 1 + i], z=i * length, rotating_kg=mass, radius_m=length) for i, d in enumerate((0, 70))]
    webs = [web("a", -apart / 2), web("b", apart / 2)]
    arrays = layout(machine(*throws, webs=webs, speed_rpm=speed))
    for unbalance in (None, np.zeros(2, complex), np.array([1e24, -1e24j]), np.array([1e-300j, 1e-309])):
        assert len(all_stages(arrays, unbalance)) == 8
    assert len(all_stages(layout(machine(throws[0], webs=webs, speed_rpm=speed)), None)) == 8


@given(machines())
def test_without_counterweights_everything_remains(machine_: ReciprocatingMachine) -> None:
    for stage in all_stages(layout(machine_), np.zeros(len(machine_.webs), complex)):
        assert stage.remaining == pytest.approx(stage.value, rel=1e-12, abs=1e-300)
