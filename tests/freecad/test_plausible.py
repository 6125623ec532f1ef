"""Units of cells, and whether a shaft can be one: what is shown, and what stops."""

from decimal import Decimal

import pytest
from freecad.counterweight.plausible import Piece, Sizes, reasons, summary, unlike
from freecad.counterweight.quantities import UNITS, quantity

from schemas.base.units import UNITS as SERVICE

SHAFT = Sizes((Piece("Crankshaft", 0.0449, 7850.0),), 0.97)


def machine(radius_m: float, **row: object) -> dict[str, object]:
    return {"throws": [{"name": "1", "crank_radius_m": radius_m, "rows": [{"axis_deg": 0.0, **row}]}]}


def test_units_are_those_of_the_service() -> None:
    for name, units in UNITS.items():
        assert units == SERVICE[{"Nm": "N m"}.get(name, name)]
    assert quantity("thickness_m", "180 mm") == 0.18
    assert quantity("envelope_m", " 7.5in ") == float(Decimal("0.1905"))
    for name, text in (("mass_kg", "7 mm"), ("length_m", "mm"), ("length_m", "1e9999 mm"), ("density_kg_m3", "1 m")):
        assert quantity(name, text) is None


def test_mass_and_sizes_are_said_in_a_line() -> None:
    words = "The shaft weighs 352.47 kg (1 body of 7,850 kg/m3) and is 970 mm long; crank radius 140 mm."
    assert summary(SHAFT, machine(0.14)["throws"]) == words  # type: ignore[arg-type]


ROD = {"connecting_rod": {"length_m": 0.7}, "reciprocating_mass_kg": 277.0, "cylinder": {"bore_m": 0.5}}


def test_a_shaft_as_drawn_can_be_one() -> None:
    assert reasons(SHAFT, machine(0.14, **ROD)) == []


@pytest.mark.parametrize(
    ("sizes", "radius", "text"),
    [
        (
            Sizes((Piece("Crank", 0.0449, 7.85),), 0.97),
            0.14,
            "Crank: a density of 7.85 kg/m3; shafts have 1000 to 20000",
        ),
        (Sizes((Piece("Crank", 2.74e-6, 7850.0),), 0.038), 0.00551, "a rod of 700 mm is 127 times as long"),
        (Sizes((Piece("Crank", 2.74e-6, 7850.0),), 0.038), 0.00551, "a stroke of 11.02 mm in a bore of 500 mm"),
        (Sizes((Piece("Crank", 2.74e-6, 7850.0),), 0.038), 0.00551, "277 kg move on a shaft of 0.0215 kg"),
        (SHAFT, 0.5, "a rod of 700 mm is 1.4 times as long"),
    ],
    ids=["density", "inches by the rod", "inches by the bore", "inches by the mass", "rod too short"],
)
def test_what_cannot_be_a_shaft_is_said(sizes: Sizes, radius: float, text: str) -> None:
    assert any(text in line for line in reasons(sizes, machine(radius, **ROD)))


def test_a_crank_that_is_described_otherwise() -> None:
    throws = [{"name": "1", "crank_radius_m": 0.14}, {"name": "2", "crank_radius_m": 0.14}]
    assert unlike(throws, [{"crank_radius_m": 0.1401}, {}]) == []
    (line,) = unlike(throws, [{}, {"crank_radius_m": 0.15}])
    assert line == "throw 2: the faces show a crank radius of 140 mm, 150 mm are described"
