"""Mean torque, powers, fluctuation energy and flywheel of whole answers."""

from collections.abc import Iterator

from optimizer.analyze import analyze
from schemas.request.requests import AnalyzeRequest
from tests.hard_effects.case import ALGEBRAIC, Case, Finding, error
from tests.hard_effects.exact import mp
from tests.hard_effects.exact_turn import Machine
from tests.hard_effects.machines import MACHINES, Hard


def _measure(hard: Hard) -> Iterator[Finding]:
    body = {**hard.body, "flywheel": {"irregularity": 0.02}}
    request = {"machine": body, "outputs": ["torque", "gas", "flywheel"], "angles": {"step_deg": 60}}
    answer = analyze(AnalyzeRequest.model_validate(request))
    exact = Machine(body)
    size, omega = exact.size, exact.rows[0].omega
    chambers = [c for row in exact.rows for c in row.chambers]
    work = [c.work if c.closed else mp.mpf(0) for c in chambers]
    got = [c.indicated_work_J for row in answer.gas.rows for c in row.chambers]
    # the work of compression, of which delivery is a part: small where the pressures are nearly equal
    natural = max((abs(share) for share in work), default=mp.mpf(0))
    yield Finding("indicated work", error(got, work, natural), ALGEBRAIC * hard.condition)
    mean_size = size / (2 * mp.pi)
    torque = answer.torque
    demanded = ALGEBRAIC * hard.condition
    yield Finding("mean torque", error(torque.mean_torque_Nm, exact.mean, mean_size), demanded)
    rows = [row.mean_torque_Nm for row in torque.rows]
    yield Finding("mean torque of a row", error(rows, exact.row_means, mean_size), demanded)
    yield Finding("shaft power", error(torque.shaft_power_W, exact.mean * omega, mean_size * omega), demanded)
    friction = (exact.mean - sum(work) / (2 * mp.pi)) * omega
    yield Finding("friction power", error(torque.friction_power_W, friction), ALGEBRAIC * max(hard.condition, 1))
    energy = exact.fluctuation
    yield Finding("fluctuation energy", error(torque.fluctuation_energy_J, energy, size), demanded)
    inertia = energy / (mp.mpf(0.02) * omega**2)
    extent = size / (mp.mpf(0.02) * omega**2)
    yield Finding("flywheel inertia", error(answer.flywheel.inertia_J_kg_m2, inertia, extent), demanded)


CASES = tuple(Case("turn", hard.name, hard.why, lambda hard=hard: _measure(hard)) for hard in MACHINES)
