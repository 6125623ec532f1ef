"""A program of order one as data: input and result of any solver."""

from typing import Literal, NamedTuple

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record

Stage = Literal["objective", "mass"]


class Shape(NamedTuple):
    """What a compiled program depends on; everything else is a parameter."""

    stage: Stage
    webs: int
    rows: tuple[int, ...]  # row of each norm term
    groups: tuple[int, ...]  # group of each row
    ceilings: int
    sectors: bool
    budget: bool


@record(frozen=True)
class ScaledData:
    """Parameters of the program, of order one. K webs, J terms, I ceilings."""

    shape: Shape
    constant: Real  # (2, J) real and imaginary part of C_j
    matrix: Real  # (2 J, 2 K) real parts of M first
    floor: Real  # (rows,)
    ceiling_constant: Real  # (2, I)
    ceiling_matrix: Real  # (2 I, 2 K)
    ceiling_cap: Real  # (I,)
    sine: Real  # (K,) 1 where the web is free
    cosine: Real  # (K,) 0 where the web is free
    slack: Real  # (K,) 0; 2 where the web is free, which no point of the disc exceeds
    mass: Real  # (K,) mass at full reach
    budget: Real  # (K,) the same relative to the budget
    target: Real  # (1,)
    #: what terms (J, K) and ceilings (I, K) grow by where a web is at full reach; without a modelling layer alone
    spread: Real
    ceiling_spread: Real


class ScaledSolution(NamedTuple):
    """What the solver returned, unjudged: the certificate decides what it is worth."""

    x: Real  # (K,)
    y: Real  # (K,)
    row: Real  # (rows,) multipliers of the rows (stage "mass": times the price of the target)
    term: Complex  # (J,) multipliers of the terms
    ceiling: Complex  # (I,) multipliers of the ceilings
    solver_status: str
