"""How the second stage follows the first, for both interior points."""

#: of the share above the optimum, and of the gap of the first stage, what the least mass does not use
RESERVE, OPEN = 1e-5, 4.0
#: product of slack and multiplier, in units of the mass, at which the least mass starts
CENTRALITY = 5e-3
#: programs whose states are kept between the stages
BLOCK = 1024
