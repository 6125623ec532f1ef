"""What any CAD lists of a shaft: round and plane faces, and the mass of bodies."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from schemas.base.model import Model
from schemas.base.quantities import Flag, Length, Name
from schemas.base.rules import Rule, Ruled
from schemas.base.units import Unit, positive, symmetric
from schemas.base.vectors import Direction, Interval, Point, Uniform

MAX_FACES = 5_000
MAX_BODIES = 250
MAX_POINTS = 64

_Inertia = Annotated[float, symmetric(1e24), Unit("kg m2")]
_Row = Annotated[tuple[_Inertia, _Inertia, _Inertia], Uniform()]
#: directions below this share of their length are parallel
_PARALLEL = 1e-6
#: planes nearer than this share of their distance from z = 0, or than this in m, are one
_APART = 1e-9


class _Face(Ruled):
    """What is listed of every face."""

    name: Name | None = Field(None, description="what the CAD calls the face; it is repeated", examples=["Face12"])
    points_m: Annotated[tuple[Point, ...], Field(max_length=MAX_POINTS)] = Field(
        (),
        description="points of its edges: the ends of straight ones, the ends and the middle of curved ones; only the"
        " outline of a web is measured by them",
        examples=[[[0.1, 0.12, 0.2], [0.1, 0.12, 0.27]]],
    )

    def rules(self) -> Iterator[Rule]:
        return iter(())


class CylinderFace(_Face):
    """A round face, or a part of one."""

    type: Literal["cylinder"] = Field(description="round about an axis", examples=["cylinder"])
    centre_m: Point = Field(description="a point of its axis", examples=[[0.14, 0.0, 0.0]])
    axis: Direction = Field(description="direction of its axis, of any length", examples=[[0, 0, 1]])
    radius_m: Length = Field(description="its radius", examples=[0.075])
    ends_m: Interval = Field(
        description="where it begins and ends along its axis, from `centre_m`, in either order", examples=[[0.0, 0.14]]
    )
    angle_deg: Annotated[float, positive(360.0), Unit("deg")] = Field(
        360.0, description="angle that it goes about its axis; 360 all about it", examples=[360.0]
    )
    outer: Flag = Field(True, description="whether the material is inside; false for a bore", examples=[True])

    def rules(self) -> Iterator[Rule]:
        yield Rule(not any(self.axis), ("axis",), "must not be zero")
        message = "both ends are the same: a cylinder without length"
        yield Rule(self.ends_m[0] == self.ends_m[1], ("ends_m",), message)


class PlaneFace(_Face):
    """A plane face."""

    type: Literal["plane"] = Field(description="plane", examples=["plane"])
    centre_m: Point = Field(description="its centre of area, or a point of it", examples=[[0.07, 0.0, 0.105]])
    normal: Direction = Field(description="its normal, out of the material, of any length", examples=[[0, 0, -1]])
    area_m2: Annotated[Annotated[float, positive(1e12)] | None, Unit("m2")] = Field(
        None, description="its area; the largest plane faces of a web are its flanks", examples=[0.0787]
    )

    def rules(self) -> Iterator[Rule]:
        yield Rule(not any(self.normal), ("normal",), "must not be zero")


class OtherFace(_Face):
    """Any other face: a fillet, a cone, a free form. Its points count where it bounds a web."""

    type: Literal["other"] = Field(description="neither round about an axis nor plane", examples=["other"])


Face = Annotated[CylinderFace | PlaneFace | OtherFace, Field(discriminator="type")]


class Body(Model):
    """What a CAD says of the mass of a body."""

    name: Name | None = Field(None, description="what the CAD calls it", examples=["Crankshaft"])
    mass_kg: Annotated[float, positive(1e15), Unit("kg")] = Field(description="its mass", examples=[412.0])
    centre_m: Point = Field(description="its centre of mass", examples=[[0.0, 0.0, 0.01]])
    inertia_kg_m2: Annotated[tuple[_Row, _Row, _Row], Uniform()] | None = Field(
        None,
        description="tensor of inertia about its centre of mass, along the axes of the model, row by row; off the"
        " diagonal stand minus the products of inertia. Null where they are zero, as of a disc across the shaft",
        examples=[[[21.0, 0, -0.3], [0, 21.2, 0], [-0.3, 0, 4.1]]],
    )
    volume_m3: Annotated[Annotated[float, positive(1e12)] | None, Unit("m3")] = Field(
        None, description="its volume; with it the density is checked", examples=[0.0525]
    )


class ShaftFrame(Ruled):
    """Where the shaft is in the model."""

    origin_m: Point = Field(description="a point of the axis, from which positions count", examples=[[0, 0, 0]])
    z: Direction = Field(description="along the shaft", examples=[[0, 0, 1]])
    x: Direction = Field(description="from where angles count; only its part across z counts", examples=[[1, 0, 0]])

    def rules(self) -> Iterator[Rule]:
        yield Rule(not any(self.z), ("z",), "must not be zero")
        (a, b, c), (d, e, f) = self.z, self.x
        across = max(abs(b * f - c * e), abs(c * d - a * f), abs(a * e - b * d))
        parallel = across <= _PARALLEL * max(map(abs, self.z)) * max(map(abs, self.x))
        yield Rule(any(self.z) and parallel, ("x",), "must not be zero, nor along z")


class ShaftRequest(Ruled):
    """Which crankshaft do these faces and bodies show?"""

    faces: tuple[Face, ...] = Field(
        (),
        max_length=MAX_FACES,
        description="faces of the shaft, in any order; those that are neither round nor plane may be left out",
        examples=[
            [{"type": "cylinder", "centre_m": [0, 0, 0], "axis": [0, 0, 1], "radius_m": 0.08, "ends_m": [0, 0.17]}]
        ],
    )
    bodies: tuple[Body, ...] = Field(
        (),
        max_length=MAX_BODIES,
        description="bodies that turn with the shaft, whose unbalance is asked for",
        examples=[[{"name": "Crankshaft", "mass_kg": 412.0, "centre_m": [0.0, 0.0, 0.01]}]],
    )
    frame: ShaftFrame | None = Field(
        None,
        description="the frame of the shaft; null is found from the faces: z along the axis, x towards the first pin",
        examples=[None],
    )
    planes_m: Interval | None = Field(
        None,
        description="planes along the shaft in which the unbalance of the bodies is stated; null is both ends of the"
        " round faces",
        examples=[[-0.4, 0.4]],
    )
    tolerance_m: Annotated[Length | None, Unit("m")] = Field(
        None,
        description="by how much measures of one thing may differ; null is a hundred thousandth of the shaft's length",
        examples=[None],
    )

    def rules(self) -> Iterator[Rule]:
        yield Rule(not self.faces and not self.bodies, ("faces",), "list the faces of a shaft, or its bodies, or both")
        bare = not self.faces and bool(self.bodies)
        yield Rule(bare and self.frame is None, ("frame",), "without faces nothing shows where the axis is: give it")
        yield Rule(bare and self.planes_m is None, ("planes_m",), "without faces nothing shows two planes: give them")
        if self.planes_m is not None:
            low, high = self.planes_m
            same = abs(high - low) <= _APART * max(1.0, abs(low), abs(high))
            yield Rule(same, ("planes_m",), "two planes at one place bear no couple")
