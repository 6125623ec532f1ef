"""Loads on the foundation, order by order."""

from typing import Annotated

from pydantic import AfterValidator, Field, Strict
from pydantic_core import PydanticCustomError

from schemas.base.model import Model
from schemas.base.quantities import Degrees, NewtonMetres, Newtons

_PHASE = (
    "phase in [0, 360): the load is A cos(order psi - phase), psi the angle of the shaft since the outer dead centre,"
    " in the sense of rotation. It is 0 where the amplitude is 0"
)


def _distinct(orders: tuple[int, ...]) -> tuple[int, ...]:
    if len(set(orders)) < len(orders):
        raise PydanticCustomError("distinct", "every order once")
    return tuple(sorted(orders))


FoundationOrders = Annotated[
    tuple[Annotated[int, Strict(), Field(ge=1, le=6)], ...],
    Field(min_length=1, max_length=6),
    AfterValidator(_distinct),
]


class ForceOscillation(Model):
    """A force along one axis at one multiple of the shaft speed."""

    amplitude_N: Newtons = Field(description="amplitude, half of its range", examples=[4997.4])
    phase_deg: Degrees = Field(description=_PHASE, examples=[0.0])


class CoupleOscillation(Model):
    """A couple of the forces along one axis at one multiple of the shaft speed."""

    amplitude_Nm: NewtonMetres = Field(description="amplitude, half of its range", examples=[19494.0])
    phase_deg: Degrees = Field(description=_PHASE, examples=[0.0])


class FoundationLoad(Model):
    """Forces on the frame, and couples sum (z - z_ref) F about the reference plane."""

    force_x: ForceOscillation = Field(description="force along x", examples=[{"amplitude_N": 4997.4, "phase_deg": 0}])
    force_y: ForceOscillation = Field(description="force along y", examples=[{"amplitude_N": 0.0, "phase_deg": 0}])
    couple_of_x_forces: CoupleOscillation = Field(
        description="couple of the forces along x, which turns about y (horizontal couple where x is level)",
        examples=[{"amplitude_Nm": 19494.0, "phase_deg": 0}],
    )
    couple_of_y_forces: CoupleOscillation = Field(
        description="couple of the forces along y, which turns about x (vertical couple where y is upright)",
        examples=[{"amplitude_Nm": 0.0, "phase_deg": 0}],
    )


class OrderOfFoundation(Model):
    """What the foundation feels at one multiple of the shaft speed."""

    order: int = Field(description="multiple of the shaft speed", examples=[1])
    dead_centre_deg: Degrees = Field(
        description="shaft angle from which phases count: the outer dead centre of throw 1, first row; 0 where there is"
        " none",
        examples=[0.0],
    )
    before: FoundationLoad = Field(
        description="without counterweights", examples=[{"force_x": {"amplitude_N": 9994.7}}]
    )
    after: FoundationLoad | None = Field(
        None, description="with the counterweights; null if infeasible", examples=[{"force_x": {"amplitude_N": 4997.4}}]
    )
    as_built: FoundationLoad | None = Field(
        None, description="with what is fitted; null where nothing is said to be", examples=[None]
    )
