"""Where the stages of the interior point start, compiled, lane by lane."""

import numpy as np

from optimizer.program.kernel.compiling import inner
from optimizer.program.kernel.stages import CENTRALITY


@inner
def start(batch, state, t):  # type: ignore[no-untyped-def]
    """Lane t to a point inside all limits, and above all norms; ceilings may be violated."""
    rows, lanes = batch.floor.shape
    cones, terms, webs = batch.influence.shape[0], batch.row.size, batch.sine.size // lanes
    full = 0.0
    for k in range(t, webs * lanes, lanes):
        full += batch.budget[k]
    x = 0.5 if full <= 1.0 else 0.5 / full
    for k in range(t, webs * lanes, lanes):
        a = batch.present[1, k] * 0.5 * x
        state.v[0, k], state.v[1, k], state.v[2, k] = x, a, 0.0
        state.s[0, k], state.s[1, k], state.s[2, k] = x, a, 0.0
        state.z[0, k], state.z[1, k], state.z[2, k] = 1.0, 0.0, 0.0
        state.q[0, k], state.zq[0, k] = 1.0 - x, 1.0
        for c in range(1, 3):
            state.q[c, k] = a if batch.present[1, k] > 0.0 else 1.0
            state.zq[c, k] = batch.present[1, k]
    state.rest[0, t], state.rest[1, t] = 1.0 - full * x, 1.0
    for r in range(rows):
        state.rho[r, t], state.z_rho[r, t] = batch.floor[r, t], 1.0 / rows
    for i in range(cones):
        at, j = i * lanes + t, (webs + i) * lanes + t
        ax, ay = batch.constant[0, at], batch.constant[1, at]
        for k in range(t, webs * lanes, lanes):
            ax += batch.influence[i, k] * batch.centre[0, k] * state.v[1, k]
            ay += batch.influence[i, k] * batch.centre[1, k] * state.v[1, k]
        size = np.sqrt(ax * ax + ay * ay) + 0.5
        if i >= terms:
            size = max(size, batch.cap[i - terms, t])
        else:
            state.rho[batch.row[i], t] += size
        state.s[0, j], state.s[1, j], state.s[2, j] = size, ax, ay
        state.z[0, j], state.z[1, j], state.z[2, j] = 1.0 / rows, 0.0, 0.0
    level = state.rho[0, t]
    for r in range(rows):
        level = max(level, state.rho[r, t])
    state.rest[2, t] = level + 0.5
    for r in range(rows):
        state.rho[r, t] = state.rest[2, t] - state.rho[r, t]


@inner
def restart(batch, state, t):  # type: ignore[no-untyped-def]
    """Lane t from a point of the first stage to the second: every multiplier at the price of the objective."""
    s, z = state.s, state.z
    lanes, rows = batch.target.size, state.rho.shape[0]
    for r in range(rows):
        slack = max(batch.target[t] - state.rest[2, t] + state.rho[r, t], 0.1 * state.rho[r, t])
        # a peak that all but vanishes grows into the room below the target, or the first steps are next to nothing
        parts = 1.0
        for i in range(batch.row.size):
            parts += 1.0 if batch.row[i] == r else 0.0
        for i in range(batch.row.size):
            if batch.row[i] == r:
                s[0, batch.sine.size + i * lanes + t] += slack / parts
        state.rho[r, t] = slack / parts
    centrality = s[0, t] * z[0, t] + s[1, t] * z[1, t] + s[2, t] * z[2, t]
    price = CENTRALITY / centrality
    if batch.budget[t] > 0.0:
        # the price of the budget becomes that of the mass, which is what the multipliers of the webs stand against
        price = min(price, batch.mass[t] / (batch.budget[t] * state.rest[1, t]))
    for r in range(rows):
        state.z_rho[r, t] *= price
    for c in range(3):
        for j in range(t, z.shape[1], lanes):
            z[c, j] *= price
        for k in range(t, batch.sine.size, lanes):
            state.zq[c, k] *= price
    # the rest of what mass costs is what webs that carry nothing pay
    for k in range(t, batch.sine.size, lanes):
        z[0, k] += max(batch.mass[k] - price * batch.budget[k] * state.rest[1, t], 0.0)
    # the first stage ended with an optimum within the budget, and none that is lighter is beyond it
    state.rest[0, t], state.rest[1, t] = 1.0, centrality * price
    for k in range(t, batch.budget.size, lanes):
        batch.budget[k] = 0.0
