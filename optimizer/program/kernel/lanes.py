"""Programs of one shape side by side, and where they stand: one in each lane of the arrays.

The longest contiguous axis runs over lanes, so that loops become vector instructions. Sizes: L lanes, K webs, Q cones
of the peaks (J terms, then ceilings), C = K + Q, R rows, n unknowns that are factored. Notation as in
:mod:`optimizer.program.kernel.newton`.
"""

from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Real
from optimizer.program.kernel.compiling import inner


class Lanes(NamedTuple):
    """Programs of one shape side by side; lane t of web k is at k L + t, and so for cones."""

    row: np.ndarray  # (J,) row of each term
    floor: Real  # (R, L)
    cap: Real  # (Q - J, L)
    constant: Real  # (2, Q L)
    influence: Real  # (Q, K L)
    centre: Real  # (2, K L)
    sine: Real  # (K L,)
    cosine: Real  # (K L,)
    present: Real  # (3, K L) 1 where there is such a limit, else 0: full reach, which there always is, and the edges
    mass: Real  # (K L,) cost of full reach: 0 in the first stage
    budget: Real  # (K L,) mass at full reach relative to the budget; 0 without one
    target: Real  # (L,) least mass: largest value of a row


class State(NamedTuple):
    """Where the programs stand; cones of the webs come first."""

    v: Real  # (3, K L) x, a, b
    q: Real  # (3, K L)
    zq: Real  # (3, K L)
    s: Real  # (3, C L)
    z: Real  # (3, C L)
    rho: Real  # (R, L) slack of the rows
    z_rho: Real  # (R, L)
    rest: Real  # (3, L) slack of the budget, its multiplier, and the level above all rows


class Course(NamedTuple):
    """What is kept of the program in each lane (L,)."""

    program: np.ndarray  # its number; -1 for none
    vacancy: Real  # 1 where the lane has to take a program, else 0
    better: Real  # 1 where its state is the best so far
    cautious: Real  # 1 where its last step was short
    barrier: Real  # number of products of slack and multiplier
    costs: Real  # largest cost of a web
    sigma: Real  # share of the gap that a step aims at
    correction: Real  # 1 where a step has a second-order part
    reached: Real  # smallest gap and residual
    tolerance: Real
    middle: Real
    steps: Real
    stalled: Real  # steps since it became clearly smaller


class Work(NamedTuple):
    """Arrays that a step is computed in."""

    a: Real  # (2, Q L) vectors of the peaks
    u: Real  # (2, K L) vectors of the webs
    rd: Real  # (3, K L) residual of the webs
    rp: Real  # (3, Q L) of the cones of the peaks
    rp_row: Real  # (R, L) of the rows
    primal: Real  # (L,) largest of these two
    dual: Real  # (L,) largest of the residuals of x
    gap: Real  # (L,)
    w: Real  # (3, C L)
    eta: Real  # (C L,)
    lam: Real  # (3, C L)
    f: Real  # (3, C L)
    ws: Real  # (3, C L)
    d: Real  # (3, C L) second-order parts
    ds: Real  # (3, C L)
    dz: Real  # (3, C L)
    per_cone: Real  # (C L,) a value for every cone
    e: Real  # (3, K L) right sides, then steps of the webs
    own: Real  # (3, K L) steps of the webs where no multiplier of the peaks and the budget changes
    response: Real  # (3, K L) what such changes add to them
    edges: Real  # (2, K L)
    fq: Real  # (3, K L)
    cq: Real  # (3, K L) second-order parts
    dq: Real  # (3, K L)
    dzq: Real  # (3, K L)
    block: Real  # (11, K L)
    m: Real  # (n, n, L)
    least: Real  # (n, L) what the rows and the budget add to its diagonal themselves
    right: Real  # (n, L)
    border: Real  # (R, L) what a level that rises by one asks of the rows, and its square
    border_square: Real  # (L,)
    c_rho: Real  # (R, L) second-order parts
    d_rho: Real  # (R, L)
    dz_rho: Real  # (R, L)
    c_rest: Real  # (1, L)
    d_rest: Real  # (3, L)
    nu: Real  # (L,) product of slack and multiplier that the step aims at
    keep: Real  # (L,) share of the residuals that the step removes
    step: Real  # (L,)
    where: np.ndarray  # (Q,) first unknown of every vector
    always: Real  # (L,) 1: limits that are there without any web


class Memory(NamedTuple):
    """All of these, those of one size in one array: to hand over an array takes as long as a short loop."""

    row: np.ndarray  # (J,)
    program: np.ndarray  # (L,)
    where: np.ndarray  # (Q,)
    lanes: Real  # (25, L)
    webs: Real  # (48, K L)
    peaks: Real  # (7, Q L)
    cones: Real  # (23, C L)
    rows: Real  # (6, R, L)
    cap: Real  # (Q - J, L)
    influence: Real  # (Q, K L)
    m: Real  # (n, n, L)
    unknowns: Real  # (2, n, L)


def new_memory(row: np.ndarray, webs: int, cones: int, rows: int, lanes: int) -> Memory:
    terms = row.size
    # unknowns: (y_x, y_y) of terms, (mu, y_x, y_y) of ceilings, budget, rows
    n = 2 * terms + rows + 3 * (cones - terms) + 1
    where = np.empty(cones, np.int64)
    for i in range(cones):
        where[i] = 2 * i if i < terms else 2 * terms + 3 * (i - terms) + 1
    return Memory(
        row,
        np.zeros(lanes, np.int64),
        where,
        np.zeros((25, lanes)),
        np.zeros((48, webs * lanes)),
        np.zeros((7, cones * lanes)),
        np.zeros((23, (webs + cones) * lanes)),
        np.zeros((6, rows, lanes)),
        np.zeros((cones - terms, lanes)),
        np.zeros((cones, webs * lanes)),
        np.zeros((n, n, lanes)),
        np.zeros((2, n, lanes)),
    )


@inner
def parts_of(memory):  # type: ignore[no-untyped-def]
    """The lanes, their course, and what a step is computed in."""
    lane, web, peak, cone, row = memory.lanes, memory.webs, memory.peaks, memory.cones, memory.rows
    batch = Lanes(
        row=memory.row,
        floor=row[0],
        cap=memory.cap,
        constant=peak[0:2],
        influence=memory.influence,
        centre=web[0:2],
        sine=web[2],
        cosine=web[3],
        present=web[4:7],
        mass=web[7],
        budget=web[8],
        target=lane[20],
    )
    course = Course(
        program=memory.program,
        vacancy=lane[0],
        better=lane[1],
        cautious=lane[2],
        barrier=lane[3],
        costs=lane[4],
        sigma=lane[5],
        correction=lane[6],
        reached=lane[7],
        tolerance=lane[8],
        middle=lane[9],
        steps=lane[10],
        stalled=lane[11],
    )
    work = Work(
        a=peak[2:4],
        u=web[9:11],
        rd=web[11:14],
        rp=peak[4:7],
        rp_row=row[1],
        primal=lane[12],
        dual=lane[13],
        gap=lane[14],
        w=cone[0:3],
        eta=cone[3],
        lam=cone[4:7],
        f=cone[7:10],
        ws=cone[10:13],
        d=cone[13:16],
        ds=cone[16:19],
        dz=cone[19:22],
        per_cone=cone[22],
        e=web[14:17],
        own=web[17:20],
        response=web[20:23],
        edges=web[23:25],
        fq=web[25:28],
        cq=web[28:31],
        dq=web[31:34],
        dzq=web[34:37],
        block=web[37:48],
        m=memory.m,
        least=memory.unknowns[0],
        right=memory.unknowns[1],
        border=row[2],
        border_square=lane[15],
        c_rho=row[3],
        d_rho=row[4],
        dz_rho=row[5],
        c_rest=lane[21:22],
        d_rest=lane[22:25],
        nu=lane[16],
        keep=lane[17],
        step=lane[18],
        where=memory.where,
        always=lane[19],
    )
    work.always[:] = 1.0
    return batch, course, work


def state_size(webs: int, cones: int, rows: int) -> int:
    return 15 * webs + 6 * cones + 2 * rows + 3


@inner
def views(storage, webs, cones, rows):  # type: ignore[no-untyped-def]
    """A packed state (S, L) as its parts."""
    lanes, every = storage.shape[1], webs + cones
    at_s = 9 * webs
    at_rho = at_s + 6 * every
    return State(
        storage[: 3 * webs].reshape((3, webs * lanes)),
        storage[3 * webs : 6 * webs].reshape((3, webs * lanes)),
        storage[6 * webs : at_s].reshape((3, webs * lanes)),
        storage[at_s : at_s + 3 * every].reshape((3, every * lanes)),
        storage[at_s + 3 * every : at_rho].reshape((3, every * lanes)),
        storage[at_rho : at_rho + rows],
        storage[at_rho + rows : at_rho + 2 * rows],
        storage[at_rho + 2 * rows :],
    )


@inner
def spread(values, every):  # type: ignore[no-untyped-def]
    """The same values (L,) for every web or cone."""
    lanes = values.size
    for k in range(every.size // lanes):
        for t in range(lanes):
            every[k * lanes + t] = values[t]


@inner
def add_products(first, second, total):  # type: ignore[no-untyped-def]
    lanes = total.size
    for k in range(first.size // lanes):
        for t in range(lanes):
            total[t] += first[k * lanes + t] * second[k * lanes + t]


@inner
def raise_to_size(values, largest):  # type: ignore[no-untyped-def]
    lanes = largest.size
    for k in range(values.size // lanes):
        for t in range(lanes):
            largest[t] = max(largest[t], abs(values[k * lanes + t]))


@inner
def move(step, change, value):  # type: ignore[no-untyped-def]
    for k in range(value.size):
        value[k] += step[k] * change[k]


@inner
def product(factor, first, second, result):  # type: ignore[no-untyped-def]
    for k in range(result.size):
        result[k] = factor[k] * first[k] * second[k]
