"""The front of two peaks: its ends, and points spread evenly between them, each with its proof.

The peaks are convex in the unbalance, so the points that nobody beats in both make a convex falling curve.
A line that rises in both peaks meets it once, where the larger of the two scaled excesses over the line's
anchor is smallest (normal-boundary intersection, Das and Dennis 1998): one program of optimizer.program,
whose lower bound t_low proves that no counterweights reach below the corner anchor + t_low unit in both.
"""

from dataclasses import replace

import numpy as np

from optimizer.numerics.arrays import SMALLEST, Complex, Real
from optimizer.numerics.records import record
from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.program.certificate import Multipliers, ceiling_allowance, normalised, nothing_proven
from optimizer.program.methods.implied_bounds import within_reach
from optimizer.program.methods.rounding import has_dust
from optimizer.program.solution import OPTIMUM_SHARE, ConeSolution, evaluated
from optimizer.program.statement import Statement
from optimizer.program.verdict import MASS_GAP
from optimizer.studies.pareto.trade import Trade

#: a smallest peak by itself is sought to this share of its size
_SHARPNESS = 1e-9
#: a front that is narrower than this share of the sizes is a single point
_NARROW = 1e-9
#: at an end the peak that counts first may exceed its smallest value by this share of the asked gap, without which
#: nothing could be proven about the other
_END_SLACK = 0.1
#: the same where counterweights scatter, or in several scenarios: a front is straight there, and where it ends with
#: none the other peak falls by many times what this one rises by
_BENT_SLACK = 0.02
#: the least mass at an end may give away this part of what it may elsewhere
_END_SHARE = 0.3
#: share of the range within which an end stays that is sought again
_NEAR_END = 1e-3
#: most lines that find an end
_END_STEPS = 24
#: share of the corner's last rise that is little gained by the next line, and by which lines are then steeper
_SLOW, _STEEPER = 0.5, 0.25
#: parts of the asked share of t, each tried where the least mass could not be certified with the one before
_ALLOWANCES = (1.0, 0.5, 0.2)
#: where webs have no limit, peaks are looked into up to so many times those at the ends
_ROOM = 2.0
#: most limits that are tried until what is found lies within
_REACHES = 4
#: intersections that show where the front bends before its points are spread
_SOUNDINGS = 16
#: share of the range to which they do
_SOUNDED = 1e-3


@record(frozen=True)
class FrontPoint:
    """Counterweights on the front; the figures are evaluated from ``solution.unbalance``."""

    solution: ConeSolution
    corner: Real  # (2,) proven: no counterweights are below this in both peaks
    proof: Multipliers  # of the corner, one row for each peak, of which the corner is what they weigh
    mass_proof: Multipliers | None  # of the mass likewise; None where the least mass was not asked for
    mass_limit: Real  # (2,) largest peaks that the bound of the mass allows

    def counting(self, trade: Trade, u: Complex) -> "FrontPoint":
        """Where the peaks of u (K,) are beyond those largest, nothing is proven of their mass: 0 kg."""
        peaks = trade.peaks(u)
        if self.mass_proof is None or np.all(peaks <= self.mass_limit + trade.rounding(u)):
            return self
        solution, limit = replace(self.solution, mass_lower_bound=0.0), np.maximum(self.mass_limit, peaks)
        return replace(self, solution=solution, mass_proof=nothing_proven(trade.minimax), mass_limit=limit)


@record(frozen=True)
class Front:
    """Points in the order of rising force; a single one where both smallest peaks are reached together."""

    points: tuple[FrontPoint, ...]
    ideal: Real  # (2,) proven: no counterweights have a smaller force, none a smaller moment
    size: Real  # (2,) what gaps are relative to (:func:`_size`)
    ideal_proofs: tuple[Multipliers, Multipliers]  # of the ideal's parts, each with one row
    trade: Trade  # within the limits that every proof counts with
    undecided: bool = False  # the ceilings are on the very boundary; the point comes closest to keeping them


class _Undecided(Exception):
    """Ceilings that were kept within their tolerance are out of reach by less than that."""


def front(trade: Trade, count: int, relative_gap: float, least_mass: bool) -> Front | ConeSolution:
    """The front of a trade.

    Parameters
    ----------
    count : number of points, at least 2.
    relative_gap : asked gap of every point, relative to the sizes.
    least_mass : take the least total mass at every point.

    Returns
    -------
    Front, or a solution with the proof that the ceilings cannot be kept.
    """
    smallest = _smallest(trade)
    if isinstance(smallest, ConeSolution):
        return smallest
    trade, alone = smallest
    ideal = np.array([_bound(program, result) for program, result in zip(trade.alone, alone, strict=True)])
    proofs = _of_ends(trade, alone)
    size = _size(trade, np.array([solution.unbalance for solution in alone]))
    try:
        if not all(solution.keeps_ceilings for solution in alone):
            raise _Undecided
        points = _between(trade, ideal, proofs, size, count, min(OPTIMUM_SHARE, relative_gap), least_mass)
    except _Undecided:
        points = (_closest(trade, alone, ideal, proofs, least_mass),)
        return Front(points, ideal, size, proofs, trade, undecided=True)
    return Front(points, ideal, size, proofs, trade)


def _smallest(trade: Trade) -> tuple[Trade, list[ConeSolution]] | ConeSolution:
    """What makes each peak smallest, and the trade within the reach in which all of its front is proven.

    A corner of one line is held against the points of all, so they are all to be within the same limits: those in which
    each peak is smallest, and those in which everything lies that is no worse than twice what is found there.
    """
    if not trade.far:
        return _alone(trade)
    force, moment = (within_reach(program).limits.max_mass for program in trade.alone)
    within = trade.within(np.maximum(force, moment), np.zeros(2))
    for _ in range(_REACHES):
        result = _alone(within)
        if isinstance(result, ConeSolution):
            return result
        u = np.array([solution.unbalance for solution in result[1]])
        peaks = np.max([*trade.peaks(u), _size(trade, u)], axis=0)
        if np.all(peaks <= within.cap):
            break
        within = trade.within(np.maximum(within.minimax.limits.max_mass, trade.reach(_ROOM * peaks)), _ROOM * peaks)
    return result


def _alone(trade: Trade) -> tuple[Trade, list[ConeSolution]] | ConeSolution:
    results: list[ConeSolution] = []
    for index in (0, 1):
        solution = trade.smallest(index, _SHARPNESS, True)
        if solution.conflict is not None:
            return solution
        results.append(solution)
    return trade, results


def _of_ends(trade: Trade, alone: list[ConeSolution]) -> tuple[Multipliers, Multipliers]:
    """Proofs of the smallest peaks, as of the program of both."""
    force, moment = alone
    usable = normalised(trade.alone[0], force.multipliers)[0], normalised(trade.alone[1], moment.multipliers)[0]
    return trade.widened(0, usable[0]), trade.widened(1, usable[1])


def _closest(
    trade: Trade, alone: list[ConeSolution], ideal: Real, proofs: tuple[Multipliers, Multipliers], least_mass: bool
) -> FrontPoint:
    """Of the counterweights that make a peak smallest those that come closest to keeping the ceilings."""
    index = min((0, 1), key=lambda peak: alone[peak].excess)
    result = alone[index]
    # its mass is the least of those that make this peak as small, whatever the other
    limit = np.where(np.arange(2) == index, result.mass_target, trade.peaks(result.unbalance))
    of_mass = None
    if least_mass and result.mass_multipliers is not None:
        of_mass = trade.widened(index, result.mass_multipliers.admissible(trade.alone[index]))
    return FrontPoint(result, ideal, proofs[index], of_mass, np.minimum(limit, trade.cap))


def _between(
    trade: Trade,
    ideal: Real,
    proofs: tuple[Multipliers, Multipliers],
    size: Real,
    count: int,
    share: float,
    least_mass: bool,
) -> tuple[FrontPoint, ...]:
    """The points of the front; a single one where both peaks are smallest together."""
    # half the asked gap for the programs, half for the distance of the point from the ideal
    together = replace(_meet(trade, ideal, size, least_mass, 0.25 * share), corner=ideal, proof=proofs[0])
    alike = np.all(trade.peaks(together.solution.unbalance) - ideal <= max(0.5 * share, _NARROW) * size)
    ends = [] if alike else [_end(trade, first, ideal, proofs, size, share) for first in (0, 1)]
    if alike or np.any(np.abs(ends[1].peaks - ends[0].peaks) <= _NARROW * size):
        return (together,)
    return _points(trade, (ends[0], ends[1]), size, count, share, least_mass)


@record(frozen=True)
class _End:
    """Where a peak is smallest and, among all such, the other is smallest."""

    peaks: Real  # (2,)
    corner: Real  # (2,)
    proof: Multipliers  # of the corner


def _size(trade: Trade, u: Complex) -> Real:
    """What gaps are relative to (2,): the peaks without counterweights.

    Where there is none, as in a machine that balances its forces itself: what the counterweights that make the
    other peak smallest do one by one. 1 where they do nothing either.

    Parameters
    ----------
    u : (2, K) kg m, the lightest counterweights that make each peak smallest.
    """
    gross = np.max(trade.gross(u), axis=0)
    size = np.where(trade.at_rest > OPTIMUM_SHARE * gross, trade.at_rest, gross)
    return np.where(size > SMALLEST, size, 1.0)


def _meet(trade: Trade, anchor: Real, unit: Real, least_mass: bool, share: float) -> FrontPoint:
    """The point of the front on the line anchor + t unit."""
    (point,) = _meets(trade, anchor[None], unit, least_mass, share)
    return point


def _meets(trade: Trade, anchors: Real, unit: Real, least_mass: bool, share: float) -> tuple[FrontPoint, ...]:
    """The points of the front on the lines from anchors (N, 2).

    Parameters
    ----------
    share : how much of t the answer may lie above the smallest.
    """
    first, *more = _ALLOWANCES if least_mass else _ALLOWANCES[:1]
    programs = trade.along(anchors, unit)
    points = []
    for n, best in enumerate(_reached(trade.met(programs, anchors, unit, first * share, least_mass))):
        program, anchor = programs.subset(n), anchors[n]
        for part in more:
            if _mass_gap(best) <= MASS_GAP:
                break
            again = trade.met(program.alone(), anchors[n : n + 1], unit, part * share, least_mass)
            best = min(best, *_reached(again), key=_mass_gap)
        usable, _ = normalised(program, best.multipliers)
        of_mass = best.mass_multipliers if least_mass else None
        points.append(
            FrontPoint(
                best,
                np.minimum(anchor + trade.parameter(_bound(program, best), anchor, unit) * unit, trade.cap),
                trade.per_peak(usable, unit),
                None if of_mass is None else trade.per_peak(of_mass.admissible(program), unit),
                np.minimum(anchor + trade.parameter(best.mass_target, anchor, unit) * unit, trade.cap),
            )
        )
    return tuple(points)


def _reached(optima: list[ConeSolution]) -> list[ConeSolution]:
    """Optima under ceilings that have been kept."""
    if any(optimum.conflict is not None for optimum in optima):
        raise _Undecided
    return optima


def _bound(statement: Statement, solution: ConeSolution) -> float:
    """What is proven of all that counts as keeping the ceilings: one bound is held against many points."""
    tolerance = np.full(statement.ceilings.cap.shape, CEILING_TOLERANCE)
    return solution.lower_bound - float(ceiling_allowance(statement, solution.multipliers, tolerance))


def _mass_gap(solution: ConeSolution) -> float:
    return (solution.mass - solution.mass_lower_bound) / solution.mass if solution.mass > 0 else 0.0


def _end(
    trade: Trade,
    first: int,
    ideal: Real,
    proofs: tuple[Multipliers, Multipliers],
    size: Real,
    share: float,
) -> _End:
    """The end of the front where peak ``first`` is smallest.

    The line starts a little above the smallest value of the first peak, at a value of the other that is proven to be
    too small, and is so steep that the first hardly rises; the corner that is proven there starts the next line.
    Where the front falls like a square root, the first peak still rises by the square of the slope, so that is the
    root of the asked gap; a steeper line costs digits. Where counterweights scatter, or in several scenarios, the first
    peak may rise by next to nothing along a straight front: there lines become steeper, as corners hardly move.
    """
    second = 1 - first
    slack, part = (_BENT_SLACK, _END_SHARE) if trade.bent else (_END_SLACK, 1.0)
    unit = size * np.where(np.arange(2) == first, np.sqrt(share), 1.0)
    anchor = ideal + size * np.where(np.arange(2) == first, slack * share, 0.0)
    # at the anchor it is the other peak alone that is too small
    peaks, corners, last = [], [(anchor, proofs[second])], np.inf
    for _ in range(_END_STEPS):
        point = _meet(trade, anchor, unit, False, part * share)
        peaks.append(trade.peaks(point.solution.unbalance))
        if point.corner[first] > ideal[first]:
            corners.append((point.corner, point.proof))
        rise = point.corner[second] - anchor[second]
        if rise <= share * size[second]:
            break
        anchor = np.where(np.arange(2) == second, point.corner, anchor)
        if trade.bent and rise > _SLOW * last:
            unit = unit * np.where(np.arange(2) == first, _STEEPER, 1.0)
        last = rise
    corner, proof = max(corners, key=lambda pair: float(pair[0][second]))
    # the end cannot be lower than this; the step that comes closest is it
    target = np.where(np.arange(2) == first, ideal, corner)
    return _End(min(peaks, key=lambda pair: float(np.max((pair - target) / size))), corner, proof)


def _points(
    trade: Trade,
    ends: tuple[_End, _End],
    size: Real,
    count: int,
    share: float,
    least_mass: bool,
) -> tuple[FrontPoint, ...]:
    """The ends, and points between them that are evenly apart in the plane of shares of the range."""
    start, step = ends[0].peaks, ends[1].peaks - ends[0].peaks
    span = np.abs(step)
    # the answer may lie above the front by a share of its range, where that is less than the sizes
    share *= min(1.0, float(np.min(size / span)))
    spread = _spread(trade, start, step, count, share)
    between = _meets(trade, start + spread[1:-1, None] * step, span, least_mass, share)
    first, last = (_at_end(trade, end, span, size, share, least_mass) for end in ends)
    return (first, *between, last)


def _at_end(trade: Trade, end: _End, span: Real, size: Real, share: float, least_mass: bool) -> FrontPoint:
    """The point at an end, whose gap is of the sizes: where a share of the range leaves dust, one of these may not."""
    limits = trade.minimax.limits

    def nearest(unit: Real) -> FrontPoint:
        result = _meet(trade, end.peaks, unit, least_mass, _END_SHARE * share)
        return replace(result, corner=end.corner, proof=end.proof)

    nothing = _without(trade, end, least_mass)
    if nothing is not None and np.all(trade.at_rest - end.corner <= share * size):
        return nothing
    point = nearest(span)
    if not has_dust(limits, point.solution.unbalance):
        return point
    rival = nearest(size)
    peaks = trade.peaks(rival.solution.unbalance)
    close = np.all(np.abs(peaks - end.peaks) <= _NEAR_END * span) and np.all(peaks - end.corner <= share * size)
    return rival if close and not has_dust(limits, rival.solution.unbalance) else point


def _without(trade: Trade, end: _End, least_mass: bool) -> FrontPoint | None:
    """No counterweights, where they scatter: of a few grams the least mass is the difference of peaks all but equal.

    None where they do not scatter, or where ceilings need some.
    """
    nothing = np.zeros(trade.minimax.limits.radius.shape, complex)
    solution = evaluated(trade.minimax, nothing)
    if not (trade.minimax.norms.scatter and solution.keeps_ceilings):
        return None
    of_mass = nothing_proven(trade.minimax) if least_mass else None
    return FrontPoint(solution, end.corner, end.proof, of_mass, trade.at_rest)


def _spread(trade: Trade, start: Real, step: Real, count: int, share: float) -> Real:
    """Shares of the chord (count,) whose points of the front are evenly apart."""
    # denser towards the ends, where a front may fall like a square root
    sounded = 0.5 * (1.0 - np.cos(np.linspace(0.0, np.pi, _SOUNDINGS + 1)))
    # depth of the front below the chord, in units of the range
    depth = np.zeros(sounded.size)
    anchors = start + sounded[1:-1, None] * step
    programs = trade.along(anchors, np.abs(step))
    lines = _reached(trade.met(programs, anchors, np.abs(step), max(share, _SOUNDED), False))
    u = np.array([line.unbalance for line in lines])
    depth[1:-1] = np.min((anchors - trade.peaks(u)) / np.abs(step), axis=-1)
    curve = np.array([sounded - depth, 1.0 - sounded - depth])
    length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(curve, axis=1)))])
    return np.interp(np.linspace(0.0, length[-1], count), length, sounded)
