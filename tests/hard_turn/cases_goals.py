"""Hard cases by what is asked: weights, goals in their order, ceilings."""

import math
from collections.abc import Iterator
from itertools import permutations

from tests.hard_turn import machines
from tests.hard_turn.case import BEARINGS, BENDING, Case, case
from tests.hard_turn.machines import Body


def goals() -> Iterator[Case]:
    """Gaps asked for, combinations, all orders."""
    for gap in (1.0, 1e-2, 1e-8):
        for name in ("three", "six", "vee"):
            machine = (machines.SMALL | machines.MEDIUM)[name](gas=True)
            yield case(f"asked/gap-{gap:g}-{name}", "loose or sharp", machine, BEARINGS, gap=gap)
    for name in ("single", "twin", "four", "six", "vee", "sixteen"):
        machine = (machines.SMALL | machines.MEDIUM | machines.LARGE)[name](gas=True)
        yield case(f"asked/all-orders-{name}", "force and moment of all orders", machine, {"orders": "all"})
        yield case(f"asked/all-orders-max-{name}", "the larger of them", machine, {"orders": "all", "combine": "max"})
        together = {"bearing_weight": 1, "bending_weight": 2, "orders": "all"}
        yield case(f"asked/everything-{name}", "four groups", machine, together)
        yield case(f"asked/everything-max-{name}", "one group of all", machine, together | {"combine": "max"})
        wide = {"bearing_weight": 1e-8, "bending_weight": 1e8}
        yield case(f"asked/weights-{name}", "weights sixteen decades apart", machine, wide)
        yield case(f"asked/heavy-{name}", "without the least mass", machine, BEARINGS | {"least_mass": False})


def priorities() -> Iterator[Case]:
    """Goals in every order, with allowances from nothing to everything."""
    goals = ("external", "bearings", "bending")
    weights = {"bearing_weight": 1, "bending_weight": 1}
    for name in ("three", "vee"):
        machine = (machines.SMALL | machines.MEDIUM)[name](gas=True)
        for order in permutations(goals):
            for allowance in (0.0, 1e-3, 1.0):
                named = [{"goal": goal, "allowance": allowance} for goal in order]
                called = f"priorities/{name}-{'-'.join(goal[:4] for goal in order)}-{allowance:g}"
                yield case(called, "a goal under two others", machine, weights | {"priorities": named})
    for order in permutations(("external", "bearings")):
        for measure in ("rms", "specific"):
            named = [{"goal": goal, "allowance": 1e-6} for goal in order] + [{"goal": "mass"}]
            objective = {"bearing_weight": 1, "bearing_measure": measure, "priorities": named, "orders": "all"}
            called = f"priorities/six-{'-'.join(goal[:4] for goal in order)}-{measure}"
            yield case(called, "the mass has the last word", machines.six(gas=True), objective)


#: of machines whose floors are known in closed form: one throw of infinite rod, m r = 1 rotating and reciprocating
def _unit(webs: float = 9.0) -> Body:
    rod = {"length_m": None, "mass_kg": 0.0, "reciprocating_share": 0.3}
    row = {"axis_deg": 0, "reciprocating_mass_kg": 1.0, "connecting_rod": rod}
    throw = {"position_m": 0.0, "crank_radius_m": 1.0, "crank_angle_deg": 0, "rotating_mass_kg": 1.0, "rows": [row]}
    places = (("a", -0.5), ("b", 0.5))
    return {
        "kind": "reciprocating",
        "speed_rpm": 30.0 / math.pi,
        "throws": [throw],
        "webs": [{"name": n, "position_m": z, "counterweight_radius_m": 1.0, "max_mass_kg": webs} for n, z in places],
        "bearings": [{"name": n, "position_m": z, "diameter_m": 1.0, "length_m": 1.0} for n, z in places],
    }


def ceilings() -> Iterator[Case]:
    """Ceilings below, at and above the floors: a quarter on each bearing, an eighth in the middle of the shaft."""
    for field, floor in (
        ("bearing_ceiling_N", 0.25),
        ("specific_load_ceiling_Pa", 0.25),
        ("bending_ceiling_Nm", 0.125),
    ):
        for share, expected in (
            (0.0, "infeasible"),
            (0.5, "infeasible"),
            (1 - 1e-3, "infeasible"),
            (1 - 1e-6, "infeasible"),
            (1 - 1e-9, "said"),
            (1.0, "said"),
            (1 + 1e-9, "said"),
            (1 + 1e-6, "optimal"),
            (1 + 1e-3, "optimal"),
            (2.0, "optimal"),
            (1e6, "optimal"),
        ):
            for goal, objective in (("external", {}), ("none", {"moment_weight": 1e-6})):
                if field == "bending_ceiling_Nm":
                    # the webs are in the planes of the bearings: nothing they do bends the shaft
                    body = _unit()
                    for web in body["webs"]:
                        web["position_m"] = 0.0
                else:
                    body = _unit()
                called = f"ceilings/{field.split('_')[0]}-{share - 1:+.0e}-{goal}"
                why = "at the floor nothing is left to choose"
                yield case(called, why, body, objective | {field: floor * share}, expected=expected)
    for name in ("three", "six", "vee"):
        machine = (machines.SMALL | machines.MEDIUM)[name](gas=True)
        for load in (5e3, 1.2e4, 2e4, 5e4):
            yield case(
                f"ceilings/{name}-load-{load:g}",
                "any side of the floor",
                machine,
                {"bearing_ceiling_N": load},
                expected="said",
            )
            both = {
                "bearing_ceiling_N": load,
                "bending_ceiling_Nm": load * 0.03,
                "orders": "all",
                "force_ceiling_N": load,
            }
            yield case(f"ceilings/{name}-all-{load:g}", "three kinds at once", machine, both, expected="said")
            turn = BENDING | {"bearing_ceiling_N": load, "least_mass": False}
            yield case(
                f"ceilings/{name}-bend-{load:g}", "one goal under the other's ceiling", machine, turn, expected="said"
            )
    body = machines.three(gas=True)
    two = {"bearing_ceiling_N": 3e4, "specific_load_ceiling_Pa": 3e4 / 0.0012}
    yield case("ceilings/twice", "the same ceiling by two names", body, two, expected="said")
    named = [{"goal": "external"}, {"goal": "bearings"}]
    yield case(
        "ceilings/priorities",
        "goals in order under ceilings",
        body,
        {"bearing_weight": 1, "bending_ceiling_Nm": 2e3, "priorities": named},
        expected="said",
    )
