"""Webs of a group: what has to be the same, and how each is turned on its own crank (analytic)."""

from contextlib import suppress
from typing import Any

import numpy as np
import pytest

from optimizer.errors import OutOfRange
from optimizer.formulation.groups import alike_webs
from schemas.machine.reciprocating import ReciprocatingMachine
from tests.optimize.machines import machine, row, throw, web

#: angles of the cranks, and the webs on them
_CRANKS = (20.0, 140.0, 290.0)
#: of webs that say nothing of their own
_CATALOGUE = {"masses_kg": [1.0, 4.0], "angle_step_deg": 15.0}


def _grouped(mirror: bool = False, catalogue: Any = None, **changes: dict[str, Any]) -> ReciprocatingMachine:
    throws = [throw(0.3 * n, angle, [row(90.0, 5.0)]) for n, angle in enumerate(_CRANKS)]
    webs = [web(name, 0.3 * n, 5.0, 0.1, throw=n, **changes.get(name, {})) for n, name in enumerate("abc")]
    webs.append(web("alone", 0.9, 5.0, 0.1))
    groups = [{"name": "g", "webs": ["a", "b", "c"], "mirror": mirror}]
    return ReciprocatingMachine.model_validate(machine(throws, webs, web_groups=groups, catalogue=catalogue))


@pytest.mark.parametrize("mirror", [False, True])
def test_webs_of_a_group_carry_the_same_as_seen_from_their_own_cranks(mirror: bool) -> None:
    webs = alike_webs(_grouped(mirror))
    assert webs is not None
    assert webs.leader == (0, 0, 0, 3)
    assert webs.mirrored == (False, mirror, False, False)
    first = 0.7 * np.exp(1j * np.deg2rad(75.0))
    carried = webs.carried(np.array([first, 2.0]))
    own = [np.rad2deg(np.angle(unbalance)) - crank for unbalance, crank in zip(carried[:3], _CRANKS, strict=True)]
    expected = [55.0, -55.0 if mirror else 55.0, 55.0]
    assert [
        (angle - number + 180.0) % 360.0 - 180.0 for angle, number in zip(own, expected, strict=True)
    ] == pytest.approx([0.0] * 3, abs=1e-9)
    assert np.abs(carried) == pytest.approx([0.7, 0.7, 0.7, 2.0])
    assert np.all((webs.ahead_deg >= 0.0) & (webs.ahead_deg < 360.0))
    # masses and angles are so as well, to the last digit, below a whole turn
    mass, angle = webs.fitted(np.array([3.0, 9.0, 9.0, 1.0]), np.array([75.0, 1.0, 2.0, 40.0]))
    assert mass.tolist() == [3.0, 3.0, 3.0, 1.0]
    assert angle == pytest.approx([75.0, 140.0 + expected[1] if mirror else 195.0, 345.0, 40.0])
    nothing = webs.fitted(np.zeros(4), np.full(4, 33.0))[1]
    assert nothing.tolist() == [0.0] * 4


def test_without_groups_no_webs_are_alike() -> None:
    plain = machine([throw(0.0, 0.0, [])], [web("a", 0.0)])
    assert alike_webs(ReciprocatingMachine.model_validate(plain)) is None


def _refused(mirror: bool = False, **changes: Any) -> list[tuple[str, str]]:
    with suppress(OutOfRange):
        alike_webs(_grouped(mirror, **changes))
        return []
    with pytest.raises(OutOfRange) as refused:
        alike_webs(_grouped(mirror, **changes))
    problems = list(refused.value.problems)
    assert {problem.path[:4] for problem in problems} == {("machine", "web_groups", 0, "webs")}
    return [("abc"[int(problem.path[4])], problem.message) for problem in problems]


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("counterweight_radius_m", 0.11),
        ("max_mass_kg", 6.0),
        ("max_centrifugal_force_N", 100.0),
        ("min_fitted_mass_kg", 1.0),
    ],
)
def test_webs_of_a_group_are_equal_castings(field: str, value: float) -> None:
    ((web_, message),) = _refused(b={field: value})
    assert web_ == "b"
    assert message == f"webs of a group are equal castings: its {field} must equal that of a"


def _sector(centre: float, half: float = 30.0) -> dict[str, Any]:
    return {"sector": {"centre_deg": centre, "half_angle_deg": half}}


@pytest.mark.parametrize(
    ("mirror", "sectors", "unlike"),
    [
        # each 55 degrees ahead of its own crank
        (False, (75.0, 195.0, 345.0), ""),
        (False, (75.0, 195.0 + 720.0, 345.0 - 360.0), ""),
        (False, (75.0, 195.0 + 1e-8, 345.0), "b"),
        (False, (75.0, 195.0 + 1e-10, 345.0), ""),
        (False, (75.0, 85.0, 345.0), "b"),
        # the second as far behind
        (True, (75.0, 85.0, 345.0), ""),
        (True, (75.0, 195.0, 345.0), "b"),
        (True, (75.0, 85.0, 235.0), "c"),
    ],
)
def test_sectors_of_a_group_are_the_same_from_their_own_cranks(
    mirror: bool, sectors: tuple[float, ...], unlike: str
) -> None:
    refusal = _refused(mirror, **{name: _sector(at) for name, at in zip("abc", sectors, strict=True)})
    assert "".join(name for name, _ in refusal) == unlike
    assert all("sector, counted from the own crank," in message for _, message in refusal)
    wider = _refused(mirror, a=_sector(75.0), b=_sector(85.0 if mirror else 195.0, 31.0), c=_sector(345.0))
    assert [name for name, _ in wider] == ["b"]
    missing = _refused(mirror, a=_sector(75.0), b=_sector(85.0 if mirror else 195.0))
    assert [name for name, _ in missing] == ["c"]


@pytest.mark.parametrize(
    ("mirror", "holes", "unlike"),
    [
        (False, ([25.0, 75.0], [145.0, 195.0], [295.0, 345.0]), ""),
        (False, ([25.0, 75.0], [195.0, 145.0], [345.0, 655.0]), ""),
        (False, ([25.0, 75.0], [145.0, 196.0], [295.0, 345.0]), "b"),
        (False, ([25.0, 75.0], [145.0], [295.0, 345.0]), "b"),
        (True, ([25.0, 75.0], [135.0, 85.0], [295.0, 345.0]), ""),
        (True, ([25.0, 75.0], [145.0, 195.0], [295.0, 345.0]), "b"),
    ],
)
def test_holes_of_a_group_are_the_same_from_their_own_cranks(
    mirror: bool, holes: tuple[list[float], ...], unlike: str
) -> None:
    of_webs = {name: {"hole_angles_deg": hole} for name, hole in zip("abc", holes, strict=True)}
    refusal = _refused(mirror, catalogue=_CATALOGUE, **of_webs)
    assert "".join(name for name, _ in refusal) == unlike
    assert all("hole_angles_deg, counted from the own crank," in message for _, message in refusal)


def test_masses_of_a_group_are_the_same_in_any_order() -> None:
    def masses(*arguments: list[float]) -> dict[str, Any]:
        of_webs = {name: {"catalogue_masses_kg": argument} for name, argument in zip("abc", arguments, strict=True)}
        return {"catalogue": _CATALOGUE, **of_webs}

    assert _refused(**masses([1.0, 2.0], [2.0, 1.0], [1.0, 2.0])) == []
    ((name, message),) = _refused(**masses([1.0, 2.0], [1.0, 2.0], [1.0, 3.0]))
    assert (name, "catalogue_masses_kg must equal" in message) == ("c", True)
    assert [name for name, _ in _refused(**masses([1.0, 2.0], [1.0, 2.0, 3.0], [1.0, 2.0]))] == ["b"]


def test_a_web_of_a_group_belongs_to_a_crank() -> None:
    throws = [throw(0.3 * n, angle, [row(90.0, 5.0)]) for n, angle in enumerate(_CRANKS)]
    webs = [web("a", 0.0, throw=0), web("b", 0.15)]
    groups = [{"name": "g", "webs": ["a", "b"]}]
    with pytest.raises(OutOfRange) as refused:
        alike_webs(ReciprocatingMachine.model_validate(machine(throws, webs, web_groups=groups)))
    (problem,) = refused.value.problems
    assert problem.path == ("machine", "web_groups", 0, "webs", 1)
    assert problem.message == "this web belongs to no crank: name its throw"
