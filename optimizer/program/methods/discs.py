"""Ceilings on components as discs, which the batch kernel takes.

The component of a vector along a direction is at most a where the vector is beyond no line. Take vectors that go no
farther than V along that line. A disc of radius S that touches it holds none that is beyond; one of radius
sqrt(S^2 + V^2) about the same middle holds all that are not.
"""

from dataclasses import replace

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.norms import Norms, scalars
from optimizer.program.statement import Statement

#: S in units of V: discs differ from the lines by half of V over this
_RADII = 1e5
#: for the rounding of vectors from the middle, in units of V
_ROUNDING = 1e-9


def in_discs(statement: Statement, reach: Real, inside: bool) -> Statement:
    """One program whose ceilings on components are two discs each.

    Parameters
    ----------
    reach : (K,) largest unbalance of every web, kg m.
    inside : what keeps the discs keeps the ceilings; else what keeps the ceilings keeps the discs.
    """
    ceilings, norms = statement.ceilings, statement.ceilings.norms
    scalar = np.array(scalars(norms), dtype=bool)
    if not np.any(scalar):
        return statement
    lines, constant = norms.influence[scalar], norms.constant[scalar]
    # mostly one vector with real influences, seen along a direction
    strongest = lines[np.arange(len(lines)), np.argmax(np.abs(lines), axis=-1)]
    size = np.abs(strongest)
    towards = np.where(size > 0, strongest / np.where(size > 0, size, 1.0), 1.0)
    along: Real | Complex = (lines * np.conj(towards)[:, None]).real
    if not np.allclose(along * towards[:, None], lines, rtol=0.0, atol=1e-9 * float(np.max(size, initial=0.0))):
        # webs that turn at speeds of their own are seen along a direction each
        towards, along = np.ones(len(lines)), lines
    # a line beyond all vectors is kept by them, by its disc too where that is drawn for such as reach it
    far = np.maximum(np.abs(constant) + np.abs(along) @ reach, ceilings.cap[scalar])
    radius = _RADII * far
    middle = ceilings.cap[scalar] - radius
    wide = radius - _ROUNDING * far if inside else np.hypot(radius, far) + _ROUNDING * far
    sides = np.concatenate([np.conj(towards) * (constant - middle), np.conj(towards) * (constant + middle)])
    order = np.concatenate([np.flatnonzero(~scalar), *(2 * (np.flatnonzero(scalar),))])
    numbers, angles, scenarios = order.tolist(), ceilings.angles_deg, ceilings.scenarios
    constants: Complex = norms.constant[~scalar]
    return replace(
        statement,
        ceilings=replace(
            ceilings,
            names=tuple(ceilings.names[n] for n in numbers),
            norms=Norms(
                np.concatenate([constants, sides]),
                np.concatenate([_real(norms.influence[~scalar]), along, along]),
                norms.scatter,
            ),
            cap=np.concatenate([ceilings.cap[~scalar], wide, wide]),
            size=ceilings.size[order],
            angles_deg=None if angles is None else tuple(angles[n] for n in numbers),
            scenarios=None if scenarios is None else tuple(scenarios[n] for n in numbers),
        ),
    )


def _real(influence: Real | Complex) -> Real | Complex:
    """Influences as real numbers, where they are."""
    return influence if np.any(influence.imag) else influence.real
