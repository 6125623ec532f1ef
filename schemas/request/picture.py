"""A picture of the answer to an optimisation: what is drawn, and how large."""

from typing import Annotated

from pydantic import Field, Strict, StringConstraints

from schemas.base.model import Model
from schemas.base.quantities import Flag
from schemas.request.requests import OptimizeRequest

Heading = Annotated[str, StringConstraints(min_length=1, max_length=120, pattern=r"^[^\x00-\x1f\x7f]+$")]


class PictureStyle(Model):
    """Size, ground and title of a picture."""

    width_px: Annotated[int, Strict()] | None = Field(
        None, ge=100, le=4000, description="width of the picture in pixels; null is its own", examples=[1280]
    )
    transparent: Flag = Field(True, description="without a white ground", examples=[False])
    title: Heading | None = Field(None, description="title above the picture", examples=["2D12, front view"])


class PictureRequest(OptimizeRequest):
    """Draw the answer to an optimisation."""

    picture: PictureStyle = Field(
        PictureStyle(), description="size, ground and title", examples=[{"width_px": 1280, "transparent": False}]
    )
