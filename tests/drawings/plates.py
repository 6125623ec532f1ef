"""Plates, and strategies for them."""

from math import pi

from hypothesis import strategies as st

from optimizer.mechanics.envelope import AnnularSector, Envelope, Segment
from schemas.machine import webs

OUTER = st.floats(0.05, 2.0)
#: of the outer radius
INNER = st.one_of(st.just(0.0), st.floats(0.05, 0.9))
HALF_ANGLES = st.floats(0.05, pi / 2)


def plates() -> st.SearchStrategy[webs.Envelope]:
    return st.builds(
        lambda shape, outer, share, thickness: webs.Envelope(
            shape=shape, inner_radius_m=share * outer, outer_radius_m=outer, thickness_m=thickness
        ),
        st.sampled_from(["sector", "segment"]),
        OUTER,
        INNER,
        st.floats(0.005, 0.2),
    )


def mechanics_of(plate: webs.Envelope) -> Envelope:
    """The same plate, of a density that makes its mass its area, m^2."""
    kind = AnnularSector if plate.shape == "sector" else Segment
    return kind(plate.inner_radius_m, plate.outer_radius_m, 1.0, pi / 2)
