"""The largest load of pins with clearance over a revolution, enclosed for every angle: in doubles.

In the middle of an interval the scroll turns by p and shifts by t, so that loads q = k (|d| - c) of strains
d = a p + t - e beyond clearances c hold torque and balance. A trial motion goes on from there at steady rates. What its
loads miss of torque and balance is of the second order in the width. It is as if some of the pins carried that rest as
they carry a torque and a force: with D_i^2 / k_i = E^2 in sum the strain energy is no more than E^2 / 2 above its least
value, and 2 c_i |D_i| more of a pin that may cease to bear. That bounds all loads (Fenchel and Young):

    |Q_i - q_i| <= |D_i| + sqrt(2 k_i gap),    |Q_i| <= gap / (c_i - |d_i|) where |d_i| < c_i.

Any motion proves something, so how it was found need not be believed. Intervals that may hold more are split.
"""

from __future__ import annotations

from cmath import rect
from math import copysign, hypot, inf, radians, sqrt
from typing import Callable, List, NamedTuple, Sequence, Tuple

from verify_harmonics import Peak
from verify_pins import Pins, Torque

#: share of the largest load by which a bound may exceed the largest value; parts of an interval that does; pins times
#: intervals after which bounds stay as they are
CLOSE, PARTS, MOST = 5e-10, 4, 30_000
#: degrees of an interval at first
FIRST = 3.0
#: what rounding may add to a sum of a few terms
ROUNDED = 64 * 2.0**-52
#: steps of a search for a motion
_STEPS = 60
#: levers whose squares differ by less than this share of the largest hold no torque
_ALIKE = 1e-20


class _Pin(NamedTuple):
    """Its place over the farthest one, its stiffness over the largest; clearance and error in m."""

    place: complex
    stiffness: float
    clearance: float
    error: float

    def beyond(self, strain: float) -> float:
        """What a strain is beyond the clearance, with its sign."""
        over = abs(strain) - self.clearance
        return copysign(over, strain) if over > 0 else 0.0


class _Motion(NamedTuple):
    """Of the scroll: a turn times the distance of the farthest pin, and a shift [m]."""

    turn: float
    shift: float


class _Trial(NamedTuple):
    """What a motion makes of one pin over an interval, over the largest stiffness."""

    load: float  # in the middle
    largest: float
    rise: float  # of the load with the angle
    deviation: float  # from what is linear
    margin: float  # it bears at least so much throughout
    slack: float  # so much of its clearance is left throughout


class Play:
    """Pins with clearance, what acts on them, and their loads."""

    def __init__(self, pins: Pins, torque: Torque) -> None:
        self.torque, self.is_rigid = torque, pins.is_rigid
        size, springs = max(pins.radii), list(pins.stiffness)
        has_spring = 0 < pins.drive < inf
        self.stiffest = max([*springs, *([pins.drive] if has_spring else [])])
        parts = zip(pins.places, springs, pins.clearances, pins.errors)
        self.pins = [_Pin(place / size, k / self.stiffest, clearance, error) for place, k, clearance, error in parts]
        self.pins += [_Pin(0j, pins.drive / self.stiffest, 0.0, 0.0)] if has_spring else []
        #: a torque over place and stiffness is a length
        self.unit = size * self.stiffest
        self.carriers = len(self.pins) + self.is_rigid
        self._last = _Motion(0.0, 0.0)

    def loads(self, angle: float) -> List[float]:
        """Of all that carries at an angle [degrees], N."""
        motion = self._motion(self._levers(angle), self.torque.at(angle) / self.unit)
        loads = [self.stiffest * q for q in self._laws(self._levers(angle), motion)]
        return [*loads, *([-sum(loads)] if self.is_rigid else [])]

    def peaks(self) -> List[Peak]:
        """Of all that carries; wide where they are not enclosed."""
        count = round(360 / FIRST)
        edges = sorted({*(FIRST * n for n in range(count + 1)), *self.torque.angles})
        left, size, places = list(zip(edges, edges[1:])), [0.0] * self.carriers, [0.0] * self.carriers
        high, spent = [0.0] * self.carriers, 0
        while left:
            spent += self.carriers * len(left)
            bounds = []
            for start, end in left:
                loads, above = self._enclosure(start, end)
                bounds.append(above)
                for k, load in enumerate(loads):
                    if abs(load) > size[k]:
                        size[k], places[k] = abs(load), (start + end) / 2
            close = [value + CLOSE * max(size) for value in size]
            opened = [any(value > most for value, most in zip(above, close)) for above in bounds]
            is_last = spent + PARTS * self.carriers * sum(opened) > MOST
            for above, is_open in zip(bounds, opened):
                if is_last or not is_open:
                    high = [max(pair) for pair in zip(high, above)]
            if is_last:
                break
            left = [part for piece, is_open in zip(left, opened) if is_open for part in _parts(*piece)]
        return [Peak(low, max(low, most), angle) for low, most, angle in zip(size, high, places)]

    def _levers(self, angle: float) -> List[float]:
        return [(rect(1.0, radians(angle)) * pin.place.conjugate()).imag for pin in self.pins]

    def _laws(self, levers: Sequence[float], motion: _Motion) -> List[float]:
        strains = (lever * motion.turn + motion.shift - pin.error for lever, pin in zip(levers, self.pins))
        return [pin.stiffness * pin.beyond(strain) for pin, strain in zip(self.pins, strains)]

    def _motion(self, levers: Sequence[float], torque: float) -> _Motion:
        """That of least energy, by Newton's method from the last one: exact once the pins that bear are the right
        ones."""
        turn, shift = self._last
        for _ in range(_STEPS):
            strains = [lever * turn + shift - pin.error for lever, pin in zip(levers, self.pins)]
            forces = [pin.stiffness * pin.beyond(strain) for pin, strain in zip(self.pins, strains)]
            moment = sum(force * lever for force, lever in zip(forces, levers)) - torque
            net = 0.0 if self.is_rigid else sum(forces)
            scale = abs(torque) + sum(map(abs, forces)) + max(abs(strain) for strain in strains)
            if max(abs(moment), abs(net)) <= 2.0**-52 * scale:
                break
            bears = [pin.stiffness if abs(d) > pin.clearance else 0.0 for pin, d in zip(self.pins, strains)]
            steady = 2.0**-50 * sum(pin.stiffness for pin in self.pins)
            tt = sum(k * lever**2 for k, lever in zip(bears, levers)) + steady
            ts = 0.0 if self.is_rigid else sum(k * lever for k, lever in zip(bears, levers))
            ss = sum(bears) + steady
            step = ts * net - ss * moment, ts * moment - tt * net
            if self.is_rigid:
                step = -moment, 0.0
            elif step[0] * moment + step[1] * net >= 0 or tt * ss <= ts**2:
                step = -moment, -net
            longest = max(map(abs, step)) or 1.0
            by_turn, by_shift = step[0] / longest, step[1] / longest
            changes = [lever * by_turn + by_shift for lever in levers]
            along = self._line(strains, changes, torque * by_turn)
            if along == 0:
                break
            turn, shift = turn + along * by_turn, shift + along * by_shift
        self._last = _Motion(turn, shift)
        return self._last

    def _line(self, strains: Sequence[float], changes: Sequence[float], work: float) -> float:
        """How far along a direction the energy is least: where its slope, linear between kinks, is 0."""

        def slope(along: float) -> float:
            return sum(p.stiffness * p.beyond(d + along * c) * c for p, d, c in zip(self.pins, strains, changes)) - work

        kinks = sorted(
            kink
            for pin, strain, change in zip(self.pins, strains, changes)
            if change != 0
            for kink in ((pin.clearance - strain) / change, (-pin.clearance - strain) / change)
            if kink > 0
        )
        return _root(slope, kinks)

    def _enclosure(self, start: float, end: float) -> Tuple[List[float], List[float]]:
        """Loads in the middle of an interval over which the torque is linear, and bounds over all of it, N."""
        middle, half = (start + end) / 2, radians((end - start) / 2) + 2 * radians(360.0) * 2.0**-52
        levers, swings = self._levers(middle), self._levers(middle + 90.0)
        values = self.torque.at(start), self.torque.at(end)
        torque = (values[0] + values[1]) / 2 / self.unit
        slope = (values[1] - values[0]) / radians(end - start) / self.unit
        motion = self._motion(levers, torque)
        trials, moment, net = self._trials(levers, swings, motion, torque, slope, half)
        bearing = [trial.margin > 0 for trial in trials]
        errors = [
            min(pair)
            for pair in zip(
                self._errors(levers, trials, half, moment, net, bearing),
                self._errors(levers, trials, half, moment, net, [True] * len(trials)),
            )
        ]
        loads = [self.stiffest * trial.load for trial in trials]
        above = [trial.largest + error for trial, error in zip(trials, errors)]
        if self.is_rigid:
            rest = abs(sum(trial.load for trial in trials)) + half * abs(sum(trial.rise for trial in trials))
            above.append(rest + sum(trial.deviation + error for trial, error in zip(trials, errors)))
            loads.append(-sum(loads))
        return loads, [self.stiffest * (1 + ROUNDED) * value for value in above]

    def _rates(
        self, levers: Sequence[float], swings: Sequence[float], motion: _Motion, slope: float
    ) -> Tuple[float, float]:
        """Of turn and shift with the angle, at which the pins that bear keep torque and balance."""
        loads, strains = self._laws(levers, motion), [a * motion.turn + motion.shift for a in levers]
        bears = [
            pin.stiffness if abs(strain - pin.error) > pin.clearance else 0.0 for pin, strain in zip(self.pins, strains)
        ]
        whole = sum(bears) or 1.0
        mean = 0.0 if self.is_rigid else sum(k * a for k, a in zip(bears, levers)) / whole
        square = sum(k * (a - mean) ** 2 for k, a in zip(bears, levers))
        moment = slope - sum(q * s for q, s in zip(loads, swings))
        moment -= sum(k * s * (a - mean) for k, s, a in zip(bears, swings, levers)) * motion.turn
        turn = moment / square if square > _ALIKE * whole else 0.0
        swung = 0.0 if self.is_rigid else sum(k * s for k, s in zip(bears, swings))
        return turn, -swung * motion.turn / whole - mean * turn

    def _trials(
        self,
        levers: Sequence[float],
        swings: Sequence[float],
        motion: _Motion,
        torque: float,
        slope: float,
        half: float,
    ) -> Tuple[List[_Trial], float, float]:
        """Of every pin, and what their loads leave of torque and balance at most."""
        turn, shift = self._rates(levers, swings, motion, slope)
        trials, carried, reaches = [], [], [abs(pin.place) for pin in self.pins]
        for pin, lever, swing, reach in zip(self.pins, levers, swings, reaches):
            strain = lever * motion.turn + motion.shift - pin.error
            rate = swing * motion.turn + lever * turn + shift
            # of the second order: what lever and turn change together, and how the lever curves
            curved = abs(swing * turn) + reach * (abs(motion.turn) + abs(turn) * half) / 2
            size = abs(lever * motion.turn) + abs(motion.shift) + abs(pin.error) + pin.clearance
            rest = half**2 * curved + ROUNDED * size
            k, over, bears = pin.stiffness, abs(strain) - pin.clearance, abs(strain) > pin.clearance
            swerve, load = half * abs(rate) + rest, k * pin.beyond(strain)
            rise = k * rate if bears else 0.0
            # of a pin that bears, what it lacks where it ceases to; of another, all that it may bear
            kink = k * max(swerve - over if bears else swerve + over, 0.0)
            deviation = kink + (k * rest if bears else 0.0)
            ends = max(abs(strain + half * rate), abs(strain - half * rate))
            largest, margin = k * max(ends + rest - pin.clearance, 0.0), max(k * (over - swerve), 0.0)
            trials.append(_Trial(load, largest, rise, deviation, margin, -(over + swerve)))
            carried.append(2 * abs(load) + half * abs(rise) + deviation)
        moment = abs(torque - sum(trial.load * a for trial, a in zip(trials, levers)))
        moment += half * abs(slope - sum(t.load * s + t.rise * a for t, a, s in zip(trials, levers, swings)))
        for trial, lever, swing, reach, size in zip(trials, levers, swings, reaches, carried):
            moment += half**2 * (abs(trial.rise * swing) + reach * (abs(trial.load) + half * abs(trial.rise)) / 2)
            moment += trial.deviation * (abs(lever) + half * reach) + ROUNDED * size * reach
        moment += ROUNDED * (abs(torque) + half * abs(slope))
        if self.is_rigid:
            return trials, moment, 0.0
        net = abs(sum(trial.load for trial in trials)) + half * abs(sum(trial.rise for trial in trials))
        return trials, moment, net + sum(t.deviation + ROUNDED * size for t, size in zip(trials, carried))

    def _errors(
        self,
        levers: Sequence[float],
        trials: Sequence[_Trial],
        half: float,
        moment: float,
        net: float,
        members: Sequence[bool],
    ) -> List[float]:
        """How far loads may be from those of the trial, if some of the pins carry what is missing."""
        carriers = [pin.stiffness if carries else 0.0 for pin, carries in zip(self.pins, members)]
        whole = sum(carriers) or 1.0
        mean, centre = 0.0, 0j
        if not self.is_rigid:
            mean = sum(k * a for k, a in zip(carriers, levers)) / whole
            centre = sum(k * pin.place for k, pin in zip(carriers, self.pins)) / whole
        # it changes with the angle by no more than the size of the sum of k w^2
        square = sum(k * (a - mean) ** 2 for k, a in zip(carriers, levers))
        square -= half * abs(sum(k * (pin.place - centre) ** 2 for k, pin in zip(carriers, self.pins)))
        if square <= _ALIKE * whole:
            return [inf] * len(trials)
        energy = hypot((moment + (abs(mean) + half * abs(centre)) * net) / sqrt(square), net / sqrt(whole))
        shares = [sqrt(k) * energy for k in carriers]
        # pins that may change their side
        pairs = zip(self.pins, shares, trials)
        turns = sum(pin.clearance * share for pin, share, trial in pairs if share > trial.margin)
        gap, errors = energy**2 / 2 + 2 * turns, []
        for pin, share, trial in zip(self.pins, shares, trials):
            error = share + sqrt(pin.stiffness) * hypot(energy, 2 * sqrt(turns))
            errors.append(min(error, gap / trial.slack) if trial.slack > 0 else error)
        return errors


def _parts(start: float, end: float) -> List[Tuple[float, float]]:
    edges = [start + (end - start) * n / PARTS for n in range(PARTS)]
    return list(zip(edges, [*edges[1:], end]))


def _root(slope: Callable[[float], float], kinks: Sequence[float]) -> float:
    """Where a slope that rises, and is linear between kinks, is 0."""
    low, high = -1, len(kinks)
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if slope(kinks[middle]) < 0 else (low, middle)
    start = 0.0 if low < 0 else kinks[low]
    end = kinks[high] if high < len(kinks) else 2 * start + 1.0
    first, last = slope(start), slope(end)
    if last <= first:
        return start
    along = start - first * (end - start) / (last - first)
    return along if high == len(kinks) else min(max(along, start), end)
