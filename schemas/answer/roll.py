"""Roll moment of a machine over the turn."""

from pydantic import Field

from schemas.answer.dynamics import MomentBracket, ShaftAngles
from schemas.base.curves import Curve
from schemas.base.model import Model
from schemas.base.quantities import Degrees, NewtonMetres


class RollMoment(Model):
    """Moment about the crankshaft on the frame, without its mean; counter-clockwise is positive."""

    moment_Nm: Curve[NewtonMetres] = Field(description="at the samples", examples=[[0.0]])
    peak_Nm: NewtonMetres = Field(description="largest over the cycle, magnitude", examples=[794.7])
    peak_bracket_Nm: MomentBracket
    peak_angle_deg: Degrees = Field(description="shaft angle at which it occurs", examples=[38.2])


class Roll(Model):
    """Roll moment without and with what balance shafts carry, which alone changes it; gas and friction count."""

    angle_deg: ShaftAngles
    before: RollMoment = Field(description="without unbalances on balance shafts", examples=[{"peak_Nm": 794.7}])
    after: RollMoment | None = Field(description="with them; null if infeasible", examples=[{"peak_Nm": 37.3}])
