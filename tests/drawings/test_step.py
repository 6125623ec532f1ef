"""STEP files: closed solids of the right volume, under their names."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from schemas.machine.webs import Envelope
from service.drawings.outline import outline, rotation
from service.drawings.step import Solid, step
from tests.drawings.exchange import File, names
from tests.drawings.plates import HALF_ANGLES, mechanics_of, plates


@given(plates(), HALF_ANGLES, st.floats(-4.0, 4.0), st.floats(-3.0, 3.0))
def test_solids_are_closed_and_of_the_volume_of_their_plates(
    plate: Envelope, half_angle: float, angle: float, position: float
) -> None:
    low, high = position - 0.5 * plate.thickness_m, position + 0.5 * plate.thickness_m
    edges = rotation(outline(plate, half_angle), angle)
    (volume,) = File(step("part", [Solid("part", edges, low, high)])).volumes()
    # independent: the closed form of the mass, of a density of 1; rounding grows with the distance along the shaft
    room = 1e-12 * 1e9 * plate.outer_radius_m**2 * (abs(position) + 1.0)
    assert volume == pytest.approx(1e9 * float(mechanics_of(plate).mass(half_angle)) * (high - low), rel=1e-9, abs=room)


def test_several_solids_are_several_products() -> None:
    plate = Envelope(shape="segment", inner_radius_m=0.06, outer_radius_m=0.25, thickness_m=0.04)
    edges = outline(plate, 1.3)
    texts = ["Counterweight 1a", "it's \\ a 'name'", "Gegengewicht für 曲柄 🛠"]
    file = File(step("machine", [Solid(name, edges, 0.1 * k, 0.1 * k + 0.04) for k, name in enumerate(texts)]))
    assert list(names(file.products())) == texts
    assert file.volumes() == pytest.approx([file.volumes()[0]] * 3, rel=1e-11)


def test_numbers_have_the_point_that_they_must_have() -> None:
    plate = Envelope(shape="sector", outer_radius_m=1e3, thickness_m=1e-5)
    content = step("part", [Solid("part", outline(plate, 1e-3), 0.0, 1e-5)]).decode()
    assert "1000000." in content
    assert "0.01" in content
    assert "e-" not in content.split("DATA;")[1]
