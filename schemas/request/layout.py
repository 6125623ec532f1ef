"""The views of a machine as it is typed: what is drawn, and what is still missing for the rest."""

from typing import Annotated, Any

from pydantic import Field

from schemas.answer.problem import FieldError
from schemas.base.model import Answer, Model
from schemas.machine.rotor import MAX_WEBS

#: JSON that is read as far as it goes
Typed = dict[str, Any]


class LayoutRequest(Model):
    """Draw a machine, whole or half-typed; nothing is solved."""

    machine: Typed = Field(
        description="a machine, of which what is known is drawn: places, radii, angles, names",
        examples=[
            {
                "kind": "reciprocating",
                "throws": [{"position_m": "175 mm", "crank_radius_m": "140 mm", "crank_angle_deg": 0}, {}],
            }
        ],
    )
    counterweights: Annotated[tuple[Typed, ...], Field(max_length=MAX_WEBS)] = Field(
        (),
        description="counterweights on its webs, as an answer gives them: `web`, `mass_kg`, `angle_deg`, `radius_m`,"
        " `shape`, `fixed`",
        examples=[[{"web": "1a", "mass_kg": 24.5, "angle_deg": 180, "radius_m": 0.25}]],
    )
    fitted: Annotated[tuple[Typed, ...], Field(max_length=MAX_WEBS)] = Field(
        (),
        description="what is fitted in place of them, drawn beside them: `web`, `mass_kg`, `angle_deg`, and `radius_m`"
        " where it is not that of the web",
        examples=[[{"web": "1a", "mass_kg": 24, "angle_deg": 180}]],
    )


class LayoutAnswer(Answer):
    """The views as SVG."""

    front: str | None = Field(
        description="the machine from the front at shaft angle 0, as SVG; null where nothing can be drawn",
        examples=["<svg xmlns='http://www.w3.org/2000/svg'/>"],
    )
    side: str | None = Field(
        description="the machine along its shaft, as SVG; null where nothing can be drawn", examples=[None]
    )
    missing: tuple[FieldError, ...] = Field(
        description="why parts are not drawn, the first of them: fields that are missing or cannot be read",
        examples=[[{"pointer": "/machine/throws/1/position_m", "message": "required"}]],
    )
