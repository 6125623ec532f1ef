"""Balance shafts in a program: what an unbalance v of a shaft that turns n times adds to a response.

It turns as n^2 v e^{jnt}, so that the crankshaft sees order n - 1. In the first order a shaft at -1 adds to what turns
backwards; the lengths there hold the conjugate of that, which is affine in conj(v). The mirror image of v at the x axis
stands for it. About the crankshaft it has the moment Im(conj(p) n^2 v e^{jnt}), p its place x + jy.
"""

from __future__ import annotations

from typing import List, NamedTuple

from verify_machine import Machine, Mass, Web, web_of
from verify_numbers import ONE, ZERO, J, Number, Place, real


class Geared(NamedTuple):
    """A place on a balance shaft, how often it turns, where the shaft is, and whether its mirror image is chosen."""

    web: Web
    ratio: int
    place: Number
    mirrored: bool

    def vector(self, mass: Mass) -> Number:
        """What is chosen, of a counterweight that is there [kg m]."""
        unbalance = mass.product * (mass.co if self.ratio > 0 else mass.counter)
        return unbalance.conjugate() if self.mirrored else unbalance

    def first(self, own: Number, backwards: Number) -> Number:
        """Its share in a length of the first order, of those of what turns forwards and backwards."""
        return own if self.ratio == 1 else backwards if self.ratio == -1 else ZERO

    def on_shaft(self, unit: Number) -> Number:
        """What it is multiplied by where the crankshaft sees it at e^{jt}."""
        return real(self.ratio**2) * power(unit, self.ratio - 1)

    def roll(self, unit: Number) -> Number:
        """The same about the crankshaft; its real part counts."""
        factor = -J * self.place.conjugate() * real(self.ratio**2) * power(unit, self.ratio)
        return factor.conjugate() if self.mirrored else factor


def geared(design: Place, machine: Machine, mirrored: bool) -> List[Geared]:
    """All places of the balance shafts; those at -1 ``mirrored`` where the first order counts."""
    places = []
    for shaft in design / "balance_shafts":
        ratio = (shaft / "speed_ratio").whole()
        place = (shaft / "x_m").number(0.0) + J * (shaft / "y_m").number(0.0)
        for entry in shaft / "webs":
            web, back = web_of(entry, machine.fastest * real(ratio * ratio)), mirrored and ratio == -1
            if back and web.sector is not None:
                web = web._replace(sector=(-web.sector[0], web.sector[1]))
            places.append(Geared(web, ratio, place, back))
    return places


def power(unit: Number, times: int) -> Number:
    """Of a unit vector."""
    result = ONE
    for _ in range(abs(times)):
        result = result * (unit if times > 0 else unit.conjugate())
    return result
