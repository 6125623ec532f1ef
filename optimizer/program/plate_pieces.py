"""A plate as webs in one plane: tangents of its convex mass, which are no heavier."""

from dataclasses import replace
from typing import NamedTuple, Protocol

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.limits import OF_WEBS, Limits
from optimizer.program.statement import Statement

#: tangents reach no less far than the plate, whatever the rounding of their pieces
_REACHES = 1.0 + 1e-13
#: half-angles at first, by their tangents: closer both where a plate is all but closed and where it is all but full
_FIRST = np.arctan(np.exp(np.linspace(-4.0, 4.0, 13)))
#: nodes are laid on both sides of one, these shares as far away as those that were there
_NEARER = np.array([1.0, 0.125, 0.015625])
#: nodes of a plate at most, where those that were there are kept
_MOST = 40
#: nodes that are nearer than this share of the largest half-angle are one
_SAME = 1e-9


class Plates(Protocol):
    """Webs whose mass is a convex function of their unbalance, by half of their opening (..., P)."""

    @property
    def webs(self) -> np.ndarray:
        """(P,) which webs of the program."""

    @property
    def kinds(self) -> np.ndarray:
        """(P,) of those that are the same the same number."""

    @property
    def most(self) -> Real:
        """Largest half-angles, rad."""

    def unbalance(self, half_angle: Real) -> Real:
        """Mass times radius, kg m."""

    def mass(self, half_angle: Real) -> Real:
        """kg."""

    def lever(self, half_angle: Real) -> Real:
        """dU/dm of what is added at these openings, m."""

    def opened(self, unbalance: Real) -> Real:
        """Half-angles of unbalances, rad; the largest for more than a plate holds."""


class Webs(NamedTuple):
    """Radii [m] and largest masses [kg] of webs, (n, P): n in place of each plate; those without mass are none."""

    radius: Real
    mass: Real


class Pieces(NamedTuple):
    """A program of webs in place of plates."""

    program: Statement
    owner: np.ndarray  # (N,) web of the machine of each, in rising order
    machine_webs: int  # K

    def carried(self, u: Complex) -> Complex:
        """What the webs of the machine carry (..., K) where these carry (..., N), kg m."""
        first = np.flatnonzero(np.diff(self.owner, prepend=-1))
        totals = np.zeros((*u.shape[:-1], self.machine_webs), complex)
        totals[..., self.owner[first]] = np.add.reduceat(u, first, axis=-1)
        return totals


def total_mass(plates: Plates | None, radius: Real, u: Complex) -> float:
    """What unbalances (K,) kg m weigh, kg."""
    mass = np.abs(u) / radius
    if plates is not None:
        mass[plates.webs] = plates.mass(plates.opened(np.abs(u[plates.webs])))
    return float(np.sum(mass))


def first_nodes(plates: Plates) -> Real:
    """Half-angles (n, P) from 0 to the largest, for plates without a point so far."""
    most = plates.most
    return _apart(np.concatenate([np.zeros((1, most.size)), np.minimum(_FIRST[:, None], most), most[None]]))


def closer_nodes(nodes: Real, angle: Real) -> Real:
    """Nodes (n, P) at half-angles (P,), and on both sides up to those that were there."""
    near = _SAME * nodes[-1]
    low = np.maximum.reduce(np.where(nodes < angle - near, nodes, 0.0), axis=0)
    high = np.minimum.reduce(np.where(nodes > angle + near, nodes, nodes[-1]), axis=0)
    below = angle + _NEARER[:, None] * (low - angle)
    above = angle + _NEARER[::-1, None] * (high - angle)
    return _apart(np.concatenate([nodes[:1], below, angle[None], above, nodes[-1:]]))


def nodes_about(plates: Plates, nodes: Real, u: Complex, lighter: float) -> Real:
    """Nodes about the openings of unbalances (K,) kg m; the same where their tangents are about as heavy.

    Parameters
    ----------
    lighter : share of its mass by which a tangent may be lighter than what is cut.
    """
    size = np.abs(u[plates.webs])
    angle = plates.opened(size)
    at = nodes[:-1]
    tangent = plates.mass(at) + (size - plates.unbalance(at)) / plates.lever(at)
    mass = plates.mass(angle)
    if np.all(mass - np.maximum.reduce(tangent, axis=0) <= lighter * mass):
        return nodes
    # of tangents that are nearer the plate between them is no heavier than that
    closer = _apart(closer_nodes(nodes, angle), lighter=lighter)
    # those that were there stay, so that a point that was seen to be heavy is not called for again
    every = np.sort(np.concatenate([nodes[1:-1], closer[1:-1]]), axis=0)
    distance = np.abs(every - angle)
    # those that are one count once
    distance[1:][every[1:] == every[:-1]] = np.inf
    order = np.argsort(distance, axis=0, kind="stable")[:_MOST]
    inside = np.sort(np.take_along_axis(every, order, axis=0), axis=0)
    result = _apart(np.concatenate([nodes[:1], inside, nodes[-1:]]), lighter=lighter)
    return nodes if np.array_equal(result, nodes) else result


def _apart(nodes: Real, share: float = _SAME, lighter: float = 0.0) -> Real:
    """The same, in rising order, none next to another: those that are one have the same half-angle.

    Parameters
    ----------
    share : of the largest half-angle, by which nodes differ that are not one.
    lighter : share of its mass by which a plate may be heavier than tangents at nodes that are one. Such nodes are the
        nearer where it is all but closed, and towards the largest half-angle, where the lever may vanish.
    """
    inside = nodes[1:-1]
    # one laid up to the largest may be above it by rounding
    rest = np.maximum(nodes[-1] - inside, 0.0)
    near = np.maximum(share * nodes[-1], np.sqrt(lighter) * np.minimum(inside, np.sqrt(rest * nodes[-1])))
    inside = np.where((inside - nodes[:-2] > near) & (rest > near), inside, 0.0)
    return np.concatenate([nodes[:1], np.maximum.accumulate(inside, axis=0), nodes[-1:]])


def tangents(plates: Plates, nodes: Real) -> Webs:
    """Webs no heavier than the plates: tangents at all nodes but the last, as far as each is the highest."""
    unbalance, slope = plates.unbalance(nodes), 1.0 / plates.lever(nodes[:-1])
    at = unbalance[:-1]
    height = plates.mass(nodes[:-1]) - slope * at
    rise, fall = slope[1:] - slope[:-1], height[:-1] - height[1:]
    crossing = np.where(rise > 0, fall / np.where(rise > 0, rise, 1.0), at[1:])
    ends = np.concatenate([np.zeros_like(at[:1]), np.clip(crossing, at[:-1], at[1:]), unbalance[-1:]])
    return Webs(1.0 / slope, (ends[1:] - ends[:-1]) * slope * _REACHES)


def pieces(whole: Statement, plates: Plates, webs: Webs, left: np.ndarray | None = None) -> Pieces:
    """The program with some webs in place of each plate.

    Parameters
    ----------
    left : (K,) bool, webs of which there is anything; None is all.
    """
    limits = whole.limits
    count = np.ones(limits.radius.shape[-1], int) if left is None else left.astype(int)
    is_plate = np.zeros(count.size, bool)
    is_plate[plates.webs] = True
    mask = (webs.mass.T > 0) & (count[plates.webs, None] > 0)
    count[plates.webs] = np.add.reduce(mask, axis=-1)
    owner = np.repeat(np.arange(count.size), count)
    parts = {name: getattr(limits, name)[..., owner].copy() for name in OF_WEBS}
    cut = is_plate[owner]
    parts["radius"][..., cut], parts["max_mass"][..., cut] = webs.radius.T[mask], webs.mass.T[mask]
    alike = None if limits.alike is None else limits.alike.pieces(owner)
    program = replace(
        whole,
        norms=whole.norms.only(owner),
        ceilings=whole.ceilings.only(owner),
        limits=Limits(**parts, max_total_mass=limits.max_total_mass, alike=alike),
    )
    return Pieces(program, owner, count.size)
