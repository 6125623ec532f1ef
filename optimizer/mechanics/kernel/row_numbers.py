"""Column numbers of a row's data: of functions, of its cranks, and of every lane."""

import numpy as np

#: functions of one row; as numpy's integers, for each Python literal that is handed on is a type of its own, for which
#: all that takes it is compiled anew. The first are what readings are made of, and after them the pressures
INERTIA, COS, SIN, TURNING, OUTWARD, SECANT = np.arange(6)
FUNCTIONS = 6
SIN_2, SIN_SQUARED, COS_2, COS_4, SIN_4, UPRIGHT, COS_BETA = np.arange(FUNCTIONS, FUNCTIONS + 7)
HEAD_TRAVEL, CRANK_TRAVEL, VOLUME, A, B, C = np.arange(FUNCTIONS + 7, FUNCTIONS + 13)
PRESSURES = FUNCTIONS + 13
#: where cranks stand: at the angle that says which process counts, at the place or the first end of the interval, and
#: at its other end
INSIDE, FIRST, LAST = np.arange(3)
SINE, COSINE, RISE, FALL = np.arange(4)
#: cos and sin of a multiple of the angle: of the place or the middles of their ranges, and at both ends of the interval
COS_AT, SIN_AT, COS_OFF, SIN_OFF, COS_FIRST, SIN_FIRST, COS_LAST, SIN_LAST = np.arange(8)
#: numbers of every lane
RATIO, SHORT, SQUARE, ZERO, UNIT, ROOT, OVER_ROOT, OVER_CUBE, OVER, F, G, H = np.arange(12)
OWN, WITHIN = np.arange(12, 14)
NUMBERS = 14
#: of the process in which a chamber is: first pressure [Pa], exponent, clearance and first volume over crank radius
#: times area
START, EXPONENT, CLEAR, FULL = np.arange(4)
