"""Under which headings, and in which order, a form shows the fields of the requests' large models.

Headings stand in the order of a person's work: what the thing is, its data, its outputs.
A model that is built on another one has the headings of that one as well, behind its own.
"""

from collections.abc import Iterable

from schemas.base.responses import RESPONSES, ceilings

Groups = dict[str, tuple[str, ...]]

_WEIGHTS = tuple(field for ceiling in RESPONSES.values() for field in (ceiling.weight, *ceiling.parameters))
_CEILINGS = tuple(ceiling.field for ceiling in sorted(ceilings(), key=lambda ceiling: ceiling.axis is not None))

_ROTOR: Groups = {
    "Machine": ("kind", "name", "description"),
    "Motion": ("speed_rpm", "rotation", "overspeed_rpm"),
    "Counterweights": (
        "webs", "web_groups", "max_total_mass_kg", "catalogue", "max_counterweights", "unbalances", "balance_quality",
        "reference_plane_m",
    ),
}  # fmt: skip
_GAS: Groups = {
    "Pressures": ("suction_pressure_Pa", "discharge_pressure_Pa", "ambient_pressure_Pa", "pressure"),
    "Process": ("relative_clearance", "expansion_exponent", "compression_exponent"),
}
_CYLINDER: Groups = {
    "Size": ("bore_m", "piston_rod_diameter_m", "acting", "head_area_m2", "crank_area_m2"),
    "Sides that differ": ("head", "crank"),
}
_SCENE: Groups = {
    "Machine": ("machine",),
    "Answer": ("outputs", "foundation_orders", "angles", "fidelity"),
}
_OPTIMIZE: Groups = {
    "What is to be small": ("objective", "accuracy", "scenarios", "tolerances", "alternatives"),
    "What is fitted": ("fitted",),
}

#: name of a model -> heading -> its fields
GROUPS: dict[str, Groups] = {
    "Rotor": _ROTOR,
    "ReciprocatingMachine": {
        "Machine": _ROTOR["Machine"],
        "Motion": _ROTOR["Motion"],
        "Crankshaft": ("throws", "bearings", "balance_shafts", "flywheel", "shaft_parts"),
        "Counterweights": _ROTOR["Counterweights"],
        "Losses and weight": ("friction", "gravity_deg", "stationary_mass_kg"),
    },
    "ScrollMachine": {
        "Machine": _ROTOR["Machine"],
        "Motion": _ROTOR["Motion"],
        "Scroll": ("orbit_radius_m", "orbiting_mass_kg", "orbiting_position_m", "anti_rotation"),
        "Counterweights": _ROTOR["Counterweights"],
        "Pins": ("drive_bearing", "rotation_torque_Nm", "tangential_gas_force_N"),
    },
    "CylinderFace": {
        "Face": ("type", "name", "outer"),
        "Geometry": ("centre_m", "axis", "radius_m", "ends_m", "angle_deg", "points_m"),
    },
    "Web": {
        "Place": ("name", "position_m", "throw"),
        "Counterweight": ("counterweight_radius_m", "max_mass_kg", "sector", "envelope", "fixed"),
        "Limits and choices": (
            "min_fitted_mass_kg", "max_centrifugal_force_N", "catalogue_masses_kg", "hole_angles_deg",
        ),
    },
    "Row": {
        "Place": ("name", "axis_deg", "offset_m"),
        "Masses": ("reciprocating_mass_kg", "parts", "connecting_rod"),
        "Gas": ("cylinder", "cylinders"),
    },
    "RowCylinder": {
        "Place": ("name", "from_m", "to_m"),
    },
    "Cylinder": {"Size": _CYLINDER["Size"], **_GAS, "Sides that differ": _CYLINDER["Sides that differ"]},
    "CompressionStage": {
        "Stage": ("name", "cylinders", "acting", "bore_m", "piston_rod_diameter_m", "suction_temperature_K"),
        "Process": (
            "relative_clearance", "expansion_exponent", "compression_exponent", "polytropic_exponent",
            "side_flow_coefficient",
        ),
        "Delivery": (
            "pressure_coefficient", "temperature_coefficient", "leakage_coefficient", "relative_leaks",
            "suction_pressure_loss", "discharge_pressure_loss",
        ),
    },
    "Objective": {
        "Force and moment": (
            "combine", *_WEIGHTS, "direction_weights", "orders", "roll_weight",
        ),
        "Inside the shaft": ("bearing_weight", "bearing_measure", "bending_weight"),
        "Ceilings": (
            *_CEILINGS, "bearing_ceiling_N", "specific_load_ceiling_Pa", "bending_ceiling_Nm",
        ),
        "Among equals": ("priorities", "least_mass", "symmetric"),
    },
    "Scene": _SCENE,
    "AnalyzeRequest": {"Machine": ("machine", "counterweights"), "Answer": _SCENE["Answer"]},
    "OptimizeRequest": {"Machine": ("machine",), **_OPTIMIZE, "Answer": _SCENE["Answer"]},
    "DrawingsRequest": {"Machine": ("machine", "counterweights"), **_OPTIMIZE, "Answer": _SCENE["Answer"]},
    "AccuracyRequest": {"Machine": ("machine",), "Timing": ("repeats",)},
    "DocumentHead": {
        "Office": ("company", "customer", "project", "logo"),
        "Document": ("number", "revision", "date", "drawing", "revisions", "notes"),
        "People": ("author", "checker", "approver"),
    },
    "PictureRequest": {"Picture": ("picture",)},
    "ReportRequest": {"Document": ("document", "versions")},
    "ParetoRequest": {"Machine": ("machine",), "Fronts": (
        "points", "total_mass_budgets_kg", "responses", "counts", "multipliers",
    )},
    "SweepRequest": {
        "What is computed": ("task", "base"),
        "Designs": ("design", "axes", "angles_deg", "samples", "seed"),
        "Result": ("columns", "details", "top", "pareto", "multipliers", "dry_run"),
    },
    "MatchRequest": {
        "Machine": ("machine",),
        "Parts": ("parts", "balance_nuts_kg"),
        "Counterweights": ("counterweights", "choose_counterweights"),
        "What is to be small": ("objective", "accuracy"),
    },
    "RatingRequest": {
        "Machine": ("name", "speed_rpm", "stroke_m", "stages", "tandems"),
        "Duty": (
            "capacity_m3_per_min", "capacity_pressure_Pa", "capacity_temperature_K", "suction_pressure_Pa",
            "discharge_pressure_Pa", "interstage_pressures_Pa", "ambient_pressure_Pa",
        ),
        "Gas": ("isentropic_exponent", "relative_density", "relative_humidity"),
        "Limits": ("discharge_temperature_limit_K", "rated_rod_load_N", "mean_piston_speed_m_s"),
        "Drive": ("mechanical_efficiency", "drive_efficiency", "motor_margin", "installed_motor_power_W"),
        "Standards to choose from": ("bore_series", "piston_rods", "motors"),
        "Curves": ("suction_loss_curve", "discharge_loss_curve", "temperature_curve"),
    },
    "PinLoadsRequest": {
        "Pins": ("pin_count", "pin_circle_radius_m", "pins"),
        "Load": ("rotation_torque_Nm", "tangential_gas_force_N", "orbit_radius_m"),
        "Bearing and comparison": ("drive_bearing", "comparison"),
        "Answer": ("angles",),
    },
}  # fmt: skip


def headings(models: Iterable[str]) -> dict[str, str]:
    """Field -> heading of a model, in the order of a form; empty where it needs none.

    Parameters
    ----------
    models : names of the model and of those that it is built on, its own first.
    """
    grouped = [GROUPS[model] for model in models if model in GROUPS]
    members: dict[str, list[str]] = {}
    names: set[str] = set()
    for groups in grouped:
        for heading, fields in groups.items():
            members.setdefault(heading, []).extend(field for field in fields if field not in names)
            names |= set(fields)
    return {field: heading for heading, fields in members.items() for field in fields}
