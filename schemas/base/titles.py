"""What fields and models are called where people read of them: the title of a form's label."""

import re

#: how the units of fields are spelt at the end of their names, the longest first
_SUFFIX = re.compile(
    r"_(kg_m2|kg_m3|kg_m|m3_per_min|N_per_m|per_deg|rad_s2|m_s2|m_s|mm_s|m3|m2|deg|rpm|Nm|Pa|Hz|ms|kg|m|N|K|W|J|s)$"
)
_ACROSS = re.compile(r" (x|y)$")
_LIMITS = {"max ": "largest ", "min ": "smallest "}
_WORD = re.compile(r"(?<=[a-z])(?=[A-Z])")

#: what the name of a field does not say by itself, of one model or of all
_TITLES = {
    "acting": "Sides that act",
    "angles": "Angles sampled",
    "anti_rotation": "Anti-rotation device",
    "Axis.count": "Number of values",
    "axes": "Fields that vary",
    "axis_deg": "Direction of the axis",
    "base": "Request to start from",
    "bearing_measure": "Measure of bearing loads",
    "bearing_weight": "Weight of bearing loads",
    "bearings": "Main bearings",
    "bending_weight": "Weight of the bending moment",
    "by": "Column to rank by",
    "centre_deg": "Middle",
    "class": "Kind of part",
    "combine": "How goals are combined",
    "comparison": "Comparison with an Oldham ring",
    "count": "Number",
    "crank": "Crank side",
    "CrankPins.count": "Number of pins",
    "cycle_turns": "Turns in a cycle",
    "design": "Kind of design",
    "document": "Document head",
    "drawing": "Drawing number",
    "dry_run": "Only estimate",
    "Envelope.shape": "Outline",
    "fixed": "Weight that is there already",
    "from_m": "Bore begins at",
    "grade_mm_s": "Balance quality grade",
    "gravity_deg": "Direction of gravity",
    "half_angle_deg": "Half of the opening",
    "head": "Head side",
    "inertia_kg_m2": "Moment of inertia",
    "irregularity": "Irregularity of speed",
    "kind": "Kind of machine",
    "least_mass": "Lightest of equally good",
    "mass_relative": "Error of masses, as a share",
    "max_counterweights": "Most counterweights",
    "max_half_angle_deg": "Half of the largest opening",
    "max_part_numbers": "Most different masses",
    "max_total_mass_kg": "Largest total mass",
    "min_fitted_mass_kg": "Minimum mass, if any",
    "multipliers": "Multipliers in the answer",
    "number": "Document number",
    "offset_m": "Offset from the throw",
    "orders": "Orders that count",
    "pareto": "Keep what no other beats in",
    "path": "Field, as a JSON pointer",
    "plane_a_m": "Tolerance plane A",
    "plane_b_m": "Tolerance plane B",
    "points": "Points of a front",
    "reciprocating_mass_relative": "Error of reciprocating masses, as a share",
    "repeats": "Rounds of timing",
    "roll_weight": "Weight of the roll moment",
    "samples": "Number of designs",
    "step_deg": "Step of the angle",
    "symmetric": "Most symmetric of equally light",
    "tandems": "Stages in tandem",
    "to_m": "Bore ends at",
    "Tolerances.angle_deg": "Error of angles",
    "Tolerances.unbalance_kg_m": "Unbalance besides",
    "top": "Keep the best",
    "total_mass_budgets_kg": "Limits of the total mass",
    "versions": "Versions to compare",
    "x": "Along x",
    "x_kg_m": "Unbalance along x",
    "x_m": "Place along x",
    "y": "Along y",
    "y_kg_m": "Unbalance along y",
    "y_m": "Place along y",
}


def field_title(model: str, name: str) -> str:
    """A field as a person would call it, without its unit: ``crank_radius_m`` is "Crank radius"."""
    title = _TITLES.get(f"{model}.{name}") or _TITLES.get(name)
    if title is not None:
        return title
    words = _ACROSS.sub(r" along \1", _SUFFIX.sub("", name).replace("_", " "))
    for short, spoken in _LIMITS.items():
        words = spoken + words.removeprefix(short) if words.startswith(short) else words
    return words[:1].upper() + words[1:]


def model_title(model: str) -> str:
    """A model as a person would call it: ``ConnectingRod`` is "Connecting rod"."""
    return _WORD.sub(" ", model).capitalize()
