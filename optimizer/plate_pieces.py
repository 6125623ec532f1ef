"""A plate as webs in one plane: tangents of its convex mass, which are no heavier, and chords, which are no lighter."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from optimizer.arrays import Real
from optimizer.mechanics.envelope import Envelope
from optimizer.program.limits import OF_WEBS, Limits
from optimizer.program.statement import Statement

#: tangents reach no less far than chords, whatever the rounding of their pieces
_REACHES = 1.0 + 1e-13

#: radii and largest masses of webs, m and kg
Webs = tuple[Real, Real]


def chords(plate: Envelope, nodes: Real) -> Webs:
    mass = np.diff(plate.mass(nodes))
    return np.diff(plate.unbalance(nodes)) / mass, mass


def tangents(plate: Envelope, nodes: Real) -> Webs:
    """Webs no heavier than the plate: its tangents at all nodes but the last, as far as each is the highest."""
    unbalance, slope = plate.unbalance(nodes), 1.0 / plate.lever(nodes[:-1])
    at = unbalance[:-1]
    height = plate.mass(nodes[:-1]) - slope * at
    rise = np.diff(slope)
    crossing = np.where(rise > 0, -np.diff(height) / np.where(rise > 0, rise, 1.0), at[1:])
    ends = np.concatenate([[0.0], np.clip(crossing, at[:-1], at[1:]), unbalance[-1:]])
    return 1.0 / slope, np.diff(ends) * slope * _REACHES


def pieces(whole: Statement, owner: np.ndarray, webs: Mapping[int, Webs]) -> Statement:
    """The program with some webs in place of each plate."""
    limits = whole.limits
    parts = {name: getattr(limits, name)[..., owner].copy() for name in OF_WEBS}
    alike = None if limits.alike is None else limits.alike.pieces(owner)
    for k, (radius, mass) in webs.items():
        parts["radius"][..., owner == k], parts["max_mass"][..., owner == k] = radius, mass
    return replace(
        whole,
        norms=whole.norms.only(owner),
        ceilings=whole.ceilings.only(owner),
        limits=Limits(**parts, max_total_mass=limits.max_total_mass, alike=alike),
    )
