"""Norm terms |c_j + H_j u|, of which objectives and ceilings are made."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from optimizer.numerics.arrays import SMALLEST, Complex, Real, columns, spread
from optimizer.numerics.records import record


@record(frozen=True)
class Norms:
    """Terms |c_j + H_j u|; where counterweights scatter, each the largest of all that they may come to.

    Of a quantity that is no vector, such as a moment about the crankshaft, a term is |Re(c_j + H_j u)|. It is a norm
    whose multiplier y_j is real, and every proof by Re(conj(y_j) (c_j + H_j u)) holds for it.
    """

    constant: Complex  # (..., J)
    influence: Real | Complex  # (..., J, K)
    scatter: float = 0.0  # share of its unbalance that every counterweight may be off by, in any direction
    scalar: tuple[bool, ...] = ()  # (J,) terms of which only the real part counts; () is none

    def at(self, u: Complex) -> Complex:
        """Vectors c_j + H_j u, (..., J); of scalars the real part."""
        return self.counting(self.constant + np.add.reduce(self.influence * u[..., None, :], axis=-1))

    def counting(self, vectors: Complex) -> Complex:
        """What counts of vectors (..., J), or of their multipliers."""
        return np.where(self.scalar, np.real(vectors), vectors) if any(self.scalar) else vectors

    def sizes(self, u: Complex) -> Real:
        """Sizes of the terms (..., J), all counterweights off in the direction in which the term grows."""
        sizes = np.abs(self.at(u))
        if not self.scatter:
            return sizes
        return sizes + self.scatter * np.add.reduce(np.abs(self.influence) * np.abs(u)[..., None, :], axis=-1)

    @property
    def largest_influence(self) -> Real:
        """Largest |H_jk| over the webs, (..., J); 1 where no web has any."""
        largest = np.maximum.reduce(np.abs(self.influence), axis=-1, initial=0.0)
        return np.where(largest > 0, largest, 1.0)

    @property
    def is_complex(self) -> bool:
        """Whether influences are complex: counterweights act out of line with themselves."""
        return self.influence.dtype.kind == "c"

    def mapped(self, function: Callable[[Any], Any]) -> "Norms":
        """A function of every array."""
        return Norms(function(self.constant), function(self.influence), self.scatter, self.scalar)

    def permutation(self, webs: np.ndarray) -> "Norms":
        """The same with the webs in another order (K,)."""
        return replace(self, influence=self.influence[..., webs].copy())

    def only(self, webs: np.ndarray) -> "Norms":
        # in the usual order in memory, in which sums are the same to the last bit
        return replace(self, influence=columns(self.influence, webs))


def scalars(norms: Norms) -> tuple[bool, ...]:
    """Whether each term of programs is a scalar (J,)."""
    return norms.scalar or (False,) * norms.constant.shape[-1]


def join(norms: Sequence[Norms]) -> Norms:
    """All terms side by side, (..., J) and (..., J, K)."""
    leadings, constant, influence = set(), [], []
    for part in norms:
        leadings |= {part.constant.shape[:-1], part.influence.shape[:-2]}
        constant.append(part.constant)
        influence.append(part.influence)
    # mostly one, which is not worth the time to broadcast
    if len(leadings) > 1:
        leading = np.broadcast_shapes(*leadings)
        constant = [spread(array, (*leading, array.shape[-1])) for array in constant]
        influence = [spread(array, (*leading, *array.shape[-2:])) for array in influence]
    matrix = influence[0] if len(influence) == 1 else np.concatenate(influence, axis=-2)
    # what is too small to divide by has no influence, as in `total`
    return Norms(np.concatenate(constant, axis=-1), np.where(np.abs(matrix) > SMALLEST, matrix, 0.0))
