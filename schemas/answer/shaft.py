"""The crankshaft that faces and bodies show."""

from typing import Literal

from pydantic import Field

from schemas.base.model import Answer, Model
from schemas.base.quantities import Degrees, KilogramMetres, Kilograms, Metres, Name
from schemas.base.vectors import DirectionOut, PointOut

DoubtCode = Literal[
    "air", "bearing", "beside", "density", "eccentric", "interrupted", "no_plane", "no_room", "outline", "round_web",
    "size", "tapered_web",
]  # fmt: skip


class ShaftAxis(Model):
    """The line about which the shaft turns, in the axes of the model."""

    point_m: PointOut = Field(description="its point nearest to the origin of the model", examples=[[0.0, 0.0, 0.0]])
    direction: DirectionOut = Field(description="its direction, of length 1", examples=[[0.0, 0.0, 1.0]])


class ShaftFrameOut(Model):
    """The frame of the shaft in the axes of the model; positions and angles of the answer are in it."""

    origin_m: PointOut = Field(description="where z is 0", examples=[[0.0, 0.0, 0.0]])
    x: DirectionOut = Field(description="direction from which angles count", examples=[[1.0, 0.0, 0.0]])
    y: DirectionOut = Field(description="z cross x", examples=[[0.0, 1.0, 0.0]])
    z: DirectionOut = Field(description="along the shaft", examples=[[0.0, 0.0, 1.0]])


class ShaftThrow(Model):
    """A throw as a machine has it, without rows."""

    name: Name = Field(description="its number along the shaft, from 1", examples=["1"])
    position_m: Metres = Field(description="middle of the crank pin", examples=[-0.175])
    crank_radius_m: Metres = Field(description="from the axis to that of the pin", examples=[0.14])
    crank_angle_deg: Degrees = Field(description="direction of the pin", examples=[0.0])


class ShaftEnvelope(Model):
    """The plate beside a web, opposite its crank, that fits."""

    shape: Literal["sector"] = Field("sector", description="outline of the plate", examples=["sector"])
    inner_radius_m: Metres = Field(description="how far the web reaches opposite its crank", examples=[0.12])
    outer_radius_m: Metres = Field(description="how far the web reaches at most", examples=[0.26])
    thickness_m: Metres = Field(description="between its plane flanks, without fillets", examples=[0.07])


class ShaftWeb(Model):
    """A web as a machine has it."""

    name: Name = Field(description="number of its throw, and a letter", examples=["1a"])
    position_m: Metres = Field(description="middle between its flanks", examples=[-0.28])
    throw: int = Field(description="number of its throw, from 0", examples=[0])
    envelope: ShaftEnvelope = Field(
        description="the plate that fits beside it",
        examples=[{"shape": "sector", "inner_radius_m": 0.12, "outer_radius_m": 0.26, "thickness_m": 0.07}],
    )


class ShaftBearing(Model):
    """A main bearing as a machine has it."""

    name: Name = Field(description="letter along the shaft", examples=["A"])
    position_m: Metres = Field(description="middle of its journal", examples=[-0.4])
    diameter_m: Metres = Field(description="of its journal", examples=[0.16])
    length_m: Metres = Field(description="of its journal", examples=[0.17])


class PlaneUnbalance(Model):
    """An unbalance as a machine has it."""

    name: Name = Field(description="of which plane", examples=["shaft, plane 1"])
    position_m: Metres = Field(description="the plane", examples=[-0.485])
    x_kg_m: KilogramMetres = Field(description="x component of mass times radius", examples=[1.2])
    y_kg_m: KilogramMetres = Field(description="y component of mass times radius", examples=[0.0])


class _Stretch(Model):
    """From where to where, and the faces that show it."""

    from_m: Metres = Field(description="where it begins along the shaft", examples=[-0.245])
    to_m: Metres = Field(description="where it ends", examples=[-0.105])
    faces: tuple[int, ...] = Field(description="numbers in the request of the faces that show it", examples=[[12]])


class ShaftPin(_Stretch):
    """The crank pin of a throw."""

    throw: int = Field(description="number of its throw, from 0", examples=[0])
    diameter_m: Metres = Field(description="its smallest diameter", examples=[0.15])


class ShaftJournal(_Stretch):
    """A round stretch about the axis."""

    diameter_m: Metres = Field(description="its diameter", examples=[0.16])
    bearing: Name | None = Field(description="the bearing that is taken to be on it; null if none", examples=["A"])


class ShaftPlate(_Stretch):
    """The material of a web."""

    web: Name | None = Field(description="the web of the answer; null if it has no envelope", examples=["1a"])
    thickness_m: Metres = Field(description="between its plane flanks, without fillets", examples=[0.07])
    hub_m: Metres | None = Field(
        description="how far it reaches opposite its crank; null if its outline is not known", examples=[0.12]
    )
    reach_m: Metres | None = Field(
        description="how far it reaches at most; null if its outline is not known", examples=[0.26]
    )


class Rotor(Model):
    """The bodies together."""

    mass_kg: Kilograms = Field(description="their mass", examples=[412.0])
    centre_m: PointOut = Field(description="their centre of mass, in the shaft's frame", examples=[[0.0, 0.0, 0.01]])
    unbalance_kg_m: KilogramMetres = Field(description="mass times distance from the axis", examples=[0.35])


class Doubt(Model):
    """What a designer should look at."""

    code: DoubtCode = Field(description="what it is about", examples=["round_web"])
    message: str = Field(
        description="what was seen, and what was made of it",
        examples=["a smaller pin stands on it: taken for a round web, not for a crank pin"],
    )
    pointer: str = Field(description="the face or body of the request", examples=["/faces/17"])
    serious: bool = Field(
        description="the shaft is not what it seems, or not in the units that it seems to be in: correct it first",
        examples=[False],
    )


class ShaftAnswer(Answer):
    """The crankshaft; `throws`, `webs`, `bearings` and `unbalances` go into a machine as they are."""

    axis: ShaftAxis = Field(description="the axis, in the model", examples=[{"direction": [0, 0, 1]}])
    frame: ShaftFrameOut = Field(description="the shaft's frame, in the model", examples=[{"z": [0, 0, 1]}])
    throws: tuple[ShaftThrow, ...] = Field(description="throws along the shaft", examples=[[{"name": "1"}]])
    webs: tuple[ShaftWeb, ...] = Field(
        description="webs beside which a plate fits, along the shaft", examples=[[{"name": "1a"}]]
    )
    bearings: tuple[ShaftBearing, ...] = Field(
        description="the longest journal of every stretch between throws", examples=[[{"name": "A"}]]
    )
    unbalances: tuple[PlaneUnbalance, ...] = Field(
        description="the bodies' unbalance in two planes: exact for force and moment", examples=[[]]
    )
    pins: tuple[ShaftPin, ...] = Field(description="crank pins, throw by throw", examples=[[{"throw": 0}]])
    journals: tuple[ShaftJournal, ...] = Field(description="all round stretches about the axis", examples=[[]])
    plates: tuple[ShaftPlate, ...] = Field(description="the material of all webs", examples=[[]])
    rotor: Rotor | None = Field(description="the bodies together; null without bodies", examples=[None])
    doubts: tuple[Doubt, ...] = Field(description="what a designer should look at", examples=[[]])
