"""Saturated steam, and what its condensation between the stages leaves of the flow."""

import math
from collections.abc import Sequence

#: IAPWS R7-97(2012), table 34: coefficients of the equation of the saturation line
_N = (
    0.11670521452767e4,
    -0.72421316703206e6,
    -0.17073846940092e2,
    0.12020824702470e5,
    -0.32325550322333e7,
    0.14915108613530e2,
    -0.48232657361591e4,
    0.40511340542057e6,
    -0.23855557567849,
    0.65017534844798e3,
)


def saturation_pressure(temperature: float) -> float:
    """Pressure [Pa] of saturated steam at a temperature [K] from 273.15 to 647.096.

    IAPWS Industrial Formulation 1997, region 4, equation (30): closed form. It stands in for table 1-6 of the 2D12's
    calculation, which has misprints.
    """
    theta = temperature + _N[8] / (temperature - _N[9])
    a = theta**2 + _N[0] * theta + _N[1]
    b = _N[2] * theta**2 + _N[3] * theta + _N[4]
    c = _N[5] * theta**2 + _N[6] * theta + _N[7]
    return 1e6 * (2.0 * c / (-b + math.sqrt(b**2 - 4.0 * a * c))) ** 4


def condensate_coefficients(
    humidity: float, suction_pressures: Sequence[float], saturation_pressures: Sequence[float]
) -> list[float]:
    """mu_d of every stage, (1-7): moles that reach it over moles that enter the first.

    With w moles of vapour on a mole of dry gas, a cooler leaves at most w = p_s/(p - p_s). Where it condenses any,
    that is where phi p_s1 p/p1 > p_s, this is (1-7): mu_d = (p1 - phi p_s1)/(p - p_s) p/p1; where it does not, the
    gas keeps what the coolers before have left in it.

    Parameters
    ----------
    humidity : phi of the gas before the first stage, 0 to 1; phi p_s1 must be below p1.
    suction_pressures : p1 of every stage [Pa].
    saturation_pressures : p_s at the suction temperature of every stage [Pa].
    """
    vapour = humidity * saturation_pressures[0]
    entering = left = vapour / (suction_pressures[0] - vapour)
    results = [1.0]
    for p, p_s in zip(suction_pressures[1:], saturation_pressures[1:], strict=True):
        if p_s < p:
            left = min(left, p_s / (p - p_s))
        results.append((1.0 + left) / (1.0 + entering))
    return results
