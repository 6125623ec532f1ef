"""What a request can ask for, one feature at a time: each changes a request, and any two go together or are refused.

A feature that a machine has no place for, as a row of a scroll, is not put on it. Where two write the same field the
later one counts; what does not go together is for the schema to say.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import partial

from tests.pairs.machines import at_rest, gas
from tests.pairs.subject import NoPlace, Subject

Feature = Callable[[Subject], None]


def _goal(subject: Subject, **fields: object) -> None:
    subject.objective.update(fields)


def _ceiling(subject: Subject, field: str, share: float) -> None:
    subject.objective[field] = share * at_rest(subject.base)[field]


def _part(subject: Subject, name: str, value: object) -> None:
    subject.body[name] = value


def _accuracy(subject: Subject, **fields: object) -> None:
    subject.body.setdefault("accuracy", {}).update(fields)


def _rotor(subject: Subject, **fields: object) -> None:
    subject.machine.update(fields)


def _shaft(subject: Subject, **fields: object) -> None:
    if "throws" not in subject.machine:
        raise NoPlace
    subject.machine.update(fields)


def _web(subject: Subject, places: slice, fields: Mapping[str, object]) -> None:
    for web in subject.webs[places]:
        web.update(fields)


def _plate(subject: Subject, shape: str) -> None:
    outer = 1.5 * subject.first.get("counterweight_radius_m", 0.1)
    for web in subject.webs[:2]:
        web.pop("counterweight_radius_m", None)
        web.pop("max_mass_kg", None)
        web["envelope"] = {
            "shape": shape,
            "inner_radius_m": 0.2 * outer,
            "outer_radius_m": outer,
            "thickness_m": 0.2 * outer,
        }


def _least(subject: Subject, share: float) -> None:
    for web in subject.webs:
        web["min_fitted_mass_kg"] = share * (web.get("max_mass_kg") or 1.0)


def _steps(subject: Subject) -> None:
    largest = max((web.get("max_mass_kg") or 1.0 for web in subject.webs), default=1.0)
    subject.catalogue.pop("masses_kg", None)
    subject.catalogue.update({"mass_step_kg": largest / 4, "angle_step_deg": 45})


def _masses(subject: Subject) -> None:
    largest = max((web.get("max_mass_kg") or 1.0 for web in subject.webs), default=1.0)
    subject.catalogue.pop("mass_step_kg", None)
    subject.catalogue.update({"masses_kg": [largest / 4, largest / 2, largest], "angle_step_deg": 30})


def _chosen(subject: Subject) -> None:
    """What choices need: masses and angles, where there are none yet."""
    if "masses_kg" not in subject.catalogue and "mass_step_kg" not in subject.catalogue:
        _masses(subject)


def _cheaper(subject: Subject) -> None:
    _chosen(subject)
    subject.body["alternatives"] = [0.02, 0.2]


def _costs(subject: Subject, costs: Sequence[str]) -> None:
    _chosen(subject)
    order = [{"goal": "external", "allowance": 0.05}, *({"goal": cost} for cost in costs)]
    _goal(subject, priorities=order)


def _own_masses(subject: Subject) -> None:
    _chosen(subject)
    largest = subject.first.get("max_mass_kg") or 1.0
    subject.first["catalogue_masses_kg"] = [largest / 3, largest]


def _holes(subject: Subject) -> None:
    _chosen(subject)
    subject.first["hole_angles_deg"] = [150.0, 180.0, 210.0, 240.0]


def _part_numbers(subject: Subject) -> None:
    _chosen(subject)
    subject.catalogue["max_part_numbers"] = 1


def _few(subject: Subject, most: int) -> None:
    _chosen(subject)
    subject.machine["max_counterweights"] = most


def _group(subject: Subject, mirror: bool) -> None:
    names = [web["name"] for web in subject.webs[:2]]
    if len(names) < 2:
        raise NoPlace
    if "throws" in subject.machine:
        # identical castings have one radius and one throw's frame
        subject.webs[1]["throw"] = subject.first["throw"] = 0
    for name in ("counterweight_radius_m", "max_mass_kg"):
        if name in subject.first:
            subject.webs[1][name] = subject.first[name]
    subject.machine["web_groups"] = [{"name": "alike", "webs": names, "mirror": mirror}]


def _loads_of_parts(subject: Subject) -> None:
    _shaft(subject, gravity_deg=250.0, stationary_mass_kg=400.0)
    subject.body["outputs"] = ["residual", "loads"]


def _balance_shafts(subject: Subject, ratio: int, **fields: object) -> None:
    web = {"name": "on the shaft", "position_m": 0.0, "counterweight_radius_m": 0.05, "max_mass_kg": 5.0, **fields}
    shaft = {"name": "balancer", "speed_ratio": ratio, "x_m": 0.1, "y_m": 0.05, "webs": [web]}
    _shaft(subject, balance_shafts=[shaft])


def _fitted(subject: Subject) -> None:
    """What is built beside the optimum: on the first web, and on that of a balance shaft."""
    names = [subject.first["name"], *(shaft["webs"][0]["name"] for shaft in subject.machine.get("balance_shafts", ()))]
    subject.body["fitted"] = [{"web": name, "mass_kg": 0.2, "angle_deg": 175.0} for name in names]


def _budget(subject: Subject, share: float) -> None:
    largest = sum(web.get("max_mass_kg") or 1.0 for web in subject.webs)
    subject.machine["max_total_mass_kg"] = share * largest


def _overspeed(subject: Subject) -> None:
    speed = 1.2 * subject.machine["speed_rpm"]
    subject.machine["overspeed_rpm"] = speed
    web = subject.first
    force = 0.4 * (web.get("max_mass_kg") or 1.0) * web.get("counterweight_radius_m", 0.1) * (speed * 0.10472) ** 2
    web["max_centrifugal_force_N"] = force


def _no_rods(subject: Subject) -> None:
    for row in subject.rows:
        row.pop("connecting_rod", None)


def _endless_rod(subject: Subject) -> None:
    subject.rows[0]["connecting_rod"] = {"length_m": None, "mass_kg": 3.0}


def _offset(subject: Subject) -> None:
    subject.rows[0]["offset_m"] = 0.03


def _parts(subject: Subject) -> None:
    subject.rows[0]["parts"] = [{"name": "piston", "mass_kg": 2.0, "motion": "reciprocating"}]


def _all_gas(subject: Subject) -> None:
    for row in subject.rows:
        row["cylinder"] = gas()


def _indicated(subject: Subject) -> None:
    trace = {"angle_deg": [0.0, 40.0, 180.0, 320.0, 360.0], "pressure_Pa": [6e5, 2e5, 1e5, 3e5, 6e5]}
    data = gas()
    subject.rows[0]["cylinder"] = {
        "bore_m": data["bore_m"],
        "piston_rod_diameter_m": data["piston_rod_diameter_m"],
        "acting": "head",
        "ambient_pressure_Pa": 101325.0,
        "pressure": {"head": trace},
    }


def _friction(subject: Subject) -> None:
    _all_gas(subject)
    subject.machine["friction"] = {"mechanical_efficiency": 0.9}


def _specific_without_size(subject: Subject) -> None:
    for bearing in subject.machine.get("bearings", ()):
        bearing.pop("diameter_m")
    _goal(subject, bearing_weight=1.0, bearing_measure="specific")


def _more_bearings(subject: Subject) -> None:
    bearings = [*subject.machine.get("bearings", ())]
    _shaft(subject, bearings=[*bearings, {"name": "M", "position_m": 0.0, "diameter_m": 0.09, "length_m": 0.05}])


def _end_webs(subject: Subject) -> None:
    """All webs in the plane of an end bearing, which change no bending."""
    bearings = subject.machine.get("bearings")
    if not bearings:
        raise NoPlace
    for web in subject.webs:
        web["position_m"] = bearings[0]["position_m"]


def _mid_webs(subject: Subject) -> None:
    """All webs in the reference plane, which change no moment."""
    for web in subject.webs:
        web["position_m"] = 0.0
    subject.machine["reference_plane_m"] = 0.0


def _scenarios(subject: Subject, *changes: tuple[str, float]) -> None:
    faster = [{"path": "/machine/speed_rpm", "value": 1.1 * subject.machine["speed_rpm"]}]
    values = [{"path": path, "value": value} for path, value in changes]
    subject.body["scenarios"] = [{"name": "as it is"}, {"name": "other", "weight": 0.9, "changes": faster + values}]


def _heavier(subject: Subject) -> None:
    mass = 1.3 * subject.rows[0]["reciprocating_mass_kg"]
    _scenarios(subject, ("/machine/throws/0/rows/0/reciprocating_mass_kg", mass))


_FIRST, _ALL = slice(0, 1), slice(None)
_ORDERED = [{"goal": "external", "allowance": 0.01}, {"goal": "bearings", "allowance": 0.01}, {"goal": "bending"}]
_CEILINGS = (
    "force_ceiling_N", "force_ceiling_x_N", "force_ceiling_y_N", "moment_ceiling_Nm", "moment_ceiling_x_Nm",
    "moment_ceiling_y_Nm", "bearing_ceiling_N", "specific_load_ceiling_Pa", "bending_ceiling_Nm",
)  # fmt: skip

FEATURES: Mapping[str, Feature] = {
    "combine max": partial(_goal, combine="max"),
    "force alone": partial(_goal, moment_weight=0.0),
    "moment alone": partial(_goal, force_weight=0.0, moment_weight=1.0),
    "direction weights": partial(_goal, direction_weights={"x": 1.0, "y": 0.4}),
    "one direction": partial(_goal, direction_weights={"x": 0.0, "y": 1.0}),
    "orders all": partial(_goal, orders="all"),
    "bearing weight": partial(_goal, bearing_weight=1.0),
    "bearing rms": partial(_goal, bearing_weight=1.0, bearing_measure="rms"),
    "bearing specific": partial(_goal, bearing_weight=1.0, bearing_measure="specific"),
    "bearings alone": partial(_goal, force_weight=0.0, moment_weight=0.0, bearing_weight=1.0),
    "bending weight": partial(_goal, bending_weight=2.0),
    "bending alone": partial(_goal, force_weight=0.0, moment_weight=0.0, bending_weight=2.0),
    "roll weight": partial(_goal, roll_weight=1.0),
    **{f"{name} slack": partial(_ceiling, field=name, share=3.0) for name in _CEILINGS},
    **{f"{name} near": partial(_ceiling, field=name, share=0.85) for name in _CEILINGS},
    "force ceiling of 0": partial(_goal, force_ceiling_N=0.0),
    "ceilings out of reach": partial(_goal, force_ceiling_N=1.0, bending_ceiling_Nm=1e-3),
    "priorities": partial(_goal, bearing_weight=1.0, bending_weight=2.0, priorities=_ORDERED),
    "external, then mass": partial(_goal, priorities=[{"goal": "external", "allowance": 0.05}, {"goal": "mass"}]),
    "light choices": partial(_costs, costs=("mass",)),
    "few pieces": partial(_costs, costs=("pieces", "mass")),
    "few sizes": partial(_costs, costs=("sizes", "pieces")),
    "least mass false": partial(_goal, least_mass=False),
    "symmetric false": partial(_goal, symmetric=False),
    "scenario of speed": _scenarios,
    "scenario of masses": _heavier,
    "tolerances of masses and angles": partial(
        _part, name="tolerances", value={"mass_relative": 0.02, "angle_deg": 2.0}
    ),
    "tolerances of rows": partial(_part, name="tolerances", value={"reciprocating_mass_relative": 0.02}),
    "tolerance of unbalance": partial(_part, name="tolerances", value={"unbalance_kg_m": 0.01}),
    "tolerances of 0": partial(_part, name="tolerances", value={}),
    "gap of 1e-3": partial(_accuracy, relative_gap=1e-3),
    "gap of 1e-9": partial(_accuracy, relative_gap=1e-9),
    "short time": partial(_accuracy, time_limit_s=0.05),
    "steps": _steps,
    "masses of a catalogue": _masses,
    "own masses": _own_masses,
    "cheaper choices": _cheaper,
    "part numbers": _part_numbers,
    "few counterweights": partial(_few, most=1),
    "no counterweights": partial(_few, most=0),
    "holes": _holes,
    "least fitted": partial(_least, share=0.5),
    "sectors": partial(_web, places=_ALL, fields={"sector": {"centre_deg": 200.0, "half_angle_deg": 50.0}}),
    "thin sector": partial(_web, places=_FIRST, fields={"sector": {"centre_deg": 180.0, "half_angle_deg": 1e-3}}),
    "plates, sectors": partial(_plate, shape="sector"),
    "plates, segments": partial(_plate, shape="segment"),
    "fitted": _fitted,
    "fixed": partial(_web, places=_FIRST, fields={"fixed": {"mass_kg": 0.1, "angle_deg": 170.0}}),
    "all fixed": partial(_web, places=_ALL, fields={"fixed": {"mass_kg": 0.1, "angle_deg": 170.0}}),
    "group": partial(_group, mirror=False),
    "mirrored group": partial(_group, mirror=True),
    "no largest mass": partial(_web, places=_ALL, fields={"max_mass_kg": None}),
    "largest mass of 0": partial(_web, places=_FIRST, fields={"max_mass_kg": 0.0}),
    "no webs": partial(_rotor, webs=[]),
    "budget": partial(_budget, share=0.3),
    "budget of 0": partial(_budget, share=0.0),
    "overspeed and bolts": _overspeed,
    "balance shaft backwards": partial(_balance_shafts, ratio=-1),
    "balance shaft forwards": partial(_balance_shafts, ratio=1),
    "balance shaft of order 2": partial(_balance_shafts, ratio=2),
    "least fitted on a shaft": partial(_balance_shafts, ratio=-1, min_fitted_mass_kg=3.0),
    "bolts on a shaft": partial(_balance_shafts, ratio=2, max_centrifugal_force_N=300.0),
    "plate on a shaft": partial(
        _balance_shafts,
        ratio=-1,
        counterweight_radius_m=None,
        max_mass_kg=None,
        envelope={"shape": "segment", "inner_radius_m": 0.01, "outer_radius_m": 0.08, "thickness_m": 0.03},
    ),
    "sector plate on a shaft": partial(
        _balance_shafts,
        ratio=1,
        counterweight_radius_m=None,
        max_mass_kg=None,
        envelope={"shape": "sector", "inner_radius_m": 0.02, "outer_radius_m": 0.09, "thickness_m": 0.02},
    ),
    "castings on a shaft": partial(
        _balance_shafts, ratio=-1, catalogue_masses_kg=[2.0, 4.0], hole_angles_deg=[90.0, 200.0, 310.0]
    ),
    "unbalances": partial(
        _rotor, unbalances=[{"name": "flywheel", "position_m": 0.2, "x_kg_m": 0.02, "y_kg_m": -0.01}]
    ),
    "clockwise": partial(_rotor, rotation="cw"),
    "reference plane": partial(_rotor, reference_plane_m=0.1),
    "no bearings": partial(_shaft, bearings=[]),
    "three bearings": _more_bearings,
    "continuous shaft": partial(_part, name="fidelity", value={"shaft": "continuous"}),
    "kinematics of order 2": partial(_part, name="fidelity", value={"kinematics": "order_2"}),
    "gas": _all_gas,
    "indicated pressure": _indicated,
    "friction": _friction,
    "no rods": _no_rods,
    "endless rod": _endless_rod,
    "offset row": _offset,
    "parts": _parts,
    "no rows": lambda subject: subject.throws[0].update({"rows": []}),
    "bearings without sizes": _specific_without_size,
    "webs at an end bearing": _end_webs,
    "webs in the reference plane": _mid_webs,
    "outputs of the turn": partial(_part, name="outputs", value=["residual", "orders", "kinematics", "main_bearings"]),
    "loads of parts": _loads_of_parts,
    "outputs of gas": partial(_part, name="outputs", value=["residual", "gas", "torque"]),
    "balance quality": partial(
        _rotor,
        balance_quality={
            "grade_mm_s": 6.3, "mass_kg": 100.0, "centre_of_mass_m": 0.0, "plane_a_m": -0.2, "plane_b_m": 0.2,
        },
    ),
}  # fmt: skip
