"""The convex program: statement, optima, certificate, verdict. Knows nothing of machines.

The way in is :func:`optimizer.program.methods.optima.optima`; which method is tried when stands in ``cascade.py``.

Notation, used in every file of this package (docs/mathematics.md):

u_k      unbalance m R e^{ja} of the counterweight on web k, complex [kg m]
a_j(u)   = c_j + sum_k H_jk u_k, the norm terms of the objective
P_r(u)   = floor_r + sum of |a_j(u)| over the terms of row r
P(u)     = max_r P_r(u), the objective; a sum of peaks is a single row
y, lam   multipliers: |y_j| <= 1, lam >= 0 with sum 1
"""
