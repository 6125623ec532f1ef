"""Capacity and powers."""

import math


def suction_flow(swept_volume: float, speed_rpm: float, delivery: float) -> float:
    """V_d' = V'_hI n lam_dI' [m^3/min] at the first suction state, (1-27) and (1-28)."""
    return swept_volume * speed_rpm * delivery


def at_suction(p: float, T: float, p1: float, T1: float) -> float:
    """Volume at the suction state over volume in another state of an ideal gas."""
    return (p / T) * (T1 / p1)


def indicated_power(
    p_s: float, swept_volume: float, volumetric: float, ratio: float, n: float, speed_rpm: float
) -> float:
    """N_i = (n/60) p_s V_h' lam_v (k/(k-1)) (eps^((k-1)/k) - 1) [W], (1-29), with the exponent of the compression."""
    power = (n - 1.0) / n
    # expm1: exact down to the isothermal limit, ln eps
    work = math.expm1(power * math.log(ratio)) / power
    return speed_rpm / 60.0 * p_s * swept_volume * volumetric * work


def shaft_power(indicated: float, mechanical_efficiency: float) -> float:
    """N_z = N_i / eta_m [W], (1-31); table 2-1 of the 2D12's calculation prints the indicated power in its place."""
    return indicated / mechanical_efficiency


def motor_power(shaft: float, margin: float, drive_efficiency: float) -> float:
    """N_e = N_z (1 + margin) / eta_drive [W], (1-32)."""
    return shaft * (1.0 + margin) / drive_efficiency
