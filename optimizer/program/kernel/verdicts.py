"""What may be claimed of N answers, compiled: :mod:`optimizer.program.verdict`, which says what is meant."""

import numpy as np

from optimizer.program.kernel.compiling import folded, in_place


@folded
def smaller(first, second):  # type: ignore[no-untyped-def]
    """The smaller of two numbers; of what is none that."""
    return first if first < second or first != first else second


@folded
def share_of(gap, yardstick):  # type: ignore[no-untyped-def]
    """Gap over yardstick; where the yardstick is 0 any gap is infinitely large, and no gap is none."""
    if yardstick > 0.0:
        return gap / yardstick
    return np.inf if gap > 0.0 else 0.0


@in_place
def verdicts(  # type: ignore[no-untyped-def]
    value,
    bound,
    rounding,
    yardstick,
    excess,
    mass,
    resolution,
    mass_bound,
    of_mass,
    contradicted,
    most,
    most_excess,
    most_mass,
    mass_rounding,
    proven,
    figures,
    outcome,
):
    """Judge N answers of G goals, and the largest of their outcomes.

    Parameters
    ----------
    value, bound, rounding, yardstick : (N, G) of the goals; the third is of the first.
    excess, mass, resolution, mass_bound : (N,) largest over a ceiling; mass, its resolution, its lower bound.
    of_mass : whether the last is one.
    contradicted : whether another bound is above its value.
    most, most_excess, most_mass, mass_rounding : tolerances of the relative gap, of the excess, of the relative gap of
        the mass, and of a mass for its rounding.
    proven : (2, N, G) lower bounds and gaps, to be written to, as all that follows.
    figures : (4, N) largest relative gap, lower bound of the mass, its relative gap, its yardstick.
    outcome : (N,) 0 optimal, 1 not light, 2 not close, 3 above the ceilings, 4 contradicted: the largest that is so.
    """
    worst = 0
    for n in range(outcome.size):
        # of several goals the bound is a corner below which nothing is in all of them
        false, relative = True, 0.0
        for g in range(value.shape[1]):
            over = bound[n, g] - value[n, g]
            false = false and over > rounding[n, g]
            proven[0, n, g] = smaller(bound[n, g], value[n, g])
            proven[1, n, g] = 0.0 if over >= 0.0 else -over
            share = share_of(proven[1, n, g], yardstick[n, g])
            relative = share if g == 0 or share > relative or share != share else relative
        false = false or contradicted
        feasible, light = excess[n] <= most_excess, True
        figures[1, n], figures[2, n], figures[3, n] = 0.0, 0.0, -smaller(-mass[n], -resolution[n])
        if of_mass:
            # the bound is of what keeps the ceilings
            false = false or (feasible and mass_bound[n] > mass[n] * (1.0 + mass_rounding))
            figures[1, n] = smaller(mass_bound[n], mass[n])
            figures[2, n] = share_of(mass[n] - figures[1, n], figures[3, n])
            light = figures[2, n] <= most_mass
        close = relative <= most
        outcome[n] = 4 if false else 3 if not feasible else 2 if not close else 0 if light else 1
        worst = max(worst, outcome[n])
        if false or not np.isfinite(relative):
            proven[0, n], proven[1, n], relative = np.nan, np.nan, np.nan
        if false:
            figures[1, n], figures[2, n] = np.nan, np.nan
        figures[0, n] = relative
    return worst
