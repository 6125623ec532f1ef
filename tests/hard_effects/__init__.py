"""Errors of everything but the optimum: forces, torque integrals and pin loads against 50-digit evaluations."""
