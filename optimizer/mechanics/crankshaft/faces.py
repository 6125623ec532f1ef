"""Faces of a request as arrays, and the same in another frame."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from optimizer.numerics.arrays import Real
from optimizer.numerics.records import record
from schemas.request.shaft import CylinderFace, OtherFace, PlaneFace, ShaftRequest

Numbers = NDArray[np.intp]


@record(frozen=True)
class Frame:
    """An origin (3,) and three directions at right angles, the rows of `across` (3, 3)."""

    origin: Real
    across: Real

    def points(self, points: Real) -> Real:
        """Points (..., 3) as seen from the frame."""
        return (points - self.origin) @ self.across.T

    def directions(self, directions: Real) -> Real:
        """Directions (..., 3) as seen from the frame."""
        return directions @ self.across.T


@record(frozen=True)
class Cylinders:
    """Outer round faces: point and unit direction of their axes (n, 3), radius (n,), ends (n, 2), angle (n,) deg.

    number : of each face in the request (n,).
    points : of each face's edges, n arrays (k, 3).
    """

    number: Numbers
    point: Real
    direction: Real
    radius: Real
    ends: Real
    angle_deg: Real
    points: tuple[Real, ...]

    @property
    def length(self) -> Real:
        """Along the axes (n,)."""
        return np.abs(self.ends[:, 1] - self.ends[:, 0])

    @property
    def area(self) -> Real:
        """Of the faces (n,)."""
        return np.deg2rad(self.angle_deg) * self.radius * self.length

    @property
    def tips(self) -> Real:
        """Both ends of every axis (n, 2, 3)."""
        return self.point[:, None] + self.ends[..., None] * self.direction[:, None]

    def in_frame(self, frame: Frame) -> Self:
        """The same in a frame."""
        return replace(
            self,
            point=frame.points(self.point),
            direction=frame.directions(self.direction),
            points=tuple(frame.points(point) for point in self.points),
        )

    def subset(self, mask: NDArray[np.bool_]) -> Self:
        """Some of them."""
        return replace(
            self,
            number=self.number[mask],
            point=self.point[mask],
            direction=self.direction[mask],
            radius=self.radius[mask],
            ends=self.ends[mask],
            angle_deg=self.angle_deg[mask],
            points=tuple(point for point, keep in zip(self.points, mask, strict=True) if keep),
        )


@record(frozen=True)
class Planes:
    """Plane faces: a point and the unit normal out of the material (n, 3), area (n,), NaN where it is undetermined."""

    number: Numbers
    point: Real
    normal: Real
    area: Real
    points: tuple[Real, ...]

    def in_frame(self, frame: Frame) -> Self:
        """The same in a frame."""
        return replace(
            self,
            point=frame.points(self.point),
            normal=frame.directions(self.normal),
            points=tuple(frame.points(point) for point in self.points),
        )


def cylinders_of(request: ShaftRequest) -> Cylinders:
    """The outer round faces; bores show nothing that counts here."""
    pairs = [(n, face) for n, face in enumerate(request.faces) if isinstance(face, CylinderFace) and face.outer]
    faces = [surface for _, surface in pairs]
    return Cylinders(
        number=np.array([n for n, _ in pairs], dtype=np.intp),
        point=_triples([face.centre_m for face in faces]),
        direction=_units([face.axis for face in faces]),
        radius=np.array([face.radius_m for face in faces]),
        ends=np.array([sorted(face.ends_m) for face in faces]).reshape(-1, 2),
        angle_deg=np.array([face.angle_deg for face in faces]),
        points=tuple(_triples(face.points_m) for face in faces),
    )


def planes_of(request: ShaftRequest) -> Planes:
    """The plane faces."""
    pairs = [(n, face) for n, face in enumerate(request.faces) if isinstance(face, PlaneFace)]
    faces = [surface for _, surface in pairs]
    return Planes(
        number=np.array([n for n, _ in pairs], dtype=np.intp),
        point=_triples([face.centre_m for face in faces]),
        normal=_units([face.normal for face in faces]),
        area=np.array([np.nan if face.area_m2 is None else face.area_m2 for face in faces]),
        points=tuple(_triples(face.points_m) for face in faces),
    )


def freeform_points(request: ShaftRequest) -> Real:
    """Points (n, 3) of all faces that are neither round nor plane."""
    return _triples([point for face in request.faces if isinstance(face, OtherFace) for point in face.points_m])


def _triples(points: Sequence[Sequence[float]]) -> Real:
    return np.array(points, dtype=float).reshape(-1, 3)


def _units(directions: Sequence[Sequence[float]]) -> Real:
    """Directions of length 1; scaled first, that no square overflows or vanishes."""
    vectors = _triples(directions)
    vectors = vectors / np.max(np.abs(vectors), axis=-1, keepdims=True, initial=1e-300)
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
