"""Arrays, compiled loops, circles, polynomials: what any of the rooms above counts with."""
