"""The program that sees the peaks only at sampled shaft angles, as is customary.

minimise    sum or maximum of t_r over the peaks
subject to  |W_r F_r(theta_i; u)| <= t_r   at the angles theta_i,
            |F_c(theta_i; u)| <= ceiling_c, u within the limits.

A peak between two angles is not seen. Half a turn is enough, F(theta + pi) = -F(theta); with n angles in a
turn the nearest is at most pi/n away, so that a sampled peak is at least cos(pi/n) of the true one, and so
is the smallest sampled objective of the smallest true one. It is a relaxation: its multipliers prove a
bound. The matrices go to clarabel directly, without the time of a modelling layer.
"""

from dataclasses import replace

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record
from optimizer.program.reference.assembled import Assembly, NoPoint, Part, add_discs, add_limits, dense, vector_duals
from optimizer.program.scaling import Scaling
from optimizer.program.statement import Statement
from optimizer.responses.response import Response
from optimizer.studies.accuracy.rivals.matrices import RivalPoint, point, scaled

_TOLERANCE = 1e-9


@record(frozen=True)
class WeightedResponse:
    """A response whose peak is to be small, with its weight and those of its components."""

    response: Response
    weight: float
    weight_x: float = 1.0
    weight_y: float = 1.0

    def only(self, webs: np.ndarray) -> "WeightedResponse":
        against = self.response.counter_influence
        response = replace(
            self.response,
            influence=self.response.influence[webs],
            counter_influence=None if against is None else against[webs],
        )
        return replace(self, response=response)


@record(frozen=True)
class OverTheTurn:
    """What :func:`optimizer.program.rows.statement` was made of; the statement keeps no phases."""

    peaks: tuple[WeightedResponse, ...]
    combine: str
    ceilings: tuple[tuple[WeightedResponse, float], ...]

    def only(self, webs: np.ndarray) -> "OverTheTurn":
        return OverTheTurn(
            tuple(peak.only(webs) for peak in self.peaks),
            self.combine,
            tuple((response.only(webs), ceiling) for response, ceiling in self.ceilings),
        )


def half_turn(angles: int, position: float) -> Real:
    """Sampled angles of half a turn, rad (angles/2,).

    Parameters
    ----------
    angles : in a whole turn, even.
    position : of the grid, as a share of its step; 0 samples at the angle at which the machine is drawn.
    """
    return 2.0 * np.pi * (np.arange(angles // 2) + position) / angles


def sampled(
    statement: Statement, turn: OverTheTurn, angles: int, position: float, time_limit_s: float
) -> RivalPoint | NoPoint:
    """Solve the sampled program; the multipliers are those of the exact program that they amount to.

    Parameters
    ----------
    turn : the peaks and ceilings of the statement.
    angles, position : the grid, as in :func:`half_turn`.
    """
    data, scaling = scaled(statement, 0.0)
    webs, together = data.shape.webs, turn.combine == "max"
    first = 3 * webs
    program = Assembly(first + (1 if together else len(turn.peaks)))
    grid = half_turn(angles, position)
    none = np.zeros(grid.size)
    objective, caps = [], []
    for r, peak in enumerate(turn.peaks):
        size = dense(first + (0 if together else r), np.ones((grid.size, 1)))
        constant, matrix = _vectors(peak, grid, statement, scaling, scaling.objective)
        objective.append(program.cones(none, (size,), constant, (matrix,)))
    for (ceiling, most), unit in zip(turn.ceilings, statement.ceilings.size, strict=True):
        constant, matrix = _vectors(ceiling, grid, statement, scaling, float(unit))
        caps.append(program.cones(none + most / unit, (), constant, (matrix,)))
    add_limits(program, data)
    add_discs(program, data)
    cost = np.zeros(program.columns)
    cost[first:] = 1.0
    result = program.solve(cost, _TOLERANCE, time_limit_s)
    if isinstance(result, NoPoint):
        return result
    v, dual = result
    at_angles = [vector_duals(dual[rows]) for rows in objective]
    # each peak is a row of its own under "max"; its share is what its angles have of the multipliers
    row = np.array([np.sum(np.abs(angle)) for angle in at_angles]) if together else np.ones(1)
    term = [_terms(angle, grid, peak) for angle, peak in zip(at_angles, turn.peaks, strict=True)]
    ceiling_terms = [np.sum(vector_duals(dual[rows]) * np.exp(-1j * grid), keepdims=True) for rows in caps]
    return point(
        statement,
        scaling,
        v,
        float(cost @ v),
        row,
        np.concatenate(term),
        np.concatenate([np.zeros(0, complex), *ceiling_terms]),
    )


def _vectors(
    peak: WeightedResponse, grid: Real, statement: Statement, scaling: Scaling, unit: float
) -> tuple[Real, Part]:
    """Real and then imaginary parts of W F(theta_i) / unit as an affine function of the scaled variables.

    F = f e^{ja} + b e^{-ja} with f affine in u, and conj(b) where shafts turn backwards. The sign of a, the sense of
    rotation, only changes the order of the samples.
    """
    response, rotation = peak.response, np.exp(1j * grid)
    constant = response.baseline.co * rotation + response.baseline.counter * np.conj(rotation)
    reach = scaling.reach * statement.limits.centre
    along = rotation[:, None] * (response.influence * reach)
    across = 1j * along * statement.limits.half_angle_sin
    if response.counter_influence is not None:
        back = np.conj(rotation[:, None] * (response.counter_influence * reach))
        along, across = along + back, across - 1j * back * statement.limits.half_angle_sin
    x, y = (peak.weight * factor / unit for factor in (peak.weight_x, peak.weight_y))
    matrix = np.block([[x * along.real, x * across.real], [y * along.imag, y * across.imag]])
    return np.concatenate([x * constant.real, y * constant.imag]), dense(0, matrix)


def _terms(multiplier: Complex, grid: Real, peak: WeightedResponse) -> Complex:
    """Multipliers of the norm terms of a peak that multipliers of its samples amount to.

    With the weighted vector a_1 e^{ja} + conj(a_2) e^{-ja}: Re(conj(y) F) = Re(conj(y e^{-ja}) a_1) +
    Re(conj(conj(y) e^{-ja}) a_2); with equal weights a_2 is constant and stands in the floor, if no shaft turns
    backwards.
    """
    back = np.exp(-1j * grid)
    alone = peak.weight_x == peak.weight_y and peak.response.counter_influence is None
    parts = (multiplier,) if alone else (multiplier, np.conj(multiplier))
    return np.array([np.sum(part * back) for part in parts])
