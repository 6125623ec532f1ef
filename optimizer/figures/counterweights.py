"""Counterweights as masses and angles."""

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.mechanics.angles import angle_deg, direction
from optimizer.mechanics.layout import stacked
from schemas.answers import Counterweight, WebLimit
from schemas.machine import Machine, Web
from schemas.requests import AnalyzeRequest

#: a limit counts as touched when the counterweight is nearer than this share of it; optima may differ by
#: 1e-6 of the objective, which is more than that of a mass
_TOUCHED = 1e-4


def masses_and_angles(unbalance: Complex, radius: Real) -> tuple[Real, Real]:
    """Masses [kg] and angles [deg] of unbalances [kg m] (..., K)."""
    return np.abs(unbalance) / radius, angle_deg(unbalance)


def unbalance(mass_kg: Real, angles_deg: Real, radius: Real) -> Complex:
    """Unbalances m R e^{ja} [kg m] of masses and angles (..., K): what every figure is evaluated from."""
    return mass_kg * radius * direction(angles_deg)


def as_given(request: AnalyzeRequest) -> tuple[Real, Real]:
    """Masses (..., K) [kg] and angles (..., K) [deg] of the counterweights of a request; 0 where a web has none."""
    given = {counterweight.web: counterweight for counterweight in request.counterweights}
    fitted = [given.get(web.name) for web in request.machine.webs]
    mass = stacked([one.mass_kg if one else 0.0 for one in fitted])
    return mass, np.mod(stacked([one.angle_deg if one else 0.0 for one in fitted]), 360.0)


def counterweights(machine: Machine, mass_kg: Real, angles_deg: Real) -> tuple[Counterweight, ...]:
    """The counterweights of a machine, one for each web."""
    return tuple(
        _counterweight(web, float(mass), float(angle))
        for web, mass, angle in zip(machine.webs, mass_kg, angles_deg, strict=True)
    )


def _counterweight(web: Web, mass: float, angle: float) -> Counterweight:
    vector = complex(unbalance(np.asarray(mass), np.asarray(angle), np.asarray(web.counterweight_radius_m)))
    return Counterweight(
        web=web.name,
        mass_kg=mass,
        angle_deg=angle,
        mass_radius_kg_m=mass * web.counterweight_radius_m,
        x_kg_m=vector.real,
        y_kg_m=vector.imag,
        active_limits=tuple(_touched(web, mass, angle)),
    )


def _touched(web: Web, mass: float, angle: float) -> list[WebLimit]:
    touched: list[WebLimit] = []
    if web.max_mass_kg is not None and mass >= web.max_mass_kg * (1.0 - _TOUCHED):
        touched.append("max_mass")
    if web.sector is not None and mass > 0:
        off = abs((angle - web.sector.centre_deg + 180.0) % 360.0 - 180.0)
        if off >= web.sector.half_angle_deg * (1.0 - _TOUCHED):
            touched.append("sector")
    return touched
