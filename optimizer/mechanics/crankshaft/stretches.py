"""Round stretches along a shaft: journals, crank pins, and round webs among them."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from optimizer.errors import refuse
from optimizer.mechanics.crankshaft.doubts import doubt
from optimizer.mechanics.crankshaft.faces import Cylinders, Numbers
from optimizer.mechanics.crankshaft.flanks import Flanks
from optimizer.numerics.arrays import Real
from optimizer.numerics.records import record
from schemas.answer.shaft import Doubt
from schemas.base.model import FieldProblem

#: angle above which faces of one cylinder go all about it; above the second they do but for a groove
_WHOLE_DEG, _MOST_DEG = 359.9, 270.0
#: a fillet between pin and web, as a share of the pin's radius, at most
_FILLET = 0.25
#: a disc about the axis is no longer than this times its radius; a journal is
_DISC = 1.5
#: share of the shorter of two stretches, above which one stands beside the other
_BESIDE = 0.6
#: share of the journals' area, above which what stands beside them is another shaft
_ANOTHER = 0.1
#: share of the largest journal's radius, below which what is beside the axis is a dowel or a bolt
_THIN = 0.15


@record(frozen=True)
class Stretch:
    """What is round about a line along the shaft: its centre across, radius, both ends, angle, its faces."""

    centre: complex
    radius: float
    low: float
    high: float
    angle_deg: float
    faces: tuple[int, ...]
    journal: bool

    @property
    def middle(self) -> float:
        """Along the shaft."""
        return (self.low + self.high) / 2

    @property
    def length(self) -> float:
        """Along the shaft."""
        return self.high - self.low


@record(frozen=True)
class Stretches:
    """Journals and pins in their order along the shaft, apart from round webs."""

    chain: tuple[Stretch, ...]
    doubts: tuple[Doubt, ...]


def stretches(cylinders: Cylinders, flanks: Flanks, tolerance: float) -> Stretches:
    """The round stretches of cylinders that are seen in the frame of their shaft.

    Raises
    ------
    OutOfRange
        without a crank pin, or with a second shaft.
    """
    candidates = [stretch for stretch in _cylinder_stretches(cylinders, tolerance) if stretch.angle_deg >= _MOST_DEG]
    doubts = [
        doubt(
            "interrupted",
            stretch.faces[0],
            f"goes {stretch.angle_deg:.4g} degrees about its axis: taken as all about it",
        )
        for stretch in candidates
        if stretch.angle_deg < _WHOLE_DEG
    ]
    candidates, more = _shaft_members(candidates, tolerance)
    doubts += more
    table = _Table.of(candidates)
    discs = [table.is_disc(n, flanks, tolerance) for n in range(len(candidates))]
    for stretch, disc in zip(candidates, discs, strict=True):
        if disc:
            message = "a smaller pin stands on it: taken for a round web, not for a crank pin or a journal"
            doubts.append(doubt("round_web", stretch.faces[0], message))
    chain = [stretch for stretch, disc in zip(candidates, discs, strict=True) if not disc]
    chain.sort(key=lambda stretch: (stretch.middle, stretch.low, stretch.centre.real, stretch.centre.imag))
    if all(stretch.journal for stretch in chain):
        message = "there is no crank pin: no full cylinder beside the axis, parallel to it"
        refuse([FieldProblem(("faces",), message)])
    return Stretches(tuple(_pins(chain, flanks, tolerance)), tuple(doubts))


def _cylinder_stretches(cylinders: Cylinders, tolerance: float) -> Iterator[Stretch]:
    """Faces of one cylinder that is cut lengthways, put together."""
    tips = cylinders.tips[..., 2]
    measures = np.column_stack([cylinders.point[:, :2], cylinders.radius, np.min(tips, axis=-1), np.max(tips, axis=-1)])
    labels = np.column_stack([_clusters(column, tolerance) for column in measures.T])
    _, label = np.unique(labels, axis=0, return_inverse=True)
    label = label.reshape(-1)
    for number in range(int(np.max(label, initial=-1)) + 1):
        faces = np.flatnonzero(label == number)
        first = faces[np.argmax(cylinders.area[faces])]
        x, y, radius, low, high = (float(value) for value in measures[first])
        yield Stretch(
            centre=complex(x, y),
            radius=radius,
            low=low,
            high=high,
            angle_deg=float(np.sum(cylinders.angle_deg[faces])),
            faces=tuple(sorted(cylinders.number[faces].tolist())),
            journal=bool(np.hypot(x, y) <= 10 * tolerance),
        )


def _clusters(values: Real, tolerance: float) -> Numbers:
    """Which of the values that differ each is (n,), whatever their order."""
    order = np.argsort(values, kind="stable")
    step = np.diff(values[order], prepend=values[order[:1]]) > tolerance
    numbers = np.empty(len(values), dtype=np.intp)
    numbers[order] = np.cumsum(step)
    return numbers


def _shaft_members(candidates: Sequence[Stretch], tolerance: float) -> tuple[list[Stretch], list[Doubt]]:
    """Without dowels, bolts, and what stands beside the shaft.

    Raises
    ------
    OutOfRange
    """
    table = _Table.of(candidates)
    thick = _THIN * float(np.max(table.radius[table.journal], initial=0.0))
    beside = np.array([table.is_beside(n, tolerance) for n in range(len(candidates))], dtype=bool)
    area = table.radius * (table.high - table.low)
    if np.sum(area[beside]) > _ANOTHER * np.sum(area[table.journal]):
        worst = candidates[int(np.argmax(np.where(beside, area, -1.0)))]
        message = "stands beside the shaft, not on it: list the faces of one shaft"
        refuse([FieldProblem(("faces", worst.faces[0]), message)])
    members, doubts = [], []
    for stretch, away in zip(candidates, beside, strict=True):
        if away or (not stretch.journal and stretch.radius < thick):
            message = "stands beside the shaft, or is too thin for a crank pin: taken for a bolt or a dowel"
            doubts.append(doubt("beside", stretch.faces[0], message))
        else:
            members.append(stretch)
    return members, doubts


@record(frozen=True)
class _Table:
    """Measures of n stretches (n,)."""

    centre: NDArray[np.complex128]
    radius: Real
    low: Real
    high: Real
    journal: NDArray[np.bool_]

    @classmethod
    def of(cls, chain: Sequence[Stretch]) -> "_Table":
        return cls(
            np.array([stretch.centre for stretch in chain], dtype=complex),
            np.array([stretch.radius for stretch in chain]),
            np.array([stretch.low for stretch in chain]),
            np.array([stretch.high for stretch in chain]),
            np.array([stretch.journal for stretch in chain], dtype=bool),
        )

    def is_beside(self, n: int, tolerance: float) -> bool:
        """Whether a stretch beside the axis is at the height of a journal, which does not pass through it."""
        if self.journal[n]:
            return False
        overlap = np.minimum(self.high, self.high[n]) - np.maximum(self.low, self.low[n])
        shorter = np.minimum(self.high - self.low, self.high[n] - self.low[n])
        clear = np.abs(self.centre - self.centre[n]) > self.radius + self.radius[n] + tolerance
        return bool(np.any(self.journal & clear & (overlap > _BESIDE * shorter)))

    def is_disc(self, n: int, flanks: Flanks, tolerance: float) -> bool:
        """Whether a smaller pin stands on it."""
        if self.journal[n] and self.high[n] - self.low[n] > _DISC * self.radius[n]:
            return False
        low, high, radius = self.low[n], self.high[n], self.radius[n]
        apart = np.abs(self.centre - self.centre[n])
        smaller = ~self.journal & (self.radius < radius - tolerance) & (apart > 10 * tolerance) & (apart < radius)
        above, below = self.low - high, low - self.high
        near = np.maximum(above, below)
        on = smaller & (near <= _FILLET * self.radius)
        return any(
            near[p] <= tolerance or not flanks.between(*((high, self.low[p]) if above[p] > 0 else (self.high[p], low)))
            for p in np.flatnonzero(on)
        )


def _pins(chain: Sequence[Stretch], flanks: Flanks, tolerance: float) -> Iterator[Stretch]:
    """Neighbours about one line beside the axis are one pin, with grooves and collars, unless a web is between them."""
    before: Stretch | None = None
    for stretch in chain:
        if before is not None and _same_pin(before, stretch, flanks, tolerance):
            before = replace(
                before,
                radius=min(before.radius, stretch.radius),
                low=min(before.low, stretch.low),
                high=max(before.high, stretch.high),
                faces=(*before.faces, *stretch.faces),
            )
            continue
        if before is not None:
            yield before
        before = stretch
    if before is not None:
        yield before


def _same_pin(first: Stretch, second: Stretch, flanks: Flanks, tolerance: float) -> bool:
    if first.journal or second.journal or abs(first.centre - second.centre) > 10 * tolerance:
        return False
    gap = second.low - first.high
    if gap <= tolerance:
        return True
    caps = flanks.cap(first.centre, first.radius, first.high, 1) and flanks.cap(
        second.centre, second.radius, second.low, -1
    )
    return gap <= first.radius and not caps and not flanks.between(first.high, second.low)
