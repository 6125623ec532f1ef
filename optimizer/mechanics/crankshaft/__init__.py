"""A crankshaft as the faces and bodies of any CAD show it: axis, frame, throws, webs, bearings, unbalance.

Plain geometry in the metres of the request: n faces are arrays (n, 3) of points and directions until the frame of the
shaft is determined. In that frame a round face about a line along the shaft is a stretch from z to z.
"""
