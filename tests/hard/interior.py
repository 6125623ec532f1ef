"""A primal-dual interior point method at any precision, for programs made of small blocks.

    minimise    sum_b c_b'x_b
    subject to  sum_b A_b x_b = rhs                  the coupling, a few rows
                h_i - G_i x_b in a second-order cone  for every cone i of block b

Nesterov-Todd scaling with Mehrotra's corrector, as in L. Vandenberghe, The CVXOPT linear and quadratic cone
program solvers (2010), sections 4 to 7. A cone of dimension 1 is a half-line. Every block is eliminated by
itself, which leaves a dense system as large as the coupling; what that form loses in digits, 100 digits have.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

from mpmath import MPContext

mp = MPContext()
mp.dps = 100

Number = Any  # mpf of the context above
Vector = list[Number]
Matrix = list[Vector]

ZERO, ONE = mp.mpf(0), mp.mpf(1)
MAX_STEPS = 250


class NotConverged(Exception):
    """The method came to rest before its answer was proven."""


@dataclass
class Cone:
    """h - G x = s with s_0 >= |s_1..|."""

    G: Matrix
    h: Vector
    s: Vector = field(default_factory=list)
    z: Vector = field(default_factory=list)

    def values(self, x: Vector) -> Vector:
        return [h - dot(row, x) for row, h in zip(self.G, self.h, strict=True)]


@dataclass
class Block:
    """Variables of one block, with their cost, coupling and cones."""

    cost: Vector
    coupling: Matrix  # (rows, variables)
    cones: list[Cone]
    x: Vector = field(default_factory=list)


def dot(a: Sequence[Number], b: Sequence[Number]) -> Number:
    return mp.fdot(a, b)


def solve(blocks: list[Block], rhs: Vector, proven: Callable[[list[Block]], bool], max_steps: int = MAX_STEPS) -> int:
    """Solve in place until ``proven`` says that the blocks hold a proof; number of steps taken.

    Raises
    ------
    NotConverged
        if that does not happen within ``max_steps``.
    """
    p = _start(blocks, rhs)
    cones = [cone for block in blocks for cone in block.cones]
    for step in range(max_steps):
        gap = sum((dot(cone.s, cone.z) for cone in cones), ZERO)
        if gap < mp.mpf(10) ** -12 and proven(blocks):
            return step
        if gap < mp.mpf(10) ** (20 - mp.dps):
            break
        p = _advance(blocks, cones, rhs, p, gap)
    raise NotConverged(f"gap {mp.nstr(gap, 3)} after {step + 1} steps")


def _start(blocks: list[Block], rhs: Vector) -> Vector:
    """Least-squares start: the point nearest to the cones' apices, moved into their interior."""
    unit = [_identity(cone) for block in blocks for cone in block.cones]
    systems = _Systems(blocks, unit)
    primal, _ = systems.solve([_combine(block, [cone.h for cone in block.cones]) for block in blocks], rhs)
    dual, p = systems.solve([[-c for c in block.cost] for block in blocks], [ZERO] * len(rhs))
    for block, x, y in zip(blocks, primal, dual, strict=True):
        block.x = x
        for cone in block.cones:
            cone.s = _inside(cone.values(x))
            cone.z = _inside([dot(row, y) for row in cone.G])
    return p


def _identity(cone: Cone) -> "_Scaling":
    unit = [ONE] + [ZERO] * (len(cone.h) - 1)
    return _Scaling(unit, unit)


def _combine(block: Block, vectors: list[Vector]) -> Vector:
    """sum_i G_i' v_i."""
    total = [ZERO] * len(block.cost)
    for cone, vector in zip(block.cones, vectors, strict=True):
        for row, factor in zip(cone.G, vector, strict=True):
            total = [t + r * factor for t, r in zip(total, row, strict=True)]
    return total


def _inside(s: Vector) -> Vector:
    """The vector itself if it is well inside its cone, else moved along the axis."""
    short = mp.sqrt(dot(s[1:], s[1:])) - s[0]
    return s if short < -mp.mpf("1e-8") else [s[0] + short + 1, *s[1:]]


class _Scaling:
    """Nesterov-Todd scaling W of one cone: W z = W^-1 s = lam."""

    def __init__(self, s: Vector, z: Vector) -> None:
        ss, zz = _hyperbolic(s, s), _hyperbolic(z, z)
        self.beta = mp.sqrt(mp.sqrt(ss / zz))
        root_s, root_z = mp.sqrt(ss), mp.sqrt(zz)
        s, z = [v / root_s for v in s], [v / root_z for v in z]
        gamma = mp.sqrt((1 + dot(s, z)) / 2)
        w = [(s[0] + z[0]) / (2 * gamma), *((a - b) / (2 * gamma) for a, b in zip(s[1:], z[1:], strict=True))]
        self.w = w
        scale = mp.sqrt(2 * (w[0] + 1))
        self.v = [(w[0] + 1) / scale, *(component / scale for component in w[1:])]

    def times(self, x: Vector) -> Vector:
        """W x."""
        twice = 2 * dot(self.v, x)
        return [self.beta * (v * twice - j) for v, j in zip(self.v, _flip(x), strict=True)]

    def over(self, x: Vector) -> Vector:
        """W^-1 x."""
        v = _flip(self.v)
        twice = 2 * dot(v, x)
        return [(a * twice - j) / self.beta for a, j in zip(v, _flip(x), strict=True)]

    def over_square(self, x: Vector) -> Vector:
        """W^-2 x."""
        w = _flip(self.w)
        twice, square = 2 * dot(w, x), self.beta * self.beta
        return [(a * twice - j) / square for a, j in zip(w, _flip(x), strict=True)]


def _flip(x: Vector) -> Vector:
    return [x[0], *(-component for component in x[1:])]


def _hyperbolic(a: Vector, b: Vector) -> Number:
    return a[0] * b[0] - dot(a[1:], b[1:])


def _product(a: Vector, b: Vector) -> Vector:
    return [dot(a, b), *(a[0] * v + b[0] * u for u, v in zip(a[1:], b[1:], strict=True))]


def _quotient(a: Vector, d: Vector) -> Vector:
    """x with a o x = d."""
    first = _hyperbolic(a, d) / _hyperbolic(a, a)
    return [first, *((v - first * u) / a[0] for u, v in zip(a[1:], d[1:], strict=True))]


class _Systems:
    """Newton's equations: every block factored, then the coupling."""

    def __init__(self, blocks: list[Block], scalings: list[_Scaling]) -> None:
        self.blocks = blocks
        rows = len(blocks[0].coupling)
        self.factors, self.through = [], []
        schur = [[ZERO] * rows for _ in range(rows)]
        actual_scalings = iter(scalings)
        for block in blocks:
            n = len(block.cost)
            hessian = [[ZERO] * n for _ in range(n)]
            for cone in block.cones:
                scaling = next(actual_scalings)
                for j in range(n):
                    column = [row[j] for row in cone.G]
                    if any(column):
                        image = scaling.over_square(column)
                        for i in range(j + 1):
                            hessian[i][j] += dot([row[i] for row in cone.G], image)
            factor = _cholesky(hessian)
            through = [_back(factor, row) for row in block.coupling]  # rows of A D^-1
            for i in range(rows):
                for j in range(i, rows):
                    schur[i][j] += dot(through[i], block.coupling[j])
            self.factors.append(factor)
            self.through.append(through)
        self.schur = _cholesky(schur) if rows else []

    def solve(self, right: list[Vector], coupling: Vector) -> tuple[list[Vector], Vector]:
        """x_b and p with D_b x_b + A_b'p = right_b, sum A_b x_b = coupling."""
        rest = [-value for value in coupling]
        for through, r in zip(self.through, right, strict=True):
            rest = [value + dot(row, r) for value, row in zip(rest, through, strict=True)]
        p = _back(self.schur, rest) if rest else []
        pivots = []
        for block, factor, r in zip(self.blocks, self.factors, right, strict=True):
            pull = r
            for price, row in zip(p, block.coupling, strict=True):
                pull = [a - price * b for a, b in zip(pull, row, strict=True)]
            pivots.append(_back(factor, pull))
        return pivots, p


def _cholesky(upper: Matrix) -> Matrix:
    """Rows of L with L L' the symmetric matrix whose upper triangle is given."""
    n = len(upper)
    lower: Matrix = [[ZERO] * n for _ in range(n)]
    for j in range(n):
        for i in range(j, n):
            pivot = upper[j][i] - dot(lower[i][:j], lower[j][:j])
            if i == j:
                if pivot <= 0:
                    raise NotConverged("the equations are singular at this precision")
                lower[j][j] = mp.sqrt(pivot)
            else:
                lower[i][j] = pivot / lower[j][j]
    return lower


def _back(lower: Matrix, right: Vector) -> Vector:
    n = len(right)
    y: Vector = []
    for i in range(n):
        y.append((right[i] - dot(lower[i][:i], y)) / lower[i][i])
    for i in reversed(range(n)):
        y[i] = (y[i] - sum((lower[k][i] * y[k] for k in range(i + 1, n)), ZERO)) / lower[i][i]
    return y


def _advance(blocks: list[Block], cones: list[Cone], rhs: Vector, p: Vector, gap: Number) -> Vector:
    """One step; the new multipliers of the coupling."""
    scalings = [_Scaling(cone.s, cone.z) for cone in cones]
    lam = [scaling.times(cone.z) for scaling, cone in zip(scalings, cones, strict=True)]
    systems = _Systems(blocks, scalings)
    missing = rhs
    for block in blocks:
        missing = [m - dot(row, block.x) for m, row in zip(missing, block.coupling, strict=True)]
    lacking = []  # G x + s - h
    for block in blocks:
        lacking += [[s - v for s, v in zip(c.s, c.values(block.x), strict=True)] for c in block.cones]
    slope = []  # c + G'z + A'p
    for block in blocks:
        gradient = [a + b for a, b in zip(block.cost, _combine(block, [c.z for c in block.cones]), strict=True)]
        for multiplier, row in zip(p, block.coupling, strict=True):
            gradient = [a + multiplier * b for a, b in zip(gradient, row, strict=True)]
        slope.append(gradient)

    def direction(targets: list[Vector]) -> tuple[list[Vector], Vector, list[Vector], list[Vector]]:
        quotients = [_quotient(a, d) for a, d in zip(lam, targets, strict=True)]
        moved = [
            [a + b for a, b in zip(scaling.over_square(r), scaling.over(q), strict=True)]
            for scaling, r, q in zip(scalings, lacking, quotients, strict=True)
        ]
        right, at = [], 0
        for block, gradient in zip(blocks, slope, strict=True):
            part = _combine(block, moved[at : at + len(block.cones)])
            at += len(block.cones)
            right.append([-a - b for a, b in zip(gradient, part, strict=True)])
        dx, dp = systems.solve(right, missing)
        ds, dz, at = [], [], 0
        for block, step in zip(blocks, dx, strict=True):
            for cone in block.cones:
                change = [dot(row, step) for row in cone.G]
                ds.append([-a - b for a, b in zip(change, lacking[at], strict=True)])
                dz.append([a + b for a, b in zip(scalings[at].over_square(change), moved[at], strict=True)])
                at += 1
        return dx, dp, ds, dz

    _, _, ds, dz = direction([[-v for v in _product(a, a)] for a in lam])
    reach = min(ONE, _longest(cones, ds, dz))
    centring = (1 - reach) ** 3 * gap / len(cones)
    targets = []
    for a, scaling, u, v in zip(lam, scalings, ds, dz, strict=True):
        second = _product(scaling.over(u), scaling.times(v))
        target = [-x - y for x, y in zip(_product(a, a), second, strict=True)]
        targets.append([target[0] + centring, *target[1:]])
    dx, dp, ds, dz = direction(targets)
    length = min(ONE, mp.mpf("0.99") * _longest(cones, ds, dz))
    for block, change in zip(blocks, dx, strict=True):
        block.x = [a + length * b for a, b in zip(block.x, change, strict=True)]
    for cone, u, v in zip(cones, ds, dz, strict=True):
        cone.s = [a + length * b for a, b in zip(cone.s, u, strict=True)]
        cone.z = [a + length * b for a, b in zip(cone.z, v, strict=True)]
    return [a + length * b for a, b in zip(p, dp, strict=True)]


def _longest(cones: list[Cone], ds: list[Vector], dz: list[Vector]) -> Number:
    """Longest step that stays in the cones."""
    longest = mp.mpf(10) ** 6
    for cone, u, v in zip(cones, ds, dz, strict=True):
        longest = min(longest, _to_boundary(cone.s, u), _to_boundary(cone.z, v))
    return longest


def _to_boundary(s: Vector, d: Vector) -> Number:
    far = mp.mpf(10) ** 6
    if len(s) == 1:
        return -s[0] / d[0] if d[0] < 0 else far
    a, b, c = _hyperbolic(d, d), _hyperbolic(s, d), _hyperbolic(s, s)
    inside = b * b - a * c
    if inside < 0 or (a >= 0 and b >= 0):
        return far
    # the smaller positive root of a t^2 + 2 b t + c, written without cancellation
    step = c / (mp.sqrt(inside) - b)
    return step if step > 0 else far
