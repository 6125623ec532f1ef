"""The fields that an answer has: one that lacks a field of its form says less than it seems to, and is broken.

Each line says of which objects, by the end of their places, and what they hold; some fields may hold null.
"""

from __future__ import annotations

from typing import Any, Dict, Iterator, List, Tuple, Union

from verify_claims import Claim
from verify_numbers import ONE, Place

_TABLE = """
.: version status status_reason counterweights total_mass_kg balance_shafts balance_shafts_mass_kg active_limits
  shadow_prices alternatives worst_case price_of_robustness
  sensitivity residual floor certificate infeasibility balance_rate
  balance_quality warnings reference_plane_m effects timing
alternatives: minimised allowance objective total_mass_kg pieces sizes lower_bound counterweights
  balance_shafts
counterweights nominal_counterweights: web mass_kg angle_deg position_m radius_m throw angle_from_crank_deg
  mass_radius_kg_m x_kg_m y_kg_m centrifugal_force_N active_limits fixed shape
shape: half_angle_deg chord_height_m outer_radius_m inertia_kg_m2
balance_shafts nominal_balance_shafts: name speed_ratio gearing total_mass_kg counterweights
shadow_prices: limit web value unit
worst_case: force_peak_N moment_peak_Nm responses bearing_peak_N objective
worst_case/responses closest/responses: response label unit peak
price_of_robustness: nominal nominal_optimum nominal_optimum_worst_case nominal_lower_bound nominal_counterweights
  nominal_balance_shafts nominal_multipliers nominal_implied_max_mass_kg
sensitivity: objective_rise_per_deg objective_rise_per_percent
residual: before after orders responses turn
residual/responses: response label unit before after turn_before turn_after
residual/before residual/after first_order without_counterweights: force moment
residual/before/force residual/after/force first_order/force without_counterweights/force: peak_N minor_N
  major_axis_deg peak_x_N peak_y_N co_rotating_N counter_rotating_N
residual/before/moment residual/after/moment first_order/moment without_counterweights/moment: peak_Nm minor_Nm
  major_axis_deg peak_x_Nm peak_y_Nm co_rotating_Nm counter_rotating_Nm
orders turn: before after
orders/before orders/after: order force moment
orders/before/force orders/after/force: co_rotating counter_rotating peak_N
force/co_rotating force/counter_rotating: real_N imag_N magnitude_N phase_deg
orders/before/moment orders/after/moment: co_rotating counter_rotating peak_Nm
moment/co_rotating moment/counter_rotating: real_Nm imag_Nm magnitude_Nm phase_deg
turn/before turn/after: force_peak_N moment_peak_Nm
floor yardstick scale: force_N moment_Nm
certificate: objective lower_bound gap relative_gap yardstick objective_without_counterweights mass_lower_bound_kg
  mass_relative_gap mass_yardstick_kg mass_objective_limit implied_max_mass_kg method cuts rounds
  continuous_lower_bound nodes goals multipliers
goals: goal value lower_bound limit multipliers
certificate/multipliers points/multipliers: objective mass
objective mass smallest/multipliers goals/multipliers nominal_multipliers conflict smallest_force smallest_moment: terms
  rows
  budget ceilings
terms: response part row angle_deg scenario x y
rows: name value
ceilings: response part angle_deg scenario x y
infeasibility: conflict smallest_force_N smallest_moment_Nm smallest_force_lower_bound_N
  smallest_moment_lower_bound_Nm scenarios smallest implied_max_mass_kg
  smallest_implied_max_mass_kg closest multipliers
smallest: response ceiling_field ceiling smallest lower_bound multipliers
closest: counterweights balance_shafts first_order responses
infeasibility/multipliers: conflict smallest_force smallest_moment scenarios
multipliers/scenarios: scenario conflict
balance_rate: throw name rate sideways
balance_quality: permissible_kg_m before after
balance_quality/before balance_quality/after: grade_mm_s plane_a plane_b
plane_a plane_b: position_m permissible_kg_m unbalance_kg_m angle_deg
warnings: code message pointer
timing: total_ms solve_ms mechanics_ms certificate_ms report_ms
pareto: version status fronts trades counts without_counterweights floor reference_plane_m effects timing
fronts: max_total_mass_kg status points reason knee ends scale implied_max_mass_kg infeasibility
points: status status_reason force_peak_N moment_peak_Nm weighted_force_peak_N weighted_moment_peak_Nm worst_case
  total_mass_kg counterweights balance_shafts balance_shafts_mass_kg active_limits certificate multipliers
points/worst_case: force_peak_N moment_peak_Nm
trades: max_total_mass_kg status reason responses points infeasibility
trades/responses: response unit without_counterweights smallest lower_bound yardstick
trades/points: status status_reason values nominal_values beaten_by force_peak_N moment_peak_Nm total_mass_kg
  counterweights balance_shafts balance_shafts_mass_kg certificate
trades/points/certificate: corner relative_gap mass_lower_bound_kg mass_relative_gap cuts rounds method
points/certificate: force_N moment_Nm relative_gap yardstick mass_lower_bound_kg mass_relative_gap mass_yardstick_kg
  mass_force_limit_N mass_moment_limit_Nm implied_max_mass_kg method
counts: max_total_mass_kg of least status points
counts/points: at_most status status_reason value lower_bound relative_gap weights part_numbers total_mass_kg
  force_peak_N moment_peak_Nm counterweights balance_shafts balance_shafts_mass_kg nodes method
ends: smallest_force_N smallest_force_lower_bound_N moment_at_smallest_force_Nm smallest_moment_Nm
  smallest_moment_lower_bound_Nm force_at_smallest_moment_N multipliers
ends/multipliers: smallest_force smallest_moment
match: version status status_reason assignments spares rows counterweights total_mass_kg balance_shafts
  balance_shafts_mass_kg residual certificate timing
match/assignments: class part mass_kg throw row
match/spares: class part mass_kg
match/rows: throw row name reciprocating_mass_kg
match/residual: before after
match/certificate: objective objective_as_listed lower_bound gap relative_gap yardstick method
hodograph: angle_deg before after
hodograph/before hodograph/after: force_x_N force_y_N moment_x_Nm moment_y_Nm
foundation_loads: order dead_centre_deg before after as_built
foundation_loads/before foundation_loads/after foundation_loads/as_built: force_x force_y couple_of_x_forces
  couple_of_y_forces
force_x force_y: amplitude_N phase_deg
couple_of_x_forces couple_of_y_forces: amplitude_Nm phase_deg
stages: stage title quantity formula value unit plane frequency balanceable remaining acting left iron rules_of_thumb
stages/acting stages/left: quantity order frequency_Hz unit peak minor motion direction_deg
stages/iron: position_m rotating_x_kg_m rotating_y_kg_m reciprocating_x_kg_m reciprocating_y_kg_m
stages/rules_of_thumb: name source transferred_share total_mass_radius_kg_m peak peak_along peak_across
"""
#: which fields of these objects may hold null
_NULL = """
.: balance_quality balance_shafts_mass_kg certificate infeasibility price_of_robustness sensitivity total_mass_kg
  worst_case
balance_quality hodograph orders turn: after
foundation_loads: after as_built
stages: left remaining
stages/acting stages/left: direction_deg
match/rows: name
counterweights nominal_counterweights: angle_from_crank_deg shape throw
shape: chord_height_m
shadow_prices: web
alternatives: lower_bound
worst_case: bearing_peak_N
price_of_robustness: nominal_lower_bound nominal_multipliers nominal_optimum nominal_optimum_worst_case
ceilings terms: angle_deg scenario
residual: after turn
residual/responses: after turn_after turn_before
certificate: continuous_lower_bound cuts gap lower_bound mass_lower_bound_kg mass_objective_limit mass_relative_gap
  mass_yardstick_kg nodes relative_gap rounds
goals: lower_bound multipliers
certificate/multipliers points/multipliers: mass
ends smallest: multipliers
infeasibility/multipliers: conflict
balance_rate: name rate sideways
fronts: ends infeasibility knee max_total_mass_kg reason scale
points: balance_shafts_mass_kg multipliers worst_case
points/certificate: force_N mass_force_limit_N mass_lower_bound_kg mass_moment_limit_Nm mass_relative_gap
  mass_yardstick_kg moment_Nm relative_gap
trades: max_total_mass_kg reason infeasibility
trades/points: nominal_values beaten_by balance_shafts_mass_kg
trades/points/certificate: relative_gap mass_lower_bound_kg mass_relative_gap
counts: max_total_mass_kg
counts/points: value lower_bound relative_gap weights part_numbers total_mass_kg force_peak_N moment_peak_Nm
  balance_shafts_mass_kg
match: balance_shafts_mass_kg
match/certificate: gap lower_bound relative_gap
"""
#: outputs whose form is known here, though none but those that are requested are in an answer
OUTPUTS = ("hodograph", "orders", "foundation_loads", "stages")
#: outputs that may be empty although they are requested
_ANYWAY = ("residual", "balance_rate")


def _read(table: str) -> Dict[Tuple[str, ...], Tuple[str, ...]]:
    fields = {}
    for line in table.replace("\n  ", " ").strip().splitlines():
        ends, _, names = line.partition(": ")
        for end in ends.split():
            fields[tuple(end.split("/")) if end != "." else ()] = tuple(names.split())
    return fields


FORM, NULL = _read(_TABLE), _read(_NULL)


def names(parts: Tuple[str, ...], table: Dict[Tuple[str, ...], Tuple[str, ...]] = FORM) -> Tuple[str, ...]:
    """Fields of the object at a place, without the numbers of lists; none where nothing is said of it."""
    key = next((parts[n:] for n in range(len(parts)) if parts[n:] in FORM), None if parts else ())
    return () if key is None else table.get(key, ())


def form(answer: Place, kind: Tuple[str, ...] = ()) -> Iterator[Claim]:
    """No object lacks a field, nor holds null in one that always has a value.

    ``kind``: what places begin with, where it is not the answer to one request.
    """
    yield "form", answer, ONE, ONE
    left: List[Tuple[Any, Tuple[Union[str, int], ...]]] = [(answer.value, ())]
    while left:
        value, path = left.pop()
        parts = (*kind, *(part for part in path if isinstance(part, str)))
        if isinstance(value, list):
            left.extend((item, (*path, k)) for k, item in enumerate(value))
        elif isinstance(value, dict):
            fields = names(parts)
            allowed = names(parts, NULL)
            missing = [name for name in fields if name not in value or (value[name] is None and name not in allowed)]
            if missing:
                yield "form", Place(value, *answer.path, *path, missing[0]), -ONE, ONE
            also = () if path or kind else tuple(name for name in OUTPUTS if name in value)
            left.extend((value[name], (*path, name)) for name in (*fields, *also) if name in value)


def outputs(request: Place, answer: Place) -> Iterator[Claim]:
    """What was requested is there."""
    for name in map(Place.text, request / "outputs"):
        if name not in _ANYWAY and not answer / name:
            yield "form", answer / name, -ONE, ONE
