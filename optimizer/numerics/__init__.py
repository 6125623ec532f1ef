"""Arrays, compiled loops, circles, polynomials: the tools of all rooms above."""
