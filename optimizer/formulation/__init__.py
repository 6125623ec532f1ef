"""From machine and objective to the convex program: goals, limits, groups, balance shafts."""
