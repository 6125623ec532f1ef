"""Tangents in place of plates: no heavier than these, and as heavy where they touch."""

from dataclasses import replace

import numpy as np
import pytest

from optimizer.mechanics.envelope import AnnularSector, Segment
from optimizer.mechanics.plates import Plates
from optimizer.numerics.arrays import Real
from optimizer.program.methods.plate_sizes import CutWeights, equal_sizes
from optimizer.program.plate_pieces import (
    Webs,
    _apart,
    closer_nodes,
    first_nodes,
    nodes_about,
    pieces,
    tangents,
    total_mass,
)
from tests.program.test_leading_axes import WEBS, _program


def _plates(kinds: tuple[int, ...] = (0, 1, 2)) -> Plates:
    """A sector on web 1, and two segments on 0 and 3, of which one is open to a right angle."""
    right = np.pi / 2
    sector = AnnularSector(np.array([0.05]), np.array([0.2]), np.array([300.0]), np.array([1.2]))
    segments = Segment(np.array([0.03, 0.0]), np.array([0.25, 0.3]), np.array([250.0, 200.0]), np.array([right, 0.9]))
    parts = [(np.array([1]), sector), (np.array([0, 2]), segments)]
    return Plates(np.array([0, 1, 3]), np.array(kinds), parts)


PLATES = _plates()
NODES = {
    "first": first_nodes(PLATES),
    "closer": closer_nodes(first_nodes(PLATES), np.array([0.3, 0.7, 0.8])),
    "at the end": closer_nodes(first_nodes(PLATES), PLATES.most),
}


@pytest.mark.parametrize("name", NODES)
def test_nodes_rise_from_nothing_to_the_largest_opening(name: str) -> None:
    nodes = NODES[name]
    assert np.all(np.diff(nodes, axis=0) >= 0.0)
    assert np.all(nodes[0] == 0.0)
    np.testing.assert_array_equal(nodes[-1], PLATES.most)
    # none is next to another that it is not
    step = np.diff(nodes, axis=0)
    assert np.all((step == 0.0) | (step > 1e-9 * PLATES.most))


def test_nodes_are_laid_at_an_angle_and_on_both_sides_ever_closer() -> None:
    """Analytic: at the angle, and at 1/64, 1/8 and all of the way to those that were there."""
    nodes, angle = np.array([[0.0], [0.2], [0.6], [1.0]]), np.array([0.3])
    below, above = 0.1 * np.array([1.0, 0.125, 1 / 64]), 0.3 * np.array([1 / 64, 0.125, 1.0])
    expected = [0.0, *(0.3 - below), 0.3, *(0.3 + above), 1.0]
    assert closer_nodes(nodes, angle)[:, 0] == pytest.approx(expected, rel=1e-12)


def _filled(webs: Webs, plate: int, unbalance: float) -> float:
    """The least mass with which pieces carry an unbalance: those of the longest lever first."""
    mass, left = 0.0, unbalance
    for radius, most in sorted(zip(webs.radius[:, plate], webs.mass[:, plate], strict=True), reverse=True):
        share = min(left, radius * most)
        mass, left = mass + share / radius, left - share
    assert left <= 1e-12 * unbalance
    return mass


@pytest.mark.parametrize("name", NODES)
def test_tangents_are_no_heavier_than_plates_and_as_heavy_where_they_touch(name: str) -> None:
    webs = tangents(PLATES, NODES[name])
    assert np.all(webs.mass >= 0.0)
    for share in np.linspace(0.02, 1.0, 60):
        unbalance = PLATES.unbalance(share * PLATES.most)
        mass = PLATES.mass(share * PLATES.most)
        for plate in range(3):
            assert _filled(webs, plate, float(unbalance[plate])) <= float(mass[plate]) * (1.0 + 1e-9)
    for node in NODES[name][1:-1]:
        unbalance, mass = PLATES.unbalance(node), PLATES.mass(node)
        for plate in range(3):
            if node[plate] > 0.0:
                assert _filled(webs, plate, float(unbalance[plate])) == pytest.approx(float(mass[plate]), rel=1e-6)


@pytest.mark.parametrize("left", [None, np.array([True, True, True, False])])
def test_pieces_stand_in_the_place_of_their_plate(left: np.ndarray | None) -> None:
    """Property: what they carry together acts as one web, and other webs are as they were."""
    whole = _program(3, "sector, budget")
    webs = tangents(PLATES, NODES["first"])
    cut = pieces(whole, PLATES, webs, left)
    count = np.sum(webs.mass > 0.0, axis=0)
    expected = [0] * count[0] + [1] * count[1] + [2] + ([3] * count[2] if left is None else [])
    assert cut.owner.tolist() == expected
    assert cut.machine_webs == WEBS
    limits = cut.program.limits
    for plate, web in enumerate(PLATES.webs if left is None else PLATES.webs[:2]):
        own = cut.owner == web
        some = webs.mass[:, plate] > 0.0
        np.testing.assert_array_equal(limits.radius[own], webs.radius[some, plate])
        np.testing.assert_array_equal(limits.max_mass[own], webs.mass[some, plate])
        assert np.all(limits.centre[own] == whole.limits.centre[web])
    assert limits.radius[cut.owner == 2].tolist() == [whole.limits.radius[2]]
    assert limits.max_total_mass == whole.limits.max_total_mass
    rng = np.random.default_rng(1)
    u = (rng.normal(size=(2, cut.owner.size, 2)) @ [1, 1j]) * 0.1
    carried = cut.carried(u)
    for web in range(WEBS):
        np.testing.assert_allclose(carried[:, web], np.sum(u[:, cut.owner == web], axis=-1), atol=1e-15)
    np.testing.assert_allclose(cut.program.objective(u), whole.objective(carried), rtol=1e-12)


def test_all_that_is_fitted_weighs_what_plates_and_other_webs_do() -> None:
    """Analytic: a plate by its opening, any other web by its radius."""
    radius = np.array([0.1, 0.1, 0.2, 0.1])
    angle = np.array([0.5, 0.6, 0.7])
    u = np.zeros(WEBS, complex)
    u[PLATES.webs] = PLATES.unbalance(angle) * np.exp(1j * np.arange(3))
    u[2] = 3j
    assert total_mass(PLATES, radius, u) == pytest.approx(np.sum(PLATES.mass(angle)) + 15.0, rel=1e-9)
    assert total_mass(None, radius, u) == pytest.approx(np.sum(np.abs(u) / radius), rel=1e-14)


@pytest.mark.parametrize(("lighter", "same"), [(0.5, True), (1e-7, False)])
def test_nodes_are_laid_closer_only_where_tangents_are_too_light(lighter: float, same: bool) -> None:
    nodes, angle = NODES["first"], np.array([0.31, 0.47, 0.53])
    u = np.zeros(WEBS, complex)
    u[PLATES.webs] = PLATES.unbalance(angle)
    actual_nodes_about = nodes_about(PLATES, nodes, u, lighter)
    assert (actual_nodes_about is nodes) == same
    if not same:
        webs = tangents(PLATES, actual_nodes_about)
        for plate, (size, mass) in enumerate(zip(np.abs(u[PLATES.webs]), PLATES.mass(angle), strict=True)):
            assert _filled(webs, plate, float(size)) >= float(mass) * (1.0 - 1e-5)
            assert _filled(tangents(PLATES, nodes), plate, float(size)) < float(mass)


@pytest.mark.parametrize("lighter", [1e-7, 1e-10])
@pytest.mark.parametrize("share", [0.3, 0.9, 0.99, 0.9999, 1.0 - 1e-7])
def test_tangents_about_any_opening_are_as_heavy_as_the_plate(share: float, lighter: float) -> None:
    """Property: where a plate is all but full its lever vanishes, and tangents have to be the nearer."""
    nodes, angle = NODES["first"], share * PLATES.most
    u = np.zeros(WEBS, complex)
    for _ in range(3):
        # what the tangents of before would call for beside it
        for nearby in (angle, angle * (1.0 - 1e-5), angle):
            u[PLATES.webs] = PLATES.unbalance(nearby)
            nodes = nodes_about(PLATES, nodes, u, lighter)
    size, mass = PLATES.unbalance(angle), PLATES.mass(angle)
    tangent = PLATES.mass(nodes[:-1]) + (size - PLATES.unbalance(nodes[:-1])) / PLATES.lever(nodes[:-1])
    assert np.all(np.max(tangent, axis=0) >= mass * (1.0 - 1.01 * lighter))


def test_nodes_that_were_there_stay() -> None:
    """Property: a search that goes back and forth between openings finds the tangents of both."""
    nodes, first, second = NODES["first"], np.array([0.3, 0.7, 0.8]), np.array([0.5, 0.6, 0.4])
    u = np.zeros(WEBS, complex)
    for angle in (first, second):
        u[PLATES.webs] = PLATES.unbalance(angle)
        nodes = nodes_about(PLATES, nodes, u, 1e-7)
    for angle in (first, second):
        u[PLATES.webs] = PLATES.unbalance(angle)
        assert nodes_about(PLATES, nodes, u, 1e-7) is nodes
    # however long it goes on there are not many
    rng = np.random.default_rng(2)
    for _ in range(20):
        u[PLATES.webs] = PLATES.unbalance(rng.uniform(0.1, 0.9, 3) * PLATES.most)
        nodes = nodes_about(PLATES, nodes, u, 1e-7)
    assert len(nodes) <= 42
    assert np.all(np.diff(nodes, axis=0) >= 0.0)


def test_a_node_above_the_largest_by_rounding_is_the_largest() -> None:
    most = PLATES.most
    nodes = np.array([0.0 * most, 0.5 * most, np.nextafter(most, np.inf), most])
    assert np.all(_apart(nodes, lighter=1e-7)[1:] == np.array([0.5 * most, 0.5 * most, most]))


def test_a_plate_without_room_is_no_piece() -> None:
    webs = tangents(PLATES, NODES["first"])
    none = Webs(webs.radius, np.where(np.arange(3) == 1, 0.0, webs.mass))
    cut = pieces(replace(_program(3, "plain")), PLATES, none)
    assert 1 not in cut.owner
    carried: Real = np.abs(cut.carried(np.ones(cut.owner.size, complex)))
    assert carried[1] == 0.0


def test_a_plate_that_cannot_be_opened_has_all_nodes_at_nothing() -> None:
    nodes = closer_nodes(np.array([[0.0, 0.0], [0.0, 0.5], [0.0, 1.0]]), np.array([0.0, 0.5]))
    assert np.all(nodes[:, 0] == 0.0)
    assert np.any(nodes[:, 1] == 0.5)


@pytest.mark.parametrize(
    ("kinds", "largest", "mean"),
    [
        # the first and the last are of one kind, then the last two, then all
        ((0, 1, 0), (0.6 + 1e-6, 0.6 + 3e-6, 0.6 + 1e-6), (0.6 + 5e-7, 0.6 + 3e-6, 0.6 + 5e-7)),
        ((0, 3, 3), (0.6, 0.6 + 3e-6, 0.6 + 3e-6), (0.6, 0.6 + 2e-6, 0.6 + 2e-6)),
        ((2, 2, 2), (0.6 + 3e-6,) * 3, (0.6 + 4e-6 / 3,) * 3),
    ],
)
def test_plates_of_one_kind_are_put_to_one_size(
    kinds: tuple[int, ...], largest: tuple[float, ...], mean: tuple[float, ...]
) -> None:
    """Analytic: those that nearly agree to their largest opening, or to their mean; the cut as it is comes last."""
    plates, whole = _plates(kinds), _program(3, "plain").alone()
    angle = np.array([0.6, 0.6 + 3e-6, 0.6 + 1e-6])
    u = np.zeros(WEBS, complex)
    u[plates.webs] = plates.unbalance(angle) * np.exp(1j * np.arange(3))
    u[2] = 0.1
    cuts = list(equal_sizes(whole, plates, CutWeights(u, angle, 0.0)))
    assert cuts[1].angle == pytest.approx(largest, rel=1e-13)
    assert cuts[3].angle == pytest.approx(mean, rel=1e-13)
    for cut in cuts[1:4:2]:
        assert np.abs(cut.unbalance[plates.webs]) == pytest.approx(plates.unbalance(cut.angle), rel=1e-12)
        assert np.angle(cut.unbalance[plates.webs]) == pytest.approx(np.arange(3), abs=1e-12)
        assert cut.unbalance[2] == 0.1
        masses = np.sum(plates.mass(cut.angle)) + 0.1 / whole.limits.radius[0, 2]
        assert cut.mass == pytest.approx(masses, rel=1e-12)
    assert cuts[-1].unbalance is u
