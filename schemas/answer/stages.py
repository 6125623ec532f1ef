"""What the eight balancing stages hold as data: forces and moments that act, and iron for any share."""

from typing import Annotated, Literal

from pydantic import Field

from schemas.base.model import Model
from schemas.base.quantities import Degrees, KilogramMetres, Metres
from schemas.base.units import AnswerUnit


class Acting(Model):
    """A force or a moment of one order over a turn: an ellipse, of which circle and line are the ends."""

    quantity: Literal["force", "moment"] = Field(description="which of the two", examples=["force"])
    order: int = Field(description="multiple of the shaft speed", examples=[1])
    frequency_Hz: Annotated[float, AnswerUnit("Hz")] = Field(description="its frequency", examples=[8.333])
    unit: Literal["N", "N m"] = Field(description="unit of peak and minor", examples=["N"])
    peak: float = Field(description="major semi-axis, largest over a revolution", examples=[9994.7])
    minor: float = Field(description="minor semi-axis", examples=[0.0])
    motion: Literal["none", "with_shaft", "against_shaft", "fixed", "ellipse"] = Field(
        description="how it moves: it turns with the shaft or against it, keeps a direction, or runs on an ellipse",
        examples=["fixed"],
    )
    direction_deg: Degrees | None = Field(
        description="where it points at shaft angle 0 if it turns, else the direction of the major axis in [0, 180)."
        " For a moment, it is the direction that spans its plane together with the shaft. Null where there is none",
        examples=[0.0],
    )


class StageIron(Model):
    """Mass times radius in one plane: the rotating part, and the reciprocating one for the whole force."""

    position_m: Metres = Field(description="plane along the shaft", examples=[0.28])
    rotating_x_kg_m: KilogramMetres = Field(description="x against the rotating masses", examples=[-1.7])
    rotating_y_kg_m: KilogramMetres = Field(description="y against the rotating masses", examples=[0.0])
    reciprocating_x_kg_m: KilogramMetres = Field(
        description="x for share 1 of the reciprocating masses; for a share k add k times as much", examples=[-3.9]
    )
    reciprocating_y_kg_m: KilogramMetres = Field(description="y of the same", examples=[0.0])
