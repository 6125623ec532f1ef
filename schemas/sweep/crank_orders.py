"""Orders of the crank angles along a shaft, and which of them are the same machine.

A machine is the same when all cranks are turned by one angle: only the moment changes at which it is looked at. It is
the same in a mirror along the shaft, where its rows are those of the image and it turns the other way. It is the same
seen from its other end.
"""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import factorial, prod
from typing import Any, NamedTuple

from schemas.machine.choices import own_options
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import balance_shafts
from schemas.machine.throws import Row, row_cylinders

#: angles and planes so near are one
_NEAR = 1e-9
#: different sequences of angles that are looked through
MAX_SEQUENCES = 4_000_000
MAX_ANGLES = 16


class Symmetry(NamedTuple):
    """What leaves a machine the same."""

    image: tuple[int, ...]  # of every different angle, by its number
    reversed: bool  # whether the throws change ends


@dataclass(frozen=True)
class CrankOrders:
    """Different angles, how often each is there, and what leaves a machine the same."""

    angles_deg: tuple[float, ...]
    times: tuple[int, ...]
    symmetries: tuple[Symmetry, ...]

    @property
    def sequences(self) -> int:
        """Number of different sequences."""
        return factorial(sum(self.times)) // prod(map(factorial, self.times))

    @property
    def sequence_count(self) -> int:
        """Number of sequences among which there is one of each order: the first angle may be fixed if all are alike."""
        return self.sequences * self.times[0] // sum(self.times) if self.alike else self.sequences

    @property
    def alike(self) -> bool:
        """Whether every angle can take the place of every other."""
        return len({symmetry.image[0] for symmetry in self.symmetries if not symmetry.reversed}) == len(self.times)

    @property
    def count(self) -> int:
        """Number of orders that are different machines (Burnside's lemma)."""
        return sum(self._unmoved(symmetry) for symmetry in self.symmetries) // len(self.symmetries)

    def _unmoved(self, symmetry: Symmetry) -> int:
        """Sequences that a symmetry leaves as they are."""
        image, times = symmetry.image, self.times
        if not symmetry.reversed:
            return self.sequences if all(image[a] == a for a in range(len(times))) else 0
        if any(image[image[a]] != a for a in range(len(times))):
            return 0
        # the throws in pairs from the ends inwards: an angle with its image, so one that is its own image twice
        own = [count for a, count in enumerate(times) if image[a] == a]
        swapped = [count for a, count in enumerate(times) if image[a] > a]
        if sum(count % 2 for count in own) != sum(times) % 2:
            return 0
        pairs = factorial(sum(times) // 2)
        alike = prod(factorial(count // 2) for count in own) * prod(map(factorial, swapped))
        return pairs // alike * 2 ** sum(swapped)


def crank_orders(
    machine: Machine,
    angles_deg: Sequence[float],
    alike_across: bool = True,
    fitted: bool = False,
    distinct: bool = False,
) -> CrankOrders:
    """The orders of angles on the throws of a machine.

    Parameters
    ----------
    alike_across : whether all directions across the shaft count alike.
    fitted : whether the request has counterweights, which stand at angles and on webs of their own.
    distinct : whether every sequence is a machine of its own, as scenarios change parts of some throws.
    """
    reduced = [angle % 360.0 for angle in angles_deg]
    different: list[float] = []
    for angle in reduced:
        if _number(different, angle) is None:
            different.append(angle)
    different.sort()
    counts = Counter(_number(different, angle) for angle in reduced)
    times = tuple(counts[k] for k in range(len(different)))
    if distinct:
        return CrankOrders(tuple(different), times, (Symmetry(tuple(range(len(different))), False),))
    symmetries = {
        Symmetry(image, ends): None
        for image in _images(machine, different, times, alike_across, fitted)
        for ends in ((False, True) if not fitted and _same_from_either_end(machine) else (False,))
    }
    return CrankOrders(tuple(different), times, tuple(symmetries))


def _images(
    machine: Machine, angles: Sequence[float], times: Sequence[int], alike_across: bool, fitted: bool
) -> Iterator[tuple[int, ...]]:
    """Images of the angles that the machine allows and that leave every angle as often as it was."""
    yield tuple(range(len(angles)))
    if fitted or not _turns_freely(machine):
        return
    for sign in (1.0, -1.0) if _same_in_a_mirror(machine, alike_across) else (1.0,):
        for angle in angles:
            numbers = [_number(angles, (sign * (crank - angles[0]) + angle) % 360.0) for crank in angles]
            image = tuple(k for k in numbers if k is not None)
            if len(image) == len(angles) and all(times[k] == times[a] for a, k in enumerate(image)):
                yield image


def _number(angles: Sequence[float], angle: float) -> int | None:
    return next((k for k, entry in enumerate(angles) if _off(entry - angle, 360.0) <= _NEAR * 360.0), None)


def _off(difference: float, period: float) -> float:
    return abs((difference + period / 2) % period - period / 2)


def _turns_freely(machine: Machine) -> bool:
    """Whether nothing on the machine stands at an angle of its own."""
    rows = [row for throw in machine.throws for row in throw.rows]
    tabled = any(cylinder.pressure is not None for row in rows for _, cylinder in row_cylinders(row))
    own = [own_options(web) for web in machine.webs]
    webs = (*machine.webs, *(web for shaft in balance_shafts(machine) for web in shaft.webs))
    free = all(web.sector is None and web.fixed is None for web in webs)
    free = free and all(options.angles is None and options.pairs is None for options in own)
    return not tabled and not machine.unbalances and free


def _same_in_a_mirror(machine: Machine, alike_across: bool) -> bool:
    """Whether there is a line along which every throw's rows are their own mirror image; gas knows its direction."""
    throws = machine.throws
    if balance_shafts(machine):
        # they stand beside the crankshaft and turn the other way in a mirror
        return False
    if any(row.cylinder is not None or row.cylinders for throw in throws for row in throw.rows):
        return False
    axes = [row.axis_deg for throw in throws[:1] for row in throw.rows] or [0.0]
    lines = {(axis + partner) / 2 for axis in axes for partner in axes}
    if not alike_across:
        lines = {line for line in lines if _off(line, 90.0) <= _NEAR}
    return any(all(_mirrored(throw.rows, line) for throw in throws) for line in lines)


def _mirrored(rows: Sequence[Row], line_deg: float) -> bool:
    left = list(rows)
    for row in rows:
        axis = 2 * line_deg - row.axis_deg
        twin = next(
            (
                candidate
                for candidate in left
                if _off(candidate.axis_deg - axis, 360.0) <= _NEAR and _alike(candidate, row)
            ),
            None,
        )
        if twin is None:
            return False
        left.remove(twin)
    return True


def _alike(first: Row, second: Row) -> bool:
    fields = (name for name in type(first).model_fields if name not in ("name", "axis_deg"))
    return all(getattr(first, name) == getattr(second, name) for name in fields)


def _same_from_either_end(machine: Machine) -> bool:
    """Whether throws, webs and bearings are the same from both ends, about the plane of moments if there is one."""
    throws = machine.throws
    ends = throws[0].position_m + throws[-1].position_m
    size = max(abs(throw.position_m) for throw in throws)
    plane = machine.reference_plane_m
    if machine.unbalances or any(web.fixed is not None for web in machine.webs):
        return False
    if machine.web_groups or balance_shafts(machine):
        # the groups, and what is on other shafts, would have to change ends too
        return False
    if plane is not None and abs(2 * plane - ends) > _NEAR * max(size, abs(plane)):
        return False
    sides = [[_from_an_end(throw, ends, reverse) for throw in throws] for reverse in (False, True)]
    places = [*machine.webs, *machine.bearings]
    last = len(throws) - 1 if machine.discrete else None
    opposite = [_from_an_end(place, ends, True, last) for place in places]
    there = [_from_an_end(place, ends, False, last) for place in places]
    return _equal(sides[0], sides[1][::-1], size) and _equal(there, opposite, size, anywhere=True)


def _from_an_end(part: Any, ends: float, reverse: bool, last: int | None = None) -> dict[str, Any]:
    """What a throw, a web or a bearing is, without its name and crank angle, with its distance from an end.

    Parameters
    ----------
    last : number of the last throw, where it matters whose crank a web belongs to: steps of angle count from it.
    """
    fields: dict[str, Any] = part.model_dump(exclude={"name", "crank_angle_deg", "throw"})
    fields["position_m"] = ends - part.position_m if reverse else part.position_m
    own = getattr(part, "throw", None)
    if last is not None and own is not None:
        fields["throw"] = last - own if reverse else own
    for row in fields.get("rows", ()):
        row["name"] = None
        row["offset_m"] = -row["offset_m"] if reverse else row["offset_m"]
    return fields


def _equal(
    first: Sequence[dict[str, Any]], second: Sequence[dict[str, Any]], size: float, anywhere: bool = False
) -> bool:
    left = list(second)
    for part in first:
        twins = left if anywhere else left[:1]
        twin = next((candidate for candidate in twins if _same(part, candidate, size)), None)
        if twin is None:
            return False
        left.remove(twin)
    return True


def _same(first: dict[str, Any], second: dict[str, Any], size: float) -> bool:
    near = abs(first["position_m"] - second["position_m"]) <= _NEAR * size
    return (
        near
        and first.keys() == second.keys()
        and all(first[key] == second[key] for key in first if key != "position_m")
    )
