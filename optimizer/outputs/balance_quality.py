"""Balance quality of the shaft: the grade reached by what deviates from its design unbalance."""

import numpy as np

from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.angles import angle_deg
from optimizer.mechanics.balance_quality import in_planes, permissible_unbalance, plane_shares
from optimizer.mechanics.inertia import Wrench, counterweights
from optimizer.numerics.arrays import Complex
from schemas.machine.balance_quality import BalanceQuality, GradeReached, Grading, PlaneUnbalance


def balance_quality(scene: Prepared, unbalance: Complex | None) -> GradeReached | None:
    """Of one machine, without and with counterweights (webs,) kg m; None for a machine without a grade."""
    quality = scene.machine.balance_quality
    if quality is None:
        return None
    # of the crankshaft alone: balance shafts are rotors of their own
    shaft = scene.simulated.first_order
    fitted = None if unbalance is None else shaft.plus(counterweights(scene.layout, unbalance))
    return GradeReached(
        permissible_kg_m=float(_permissible(scene, quality)),
        before=_grading(scene, quality, shaft),
        after=None if fitted is None else _grading(scene, quality, fitted),
    )


def _permissible(scene: Prepared, quality: BalanceQuality) -> float:
    """kg m."""
    return float(permissible_unbalance(1e-3 * quality.grade_mm_s, quality.mass_kg, scene.layout.omega))


def _grading(scene: Prepared, quality: BalanceQuality, wrench: Wrench) -> Grading:
    """Of the first order over omega^2 that turns with the shaft, half of every reciprocating mass with its crank."""
    plane = float(scene.layout.reference_plane)
    places = (quality.plane_a_m, quality.plane_b_m)
    result = in_planes(wrench.force.co, wrench.moment.co, *(place - plane for place in places))
    shares = plane_shares(quality.centre_of_mass_m, *places)
    permissible = [float(share) * _permissible(scene, quality) for share in shares]
    sizes = [float(np.abs(phasor)) for phasor in result]
    first, second = (
        PlaneUnbalance(
            position_m=place, permissible_kg_m=most, unbalance_kg_m=size, angle_deg=float(angle_deg(np.asarray(phasor)))
        )
        for place, most, size, phasor in zip(places, permissible, sizes, result, strict=True)
    )
    reached = max(size / most for size, most in zip(sizes, permissible, strict=True))
    return Grading(grade_mm_s=quality.grade_mm_s * reached, plane_a=first, plane_b=second)
