"""Faces whose size or place has nothing to do with that of the others: their units are not those of the others."""

from collections.abc import Iterator

import numpy as np

from optimizer.mechanics.crankshaft.faces import Cylinders
from schemas.base.model import FieldProblem

#: ratio of radii, and of distances, in one list, above which they are in different units; shafts have no such screws
_MIXED = 200.0
#: ratio of length and radius of a face, above which they are in different units
_SLENDER = 500.0
_ROUND_DEG = 300.0


def unit_problems(cylinders: Cylinders) -> Iterator[FieldProblem]:
    """What is wrong with whole round faces (n,), against the medians of all."""
    whole = cylinders.subset(cylinders.angle_deg >= _ROUND_DEG)
    if not len(whole.number):
        return
    middle = np.mean(whole.tips, axis=1)
    away = np.linalg.norm(middle - np.median(middle, axis=0), axis=-1)
    size = away + whole.length + whole.radius
    ratio = whole.radius / np.median(whole.radius)
    for n, number in enumerate(whole.number.tolist()):
        if max(ratio[n], 1 / ratio[n]) > _MIXED:
            message = f"{ratio[n]:.4g} times that of the others: is its unit that of the others?"
            yield FieldProblem(("faces", number, "radius_m"), message)
        elif whole.length[n] > _SLENDER * whole.radius[n]:
            message = f"its length is {whole.length[n] / whole.radius[n]:.4g} times its radius: are both in one unit?"
            yield FieldProblem(("faces", number, "ends_m"), message)
        elif away[n] > _MIXED * np.median(size):
            message = f"{away[n] / np.median(size):.4g} times as far away as the others: is its unit theirs?"
            yield FieldProblem(("faces", number, "centre_m"), message)
