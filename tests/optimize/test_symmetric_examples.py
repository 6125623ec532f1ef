"""Equal webs in equal places get equal weights, on every example that is symmetric."""

import json
from pathlib import Path

import numpy as np
import pytest

from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.requests import OptimizeRequest
from tests.verification.checking import optimized

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.json"))
#: of the largest mass: by which equal weights may differ
_EQUAL = 1e-9


def pairs(machine: ReciprocatingMachine) -> list[tuple[int, int]]:
    """Webs that any symmetry of the first order from end to end exchanges; analytic, by the phasors with the shaft."""
    webs, throws = machine.webs, machine.throws
    planes = [throw.position_m for throw in throws]
    centre = 0.5 * (min(planes) + max(planes)) if machine.reference_plane_m is None else machine.reference_plane_m
    force = couple = 0j
    for throw in throws:
        crank = throw.crank_radius_m * np.exp(1j * np.radians(throw.crank_angle_deg))
        force += throw.rotating_mass_kg * crank
        couple += (throw.position_m - centre) * throw.rotating_mass_kg * crank
        for row in throw.rows:
            mass = 0.5 * row.reciprocating_kg + row.rotating_kg
            force += mass * crank
            couple += (throw.position_m + row.offset_m - centre) * mass * crank
    size = max(abs(force), abs(couple) / max(np.ptp(planes), 0.1), 1e-9)
    arm = max(abs(web.position_m - centre) for web in webs) or 1.0
    # from end to end a turn by g, or a mirror image: g f = f and g c = -c, or g conj(f) = f and g conj(c) = -c
    turns = [(1.0, False), (-1.0, False)]
    for vector, sign in ((force, 1.0), (couple, -1.0)):
        if abs(vector) > 1e-9 * size:
            turns.append((sign * vector / np.conj(vector), True))
    for turn, mirrored in turns:
        at, of = (np.conj(phasor) if mirrored else phasor for phasor in (force, couple))
        if abs(turn * at - force) <= 1e-9 * size and abs(turn * of + couple) <= 1e-9 * size * arm:
            break
    else:
        return []
    values = []
    for k, web in enumerate(webs):
        entries = [
            n
            for n, plane in enumerate(webs)
            if abs(plane.position_m + web.position_m - 2 * centre) <= 1e-9 * arm
            and (plane.counterweight_radius_m, plane.max_mass_kg) == (web.counterweight_radius_m, web.max_mass_kg)
        ]
        if len(entries) != 1:
            return []
        values.append((k, entries[0]))
    return values


def symmetric() -> list[Path]:
    """Examples whose webs have such pairs and whose answer is about the first order of one machine."""
    paths = []
    for path in EXAMPLES:
        request = OptimizeRequest.model_validate_json(path.read_bytes())
        machine, goal = request.machine, request.objective
        plain = isinstance(machine, ReciprocatingMachine) and machine.webs and not machine.balance_shafts
        chosen = any(web.envelope or web.fixed or web.sector for web in machine.webs) or machine.discrete
        if not plain or chosen or goal.over_the_turn or request.robust or machine.unbalances:
            continue
        assert isinstance(machine, ReciprocatingMachine)
        if any(k != n for k, n in pairs(machine)):
            paths.append(path)
    return paths


SYMMETRIC = symmetric()


def test_there_are_some() -> None:
    assert len(SYMMETRIC) >= 5, [path.stem for path in SYMMETRIC]


@pytest.mark.parametrize("path", SYMMETRIC, ids=[path.stem for path in SYMMETRIC])
def test_equal_webs_get_equal_weights(path: Path) -> None:
    body = json.loads(path.read_bytes())
    answer = optimized({name: body[name] for name in ("machine", "objective", "accuracy") if name in body})
    masses = [counterweight.mass_kg for counterweight in answer.counterweights]
    machine = OptimizeRequest.model_validate(body).machine
    assert isinstance(machine, ReciprocatingMachine)
    for k, count in pairs(machine):
        assert abs(masses[k] - masses[count]) <= _EQUAL * max(masses), path.stem
