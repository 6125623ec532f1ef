"""What an answer is worth where things are not quite what they should be."""

from typing import Annotated

from pydantic import Field

from schemas.base import Model
from schemas.units import Unit


class Sensitivity(Model):
    """What the objective may rise by where all counterweights are off together, each whichever way is worst."""

    objective_rise_per_deg: Annotated[float, Unit("1/deg")] = Field(
        ge=0,
        description="by up to one degree each; exact of one peak or the larger of several, no less than it of a sum of"
        " peaks, or of loads over the whole turn",
        examples=[105.4],
    )
    objective_rise_per_percent: float = Field(
        ge=0,
        description="by up to one per cent of their mass each; exact of one peak or the largest of several, no less"
        " than it of a sum of peaks",
        examples=[60.4],
    )
