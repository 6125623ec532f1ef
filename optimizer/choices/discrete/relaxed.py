"""Options as the batch kernel takes them: discs, segments and sectors about those that are left."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from optimizer.choices.discrete.options import Options
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.equal_unknowns import united
from optimizer.program.limits import Limits
from optimizer.program.methods.compiled import suits_kernel
from optimizer.program.statement import Statement

#: share of its size for a relaxed slot without room: the kernel takes no limit of 0
_SPECK = 1e-9


def apart(statement: Statement, options: Options) -> tuple[Statement, Options, np.ndarray]:
    """A program that the kernel takes and the options of its unknowns, and the slot of each unknown.

    An unknown is what the webs of a slot carry together where the kernel takes that. It does not where cranks are in
    several planes or a web has a mirror image; there an unknown is a web. The proof knows all the same that webs are
    equal (``bound.py``).
    """
    alike, slots = options.alike, np.arange(options.slots)
    if alike is None:
        return statement, options, slots
    whole = united(statement, alike) if alike.plain else None
    if whole is not None and suits_kernel(whole):
        return whole, replace(options, unbalance=options.unbalance * alike.count[:, None], alike=None), slots
    webs = alike.owner
    mass = (options.mass / alike.count[:, None])[webs]
    loose = replace(options, unbalance=options.on_webs, mass=mass, part=options.part[webs], exists=options.exists[webs])
    limits = replace(statement.limits, alike=None)
    return replace(statement, limits=limits), replace(loose, alike=None), webs


def on_first(options: Options, u: Complex) -> Complex:
    """What the first webs of all slots carry (..., K), of the unknowns of :func:`apart`."""
    if options.alike is None:
        return u
    return u / options.alike.count if u.shape[-1] == options.slots else options.alike.means(u)


def relaxed(statement: Statement, options: Options, left: np.ndarray) -> tuple[Complex, Statement]:
    """Base points (N, K) and programs in what is added to them, within discs, segments and sectors about the options.

    Where nothing is left a choice the base is 0 and masses are those of the program. Elsewhere the base is the nearest
    of options on one ray, or the middle of the others.

    Parameters
    ----------
    left : (N, K, O) options of N nodes.
    statement, options : whose every slot is an unknown (:func:`apart`).
    """
    hull = hulls(options, left)
    limits = Limits(
        radius=np.broadcast_to(statement.limits.radius, hull.reach.shape),
        max_mass=hull.reach / statement.limits.radius,
        free=hull.free,
        centre=hull.centre,
        half_angle_cos=hull.half_angle_cos,
        half_angle_sin=hull.half_angle_sin,
        max_total_mass=np.maximum(statement.limits.max_total_mass - hull.mass, _SPECK * (hull.mass + 1e-300)),
    )
    return hull.base, replace(statement.about(hull.base), limits=limits)


class Hull(NamedTuple):
    """Discs, segments and sectors about base points that hold what is left of the options."""

    base: Complex  # (N, K) kg m
    reach: Real  # (N, K) kg m
    free: np.ndarray  # (N, K) bool: any direction
    centre: Complex  # (N, K) unit vectors
    half_angle_cos: Real  # (N, K)
    half_angle_sin: Real  # (N, K)
    mass: Real  # (N,) kg, of the lightest options


def hulls(options: Options, left: np.ndarray) -> Hull:
    """Of the options left (N, K, O) of N nodes, every slot an unknown."""
    u, size = options.unbalance, np.abs(options.unbalance)
    angle = np.angle(u)
    nonzero = left & (size > 0)
    mean = np.angle(np.sum(np.where(nonzero, np.exp(1j * angle), 0.0), axis=-1))
    off = np.mod(angle - mean[..., None] + np.pi, 2.0 * np.pi) - np.pi
    low = np.min(np.where(nonzero, off, np.inf), axis=-1)
    low, high = np.where(np.isinf(low), 0.0, low), np.max(np.where(nonzero, off, -np.inf), axis=-1)
    high = np.maximum(high, low)
    half, centre = 0.5 * (high - low), np.exp(1j * (mean + 0.5 * (low + high)))
    far = np.max(np.where(left, size, 0.0), axis=-1)
    near = np.min(np.where(left, size, np.inf), axis=-1)
    ray = half < 1e-9
    parts = [(np.min(np.where(left, part, np.inf), axis=-1), np.max(np.where(left, part, -np.inf), axis=-1))
             for part in (u.real, u.imag)]  # fmt: skip
    middle = 0.5 * (parts[0][0] + parts[0][1]) + 0.5j * (parts[1][0] + parts[1][1])
    from_zero = left[..., 0]
    base = np.where(from_zero, 0.0, np.where(ray, near * centre, middle))
    around = np.max(np.where(left, np.abs(u - base[..., None]), 0.0), axis=-1)
    reach = np.where(from_zero, far, np.where(ray, far - near, around))
    reach = np.maximum(reach, _SPECK * float(np.max(size, initial=0.0)))
    free = np.where(from_zero, half > 0.5 * np.pi, ~ray)
    half = np.where(free, 0.5 * np.pi, np.where(ray, 0.0, half))
    mass = np.sum(np.min(np.where(left, options.mass, np.inf), axis=-1), axis=-1)
    return Hull(
        base,
        reach,
        free,
        np.where(free, 1.0, centre),
        np.where(free, 0.0, np.cos(half)),
        np.where(free, 1.0, np.sin(half)),
        mass,
    )
