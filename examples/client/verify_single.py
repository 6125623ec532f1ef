"""The answer to one request, whatever it asks for: first what every answer says, then what is proven of this one."""

from __future__ import annotations

from verify_answer import Fitted, after, before, fitted, gaps
from verify_bearings import curves
from verify_claims import Claims, covered, same
from verify_first import infeasible, optimum
from verify_form import form, outputs
from verify_machine import Machine
from verify_numbers import ONE, Place
from verify_outputs import dynamics
from verify_pin_loads import of_scroll
from verify_shaking import shaking
from verify_stages import stages
from verify_turn import looks_at_the_turn, over_turn, unreachable


def single(request: Place, answer: Place, whole: bool = True) -> Claims:
    """Every claim of an answer with its counterweights, or of the proof that there are none.

    ``whole``: whether it has all its fields, as rows of a sweep have not.
    """
    if whole:
        yield from form(answer)
        yield from outputs(request, answer)
    design = request / "machine"
    status = (answer / "status").text("optimal", "inaccurate", "infeasible")
    machine = Machine(design, request / "objective", answer / "reference_plane_m", design / "max_total_mass_kg")
    yield from before(request, machine, answer)
    turn = looks_at_the_turn(request)
    if status == "infeasible":
        yield from _nothing(answer)
        budget, why = design / "max_total_mass_kg", answer / "infeasibility"
        yield from covered(shaking(request, machine, answer, None))
        yield from covered(stages(request, machine, answer, None))
        yield from covered(of_scroll(request, answer))
        yield from covered(curves(request, machine, answer, None))
        yield from covered(dynamics(request, machine, answer, None))
        yield from covered((unreachable if turn else infeasible)(request, answer, budget, why))
        return
    yield "status", answer / "infeasibility", -ONE if answer / "infeasibility" else ONE, ONE
    there: Fitted = yield from fitted(request, machine, answer / "counterweights", answer / "balance_shafts", whole)
    yield from after(request, machine, answer, there)
    yield from covered(shaking(request, machine, answer, there))
    yield from covered(stages(request, machine, answer, there))
    yield from covered(of_scroll(request, answer))
    yield from covered(curves(request, machine, answer, there))
    yield from covered(dynamics(request, machine, answer, there))
    mass = there.mass + there.on_shafts_mass if there.on_shafts else there.mass
    yield from gaps(request, answer, mass)
    yield from covered((over_turn if turn else optimum)(request, answer, machine, there))


def _nothing(answer: Place) -> Claims:
    """An answer that is infeasible has no counterweights, no certificate, and a reason."""
    for field in ("total_mass_kg", "certificate", "sensitivity", "worst_case"):
        yield same("status", answer / field, None)
    for field in ("counterweights", "shadow_prices", "balance_shafts", "active_limits"):
        yield "status", answer / field, -ONE if list(answer / field) else ONE, ONE
    figures = answer / "residual" / "after"
    yield "status", figures, -ONE if figures else ONE, ONE
    why = answer / "infeasibility"
    yield "status", answer / "status", ONE if why else -ONE, ONE
