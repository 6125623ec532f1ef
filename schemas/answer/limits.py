"""What limits are called, and what each costs."""

from typing import TYPE_CHECKING, Literal

from pydantic import Field

from schemas.base.model import Model
from schemas.base.quantities import (
    Name,
)
from schemas.base.responses import ceilings

WebLimit = Literal[
    "max_mass",
    "envelope",
    "max_centrifugal_force",
    "sector",
]


if TYPE_CHECKING:
    CeilingField = str
    MachineLimit = str
else:
    #: of the responses on the frame, and inside the shaft
    CeilingField = Literal[
        *(ceiling.field for ceiling in ceilings()),
        "bearing_ceiling_N",
        "specific_load_ceiling_Pa",
        "bending_ceiling_Nm",
    ]
    MachineLimit = Literal[
        "max_total_mass",
        *(ceiling.limit for ceiling in ceilings()),
        "bearing_ceiling",
        "specific_load_ceiling",
        "bending_ceiling",
    ]


PriceUnit = Literal[
    "N/kg", "N/(kg m)", "N/deg", "N/N", "N/(N m)", "N/Pa",
    "N m/kg", "N m/(kg m)", "N m/deg", "N m/N", "N m/(N m)", "N m/Pa",
    "Pa/kg", "Pa/(kg m)", "Pa/deg", "Pa/N", "Pa/(N m)", "Pa/Pa",
]  # fmt: skip


class ShadowPrice(Model):
    """What a limit costs: how much the smallest objective falls per unit by which the limit is raised."""

    limit: WebLimit | MachineLimit = Field(description="the limit", examples=["max_mass"])
    web: Name | None = Field(description="web whose limit it is; null for a limit of the machine", examples=["1a"])
    value: float = Field(
        ge=0,
        description="fall of the objective per unit of the limit. The objective is taken as a force (over the force"
        " weight). Where the force has no weight, it is a moment, then a bearing load, bending moment or roll. The"
        " price is 0 if it cannot be distinguished from 0 by the certificate",
        examples=[102.8],
    )
    unit: PriceUnit = Field(description="unit of the value; sectors are opened to both sides", examples=["N/kg"])
