"""What faces and bodies show, as the answer states it."""

from collections.abc import Iterator, Sequence
from itertools import groupby

import numpy as np

from optimizer.mechanics.crankshaft.doubts import doubt
from optimizer.mechanics.crankshaft.faces import Frame
from optimizer.mechanics.crankshaft.plates import Plate, Plates
from optimizer.mechanics.crankshaft.rotor import RotorMoments, density_doubts
from optimizer.mechanics.crankshaft.stretches import Stretch
from optimizer.numerics.arrays import Real
from optimizer.numerics.records import record
from schemas.answer.shaft import (
    Doubt,
    PlaneUnbalance,
    Rotor,
    ShaftAnswer,
    ShaftAxis,
    ShaftBearing,
    ShaftEnvelope,
    ShaftFrameOut,
    ShaftJournal,
    ShaftPin,
    ShaftPlate,
    ShaftThrow,
    ShaftWeb,
)
from schemas.request.shaft import ShaftRequest

#: crank radii of machines, m
_SMALLEST, _LARGEST = 0.002, 2.0
#: of the pin's radius, below which a crank radius is that of an eccentric, or of a journal that is off the axis
_ECCENTRIC = 0.1
#: of the longest journal of a stretch, above which another one may be the bearing as well
_AS_LONG = 0.7


@record(frozen=True)
class Shaft:
    """What the faces show in the frame of the shaft; its ends along the axis, None without faces."""

    frame: Frame
    plates: Plates
    doubts: tuple[Doubt, ...]
    ends: tuple[float, float] | None


def report(request: ShaftRequest, shaft: Shaft, rotor: RotorMoments | None) -> ShaftAnswer:
    """The answer to a request."""
    origin, (x, y, z) = shaft.frame.origin, shaft.frame.across
    chain = shaft.plates.chain
    pins = [n for n, entry in enumerate(chain) if not entry.journal]
    webs = list(_webs(shaft.plates.plates, pins))
    bearings = dict(_bearings(chain))
    names = {n: _letters(k) for k, n in enumerate(bearings)}
    return ShaftAnswer(
        axis=ShaftAxis(point_m=_triple(origin - z * (origin @ z)), direction=_triple(z)),
        frame=ShaftFrameOut(origin_m=_triple(origin), x=_triple(x), y=_triple(y), z=_triple(z)),
        throws=tuple(_throw(k, chain[n]) for k, n in enumerate(pins)),
        webs=tuple(web for web, _ in webs if web is not None),
        bearings=tuple(_bearing(name, chain[n]) for n, name in names.items()),
        unbalances=() if rotor is None else tuple(_unbalances(rotor, request.planes_m or shaft.ends)),
        pins=tuple(_pin(k, chain[n]) for k, n in enumerate(pins)),
        journals=tuple(_journal(entry, names.get(n)) for n, entry in enumerate(chain) if entry.journal),
        plates=tuple(plate for _, plate in webs),
        rotor=None if rotor is None else _rotor(rotor),
        doubts=(
            *shaft.doubts,
            *shaft.plates.doubts,
            *(entry for bearing in bearings.values() for entry in bearing),
            *_sizes([chain[n] for n in pins]),
            *density_doubts(request.bodies),
        ),
    )


def _throw(k: int, pin: Stretch) -> ShaftThrow:
    return ShaftThrow(
        name=str(k + 1),
        position_m=pin.middle,
        crank_radius_m=abs(pin.centre),
        crank_angle_deg=float(np.rad2deg(np.angle(pin.centre))),
    )


def _pin(k: int, pin: Stretch) -> ShaftPin:
    return ShaftPin(throw=k, diameter_m=2 * pin.radius, from_m=pin.low, to_m=pin.high, faces=pin.faces)


def _webs(plates: Sequence[Plate], pins: Sequence[int]) -> Iterator[tuple[ShaftWeb | None, ShaftPlate]]:
    """Every web, without one where no plate fits beside it; named by their throws, a to z along the shaft."""
    count: dict[int, int] = {}
    for plate in plates:
        throw = pins.index(plate.pins[0])
        letter = count[throw] = count.get(throw, -1) + 1
        name = f"{throw + 1}{_letters(letter).lower()}"
        thickness = plate.high - plate.low
        web = None
        if plate.room and plate.hub is not None and plate.reach is not None:
            envelope = ShaftEnvelope(inner_radius_m=plate.hub, outer_radius_m=plate.reach, thickness_m=thickness)
            web = ShaftWeb(name=name, position_m=(plate.low + plate.high) / 2, throw=throw, envelope=envelope)
        yield (
            web,
            ShaftPlate(
                web=None if web is None else name,
                thickness_m=thickness,
                hub_m=plate.hub,
                reach_m=plate.reach,
                from_m=plate.low,
                to_m=plate.high,
                faces=plate.faces,
            ),
        )


def _bearings(chain: Sequence[Stretch]) -> Iterator[tuple[int, list[Doubt]]]:
    """The longest journal of every stretch without a pin, by its place in the chain; and others that are as long."""
    for journal, group in groupby(range(len(chain)), key=lambda n: chain[n].journal):
        stretch = [n for n in group if chain[n].length > 0]
        if journal and stretch:
            best = max(stretch, key=lambda n: chain[n].length)
            rivals = [n for n in stretch if n != best and chain[n].length > _AS_LONG * chain[best].length]
            message = "nearly as long as the longest journal beside it, which is taken for the bearing"
            yield best, [doubt("bearing", chain[n].faces[0], message) for n in rivals]


def _bearing(name: str, journal: Stretch) -> ShaftBearing:
    return ShaftBearing(name=name, position_m=journal.middle, diameter_m=2 * journal.radius, length_m=journal.length)


def _journal(stretch: Stretch, bearing: str | None) -> ShaftJournal:
    return ShaftJournal(
        diameter_m=2 * stretch.radius, bearing=bearing, from_m=stretch.low, to_m=stretch.high, faces=stretch.faces
    )


def _letters(number: int) -> str:
    """A to Z, then AA."""
    name = ""
    number += 1
    while number:
        number, rest = divmod(number - 1, 26)
        name = chr(ord("A") + rest) + name
    return name


def _unbalances(rotor: RotorMoments, planes: tuple[float, float] | None) -> Iterator[PlaneUnbalance]:
    # a rule of the request asks for planes where no faces are listed
    assert planes is not None
    for k, (plane, value) in enumerate(zip(planes, rotor.in_planes(planes), strict=True), start=1):
        yield PlaneUnbalance(
            name=f"shaft, plane {k}", position_m=plane, x_kg_m=float(value.real), y_kg_m=float(value.imag)
        )


def _rotor(rotor: RotorMoments) -> Rotor:
    return Rotor(
        mass_kg=rotor.mass,
        centre_m=_triple(rotor.first / rotor.mass),
        unbalance_kg_m=float(np.hypot(rotor.first[0], rotor.first[1])),
    )


def _sizes(pins: Sequence[Stretch]) -> Iterator[Doubt]:
    """Cranks as no machine has them."""
    for pin in pins:
        radius = abs(pin.centre)
        if not _SMALLEST <= radius <= _LARGEST:
            message = f"a crank radius of {radius:.4g} m: are lengths in metres, or do they say their unit?"
            yield doubt("size", pin.faces[0], message, serious=True)
        elif radius < _ECCENTRIC * pin.radius:
            message = f"{radius * 1e3:.4g} mm off the axis: an eccentric, or a journal that is not on the axis"
            yield doubt("eccentric", pin.faces[0], message)


def _triple(values: Real) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in values)
    return x, y, z
