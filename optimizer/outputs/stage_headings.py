"""The eight balancing stages by name: what each is about, and its formula (Balancing, slides)."""

from typing import Literal, NamedTuple


class Heading(NamedTuple):
    """What a stage is called, and what its value is."""

    stage: Literal["I", "II", "III", "IV", "V", "VI", "VII", "VIII"]
    title: str
    quantity: str
    formula: str
    unit: str


_ARMS = "every term times (z - z_ref)"
STAGE_I = Heading(
    "I", "forces of rotating masses", "constant force that turns with the shaft", "omega^2 |sum m_r r e^{jd}|", "N"
)
STAGE_II = Heading(
    "II",
    "moments of rotating masses",
    "constant moment whose plane turns with the shaft",
    f"as stage I, {_ARMS}",
    "N m",
)
STAGE_III = Heading(
    "III",
    "first-order forces of reciprocating masses",
    "peak force over a revolution",
    "|A1| + |B1|, A1 = omega^2/2 sum m r e^{jd}, B1 = omega^2/2 sum m r e^{j(2g - d)}",
    "N",
)
STAGE_IV = Heading(
    "IV", "moments of first-order forces", "peak moment over a revolution", f"as stage III, {_ARMS}", "N m"
)
STAGE_V = Heading(
    "V",
    "second-order forces of reciprocating masses",
    "peak force over a revolution",
    "|A2| + |B2|, A2 = omega^2/2 sum m r a2 e^{j(2d - g)}, B2 = omega^2/2 sum m r a2 e^{j(3g - 2d)}, "
    "a2 the second harmonic of the acceleration, r/l in the shortest series",
    "N",
)
STAGE_VI = Heading(
    "VI", "moments of second-order forces", "peak moment over a revolution", f"as stage V, {_ARMS}", "N m"
)
STAGE_VII = Heading(
    "VII",
    "counterweights by superposition",
    "total mass times radius, in the two outermost planes, that removes all that turns with the shaft "
    "(rotating masses and co-rotating half of the reciprocating masses); remaining is the part still missing",
    "|u1| + |u2|, u1 + u2 = -f, z1 u1 + z2 u2 = -c, f and c the co-rotating force and moment over omega^2",
    "kg m",
)
STAGE_VIII = Heading(
    "VIII",
    "summary of the residual unbalance",
    "sum of the peak forces of orders 1 and 2, which their force never exceeds; the plane names every force and "
    "moment that is left",
    "|R + A1| + |B1| + |A2| + |B2|",
    "N",
)
HEADINGS = (STAGE_I, STAGE_II, STAGE_III, STAGE_IV, STAGE_V, STAGE_VI, STAGE_VII, STAGE_VIII)
#: fields of an answer, by stage
WORDS = tuple(heading._asdict() for heading in HEADINGS)
