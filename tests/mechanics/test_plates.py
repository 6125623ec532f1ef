"""Plates side by side are as each by itself."""

import numpy as np
import pytest

from optimizer.mechanics.envelope import AnnularSector, Segment
from optimizer.mechanics.plates import Plates

SECTORS = AnnularSector(np.array([0.05, 0.0]), np.array([0.2, 0.3]), np.array([100.0, 200.0]), np.array([1.2, 0.7]))
SEGMENTS = Segment(np.array([0.03]), np.array([0.25]), np.array([300.0]), np.array([1.5]))
MIXED = Plates(np.array([0, 2, 3]), np.arange(3), [(np.array([0, 2]), SECTORS), (np.array([1]), SEGMENTS)])
SINGLE_PLATES = (
    AnnularSector(0.05, 0.2, 100.0, 1.2),
    Segment(0.03, 0.25, 300.0, 1.5),
    AnnularSector(0.0, 0.3, 200.0, 0.7),
)


@pytest.mark.parametrize("name", ["unbalance", "mass", "lever", "inertia"])
def test_figures_are_those_of_each_plate(name: str) -> None:
    # property, along any leading axes
    angle = np.array([[0.1, 0.2, 0.3], [0.7, 0.6, 0.5]])
    actual = getattr(MIXED, name)(angle)
    for n, plate in enumerate(SINGLE_PLATES):
        assert actual[:, n] == pytest.approx(getattr(plate, name)(angle[:, n]), rel=1e-14)


def test_openings_and_chords_are_those_of_each_plate() -> None:
    assert np.array_equal(MIXED.most, [1.2, 1.5, 0.7])
    assert np.array_equal(MIXED.outer, [0.2, 0.25, 0.3])
    half = 0.5 * MIXED.most
    unbalance = MIXED.unbalance(half)
    assert MIXED.opened(unbalance) == pytest.approx(half, rel=1e-12)
    assert MIXED.opened_for(MIXED.mass(half)) == pytest.approx(half, rel=1e-12)
    assert MIXED.mass_of(unbalance) == pytest.approx(MIXED.mass(half), rel=1e-12)
    # analytic: a sector has no chord, that of a segment is at R cos a
    assert np.isnan(MIXED.chord(half)).tolist() == [True, False, True]
    assert MIXED.chord(half)[1] == pytest.approx(0.25 * np.cos(0.75))


@pytest.mark.parametrize("below", [0.0, 1e-10, 1e-8, 1e-5, 1e-3, 0.5])
def test_openings_near_a_right_angle_are_those_of_their_masses(below: float) -> None:
    """Analytic: the mass of a sector is in proportion to its opening; of a segment it is found again."""
    full = np.pi / 2
    plates = Plates(
        np.arange(2),
        np.arange(2),
        [
            (np.array([0]), AnnularSector(np.array([0.05]), np.array([0.2]), np.array([100.0]), np.array([full]))),
            (np.array([1]), Segment(np.array([0.0]), np.array([0.25]), np.array([300.0]), np.array([full]))),
        ],
    )
    angle = full - np.full(2, below)
    mass, unbalance = plates.mass(angle), plates.unbalance(angle)
    for rounding in (-1e-15, 0.0, 1e-15):
        opened_by_mass = plates.opened_by_mass(mass, unbalance * (1.0 + rounding) / mass)
        assert plates.mass(opened_by_mass) == pytest.approx(mass, rel=1e-13)
        assert np.all(opened_by_mass <= full)
