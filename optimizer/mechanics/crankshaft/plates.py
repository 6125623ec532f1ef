"""The material of webs: plane flanks between neighbours of which one is a crank pin, and what is free beside them."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from optimizer.mechanics.crankshaft.doubts import doubt
from optimizer.mechanics.crankshaft.faces import Cylinders, Planes
from optimizer.mechanics.crankshaft.flanks import Flanks
from optimizer.mechanics.crankshaft.outline import outline
from optimizer.mechanics.crankshaft.stretches import Stretch
from optimizer.numerics.arrays import Real
from optimizer.numerics.records import record
from schemas.answer.shaft import Doubt

#: share of the reach, above which a hub leaves no room for a plate
_NO_ROOM = 0.98


@record(frozen=True)
class Sides:
    """What may bound a web, in the frame of the shaft."""

    cylinders: Cylinders
    planes: Planes
    points_beside: Real


@record(frozen=True)
class Plate:
    """A web: its flanks along the shaft, the pins beside it by their place in the chain, how far it reaches."""

    low: float
    high: float
    pins: tuple[int, ...]
    hub: float | None
    reach: float | None
    faces: tuple[int, ...]

    @property
    def room(self) -> bool:
        """Whether a plate fits opposite the crank."""
        return self.hub is not None and self.reach is not None and self.hub < _NO_ROOM * self.reach


@record(frozen=True)
class Plates:
    """Webs in their order, and the chain with what of journals and pins sticks in webs taken off."""

    plates: tuple[Plate, ...]
    chain: tuple[Stretch, ...]
    doubts: tuple[Doubt, ...]


def plates(chain: Sequence[Stretch], flanks: Flanks, sides: Sides, tolerance: float) -> Plates:
    """The webs between neighbours of a chain."""
    free, webs, doubts = list(chain), [], []
    for n in range(len(chain) - 1):
        stretch, neighbour = chain[n : n + 2]
        pins = tuple(k for k in (n, n + 1) if not chain[k].journal)
        material = _material(stretch, neighbour, flanks) if pins else flanks.between(stretch.high, neighbour.low)
        air = _air(stretch, neighbour, material, flanks, tolerance)
        if air is not None:
            message = f"{air * 1e3:.4g} mm of air between it and what follows along the shaft: not one shaft there"
            doubts.append(doubt("air", stretch.faces[-1], message, serious=True))
        elif not pins:
            continue
        elif material is not None:
            low, high = material
            free[n] = replace(free[n], high=min(free[n].high, max(low, free[n].low)))
            free[n + 1] = replace(free[n + 1], low=max(free[n + 1].low, min(high, free[n + 1].high)))
            plate = _plate(chain, pins, low, high, sides, flanks, tolerance)
            webs.append(plate)
            doubts += _doubts_about(plate, stretch)
        else:
            doubts += _without_flanks(stretch, neighbour, flanks, tolerance)
    return Plates(tuple(webs), tuple(free), tuple(doubts))


def _material(first: Stretch, second: Stretch, flanks: Flanks) -> tuple[float, float] | None:
    """Flanks between two neighbours: the largest ones, or, where areas are not listed, the outermost."""
    return flanks.largest(first.middle, second.middle) or flanks.between(first.high, second.low)


def _air(
    first: Stretch, second: Stretch, material: tuple[float, float] | None, flanks: Flanks, tolerance: float
) -> float | None:
    """How much air is between two neighbours, whose ends are closed towards it; None without any."""
    low, high = material or (second.low, first.high)
    closed = (
        flanks.cap(first.centre, first.radius, first.high, 1),
        flanks.cap(second.centre, second.radius, second.low, -1),
    )
    if material is None:
        gap = second.low - first.high
        return gap if gap > 10 * tolerance and all(closed) else None
    gaps = [gap for gap, end in ((low - first.high, closed[0]), (second.low - high, closed[1])) if end]
    worst = max(gaps, default=0.0)
    return worst if worst > 10 * tolerance else None


def _plate(
    chain: Sequence[Stretch],
    pins: tuple[int, ...],
    low: float,
    high: float,
    sides: Sides,
    flanks: Flanks,
    tolerance: float,
) -> Plate:
    bounds = outline(sides.cylinders, sides.planes, sides.points_beside, low, high, tolerance)
    faces = flanks.faces(low, high)
    if bounds is None:
        return Plate(low, high, pins, None, None, faces)
    crank = sum((chain[n].centre / abs(chain[n].centre) for n in pins), 0j)
    return Plate(low, high, pins, bounds.reach_opposite(crank if abs(crank) > 1e-6 else None), bounds.reach, faces)


def _doubts_about(plate: Plate, before: Stretch) -> Iterator[Doubt]:
    where = f"the web from {plate.low:.6g} to {plate.high:.6g} m along the shaft"
    if plate.reach is None:
        message = f"{where}: its side faces are not listed with their points, so that no envelope is known"
        yield doubt("outline", before.faces[-1], message)
    elif not plate.room:
        message = f"{where} reaches as far opposite its crank as beside it: no plate fits there"
        yield doubt("no_room", before.faces[-1], message)


def _without_flanks(first: Stretch, second: Stretch, flanks: Flanks, tolerance: float) -> Iterator[Doubt]:
    """Why there is no web between two neighbours; split pins need none."""
    gap, leaning = second.low - first.high, flanks.lean(first.middle, second.middle)
    if leaning is not None:
        number, angle = leaning
        message = f"a flank that leans by {angle:.3g} degrees: the web has no one thickness, and gets no envelope"
        yield doubt("tapered_web", number, message)
    elif gap > 10 * tolerance:
        where = f"in the {gap * 1e3:.4g} mm between it and what follows"
        message = f"no plane faces across the shaft {where}: nothing shows a web there"
        yield doubt("no_plane", first.faces[-1], message, serious=True)
