"""Many problems: sweeps, fronts, matching, and what accuracy costs."""
