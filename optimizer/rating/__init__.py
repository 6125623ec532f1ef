"""The thermal design of a compressor of any number of stages: sizes, pressures, loads, powers.

Pure functions of plain numbers in SI units, one group of formulas a file, numbered (1-1) to (1-32) as in chapter 1 of
the design calculation of the 2D12:

p1, p2   pressure before and after a stage, absolute [Pa]; eps = p2/p1
T1, T2   temperature before and after a stage [K]
k, n, m  exponents: isentropic, of the compression, of the re-expansion
lam_*    delivery coefficients: volumetric, pressure, temperature, leakage, and their product lam_d
mu_d     what condensation leaves of the flow; mu_0 what side flows make of it
V_h      volume swept in one turn by a stage [m^3]; a prime marks what is built
"""
