"""Faults that change nothing of what is promised, each with the reason: they are not put in."""

_STEERS = "it leads a search: every point is judged, and every bound proven, by what does not depend on it"
_SPEED = "it says how the same is computed, and how fast"
_ALIKE = "both come to the same there"
_FINER = "finer or coarser than is needed, within what is told of it"
_LOOKS = "a hundredth of the width of a line, or a px of the sample of a line in a legend: nobody can see it"
_OPEN = "of open sides nothing is used"
_MECHANICS: dict[str, str] = {
    "bearings.py _arms: size[0] < size[1] -> size[0] <= size[1]": _ALIKE,
    "bearings.py _refuse_coincident: 4.0 * np.spacing(np.maximum(np.abs(first), np.abs(last)))"
    " -> 4.041 * np.spacing(np.maximum(np.abs(first), np.abs(last)))": _FINER,
    "row_data.py _opened: np.where(closed, discharge, 1.0) -> np.where(closed, discharge, 1.011)": _OPEN,
    "row_data.py _opened: np.where(closed, suction, 1.0) -> np.where(closed, suction, 1.011)": _OPEN,
    "friction.py reciprocating_friction: np.abs(motion.sine) < 1e-12 -> np.abs(motion.sine) <= 1e-12": _ALIKE,
    "layout.py _unbalances: angle + 180.0 -> angle - 180.0": "a whole turn",
    "row_series.py functions: self._memo.get(True) or self._memo.get(with_gas)"
    " -> self._memo.get(True) and self._memo.get(with_gas)": _SPEED,
    "whole_turn.py _alone: self.rows.crank_radius.shape[-1] -> self.rows.crank_radius.shape[+1]": "it has two axes",
    "indicated.py _WIDEST_PANEL": _FINER,
    "turn.py _NODES": _FINER,
    "turn.py _to_crossing: (high - low) * at_low / _nonzero(at_low - at_high)"
    " -> (high - low) * at_low * _nonzero(at_low - at_high)": "Newton's method begins elsewhere in the same interval",
    "turn.py fluctuation: value[..., :-1] * value[..., 1:] < 0.0"
    " -> value[..., :-1] * value[..., 1:] < 0.001": "one place more of the integral is looked at, which is never"
    " beyond its extremes",
    "turn.py fluctuation: np.max(end, axis=-1) -> np.min(end, axis=-1)": "the integral ends as it begins, at 0: every"
    " end of a panel is the beginning of another, of which the largest is taken anyway",
    "whole_turn.py in_pieces: within.shape[-1] -> within.shape[+1]": "it has two axes",
    "whole_turn.py _LEFT_OUT: (1e-11, 512.0) -> (1e-11, 517.121)": _FINER,
    "kernel/quadrature.py equal_parts: 1.0 / order -> 1.011 / order": _FINER,
    "kernel/quadrature.py equal_parts: size[d, c] if size[d, c] > 0.0 else 1.0"
    " -> size[d, c] if size[d, c] > 0.0 else 1.011": "of what has no size nothing is left out",
}
_PROGRAM: dict[str, str] = {
    "solution.py certify_s: 0.0 -> 0.001": "a millisecond of what is told of time",
    "cuts/attempts.py FREELY": _STEERS,
    "cuts/attempts.py WITHIN": _STEERS,
    "cuts/cut.py alike: max -> min": _ALIKE,
    "cuts/row_generation.py single_group: max -> min": _SPEED,
    "cuts/rounding.py _STEPS: NEAR[0] -> NEAR[1]": _STEERS,
    "cuts/samples.py maxima: np.argmax(around, axis=-1) - 1 -> np.argmax(around, axis=-1) + 1": _STEERS,
    "cuts/samples.py supports: abs(circle.radius - before) > _STEADY * circle.radius"
    " -> abs(circle.radius - before) >= _STEADY * circle.radius": _ALIKE,
    "cuts/stage.py run: -np.inf -> +np.inf": "a width takes all that is not finite alike",
    "cuts/stage.py _gap_limit: self.levels.of_bound - self.levels.most + self.margin"
    " -> self.levels.of_bound - self.levels.most - self.margin": _STEERS,
    "cuts/stage.py run: 0.0 -> 0.001": _STEERS,
    "methods/cascade.py _under_ceilings: nearest.objective <= -AMPLE -> nearest.objective < -AMPLE": _ALIKE,
    "methods/stage_ends.py _programs: np.add.reduce(mass, axis=-1, keepdims=True)"
    " -> np.add.reduce(mass, axis=+1, keepdims=True)": "it has two axes",
    "methods/stage_ends.py _programs: np.maximum.reduce(statement.floor, axis=-1)"
    " -> np.maximum.reduce(statement.floor, axis=+1)": "it has two axes",
    "methods/stage_ends.py _programs: -1 -> +1": "it has two axes",
    "methods/stage_ends.py solve_stages: statement.limits.radius.shape[-1]"
    " -> statement.limits.radius.shape[-2]": "without webs solving gives the same",
    "methods/polish.py lightened: statement.limits.radius.size == 0 -> statement.limits.radius.size == 1": _STEERS,
    "methods/compiled.py _general: points_at(statement.subset(left), nearest).excess < 0"
    " -> points_at(statement.subset(left), nearest).excess < 1": _STEERS,
    "methods/discs.py in_discs: np.argmax(np.abs(lines), axis=-1) -> np.argmax(np.abs(lines), axis=+1)": "it has two"
    " axes",
    "methods/feasibility_phase.py at_rest: rest.gap + float(allowance) <= target.share"
    " -> rest.gap + float(allowance) < target.share": _ALIKE,
    "methods/implied_bounds.py _in_sectors: np.min(along[outside], initial=1.0)"
    " -> np.min(along[outside], initial=1.011)": "the shortest support is 1 along some ray outside; without such a ray"
    " nothing is divided by it",
    "methods/implied_bounds.py _owners: np.abs(rows[:, r] - rows[:, n]) <= _SAME"
    " -> np.abs(rows[:, r] - rows[:, n]) < _SAME": "rows that differ by their rounding may count as one or as two",
    "methods/polish.py lightened: _ROOM_FOR_MASS * before.mass < worth_less * np.minimum(limits.max_mass,"
    " limits.max_total_mass) -> _ROOM_FOR_MASS * before.mass <= worth_less * np.minimum(limits.max_mass,"
    " limits.max_total_mass)": _STEERS,
    "methods/rounding.py RUNGS": _STEERS,
    "cuts/empty_webs.py _without: candidate.mass <= max(point.mass, heaviest)"
    " -> candidate.mass < max(point.mass, heaviest)": _ALIKE,
    "cuts/proof.py _MEAN: 64 * np.finfo(float).eps -> 65 * np.finfo(float).eps": _FINER,
    "reference/modelling.py _vector_duals: np.zeros(0, complex) -> np.zeros(1, complex)": "it is multiplied with the"
    " influences of none",
    "reference/solver.py _MASS_ATTEMPTS: _ATTEMPTS[1] -> _ATTEMPTS[2]": _STEERS,
    "reference/solver.py _ATTEMPTS: _SolverSetting(1e-11, 10.0, 2e-11, 1e-06)"
    " -> _SolverSetting(0.0010000000101, 10.0, 2e-11, 1e-06)": _STEERS,
}
_FORMULATION: dict[str, str] = {
    "formulate.py shape_facts: np.asarray(across.x) == across.y -> np.asarray(across.x) != across.y": "designs are"
    " put together that have the same facts: whether yes or no is of no account",
    "counterweights.py too_heavy: weight.mass_kg > most.get(str(weight.web), np.inf) * (1.0 + _ABOVE_ENVELOPE)"
    " -> weight.mass_kg >= most.get(str(weight.web), np.inf) * (1.0 + _ABOVE_ENVELOPE)": "a mass above what is held by"
    " 1e-12 exactly may be taken or not",
    "groups.py _same_options: image[:, 1] - angle + 180.0 -> image[:, 1] - angle - 180.0": "a whole turn",
    "groups.py _masses: mass is not None and angle is None -> mass is not None or angle is None": "angles are"
    " compared with their masses beside",
    "groups.py _at_angles: mass or 0.0 -> mass or 0.001": "a mark of what is left open, the same of both that are"
    " compared",
    "counterweights.py _within: over > 0 -> over >= 0": "beyond an edge by nothing, the share that is left is 1",
}
_VERIFY: dict[str, str] = {
    "verify_plates.py up_to: self.mass(self.most) <= limit -> self.mass(self.most) < limit": "halving comes to it too",
    "verify_inside.py internal_moment: 0.0 -> 0.001": "there is always a throw, and so a plane",
    "verify_gas.py slopes: max -> min": "what encloses steeper slopes encloses these, in more pieces",
    "verify_pistons.py steepness: (within + self.ahead) % TURN < pi -> (within + self.ahead) % TURN <= pi": "of the"
    " middles of pieces, which end at dead centres",
    "verify_worth.py spent: web.plate.lever(0.0) -> web.plate.lever(0.001)": "an end of the prices that are halved,"
    " less by a millionth",
    "verify_gas.py breaks: angle + self.lead -> angle - self.lead": "it is a revolution of two, forwards or backwards",
    "verify_claims.py judged: kinds[claim][:2] -> kinds[claim][:3]": "a pair is never above what begins with it",
    "verify_nominal.py nominal_optimum: above < 0 -> above <= 0": "nothing is above a bound by 0 to the bit",
    "verify_levels.py levels: max -> min": "without a goal before the last nothing that follows it is covered",
    "verify_harmonics.py rod: wide ** 2 -> wide ** 3": "wide is not below 1: a larger bound calls for more samples",
    "verify_program.py lightest: sizes[row].low > 0 -> sizes[row].low > 1": "it counts the smallest steps of numbers",
    "verify_pressed.py _sizes: size > 1e-14 -> size >= 1e-14": "no size is 1e-14 to the bit, which is of no account",
    "verify_values.py response: max -> min": "up to there a peak is of no interest: without it every peak is enclosed",
    "verify_prices.py worst_by_angle: off > 0 -> off >= 0": "what is off by nothing is within the angle, which is asked"
    " before",
    "verify_weights.py counterweight: mass.high <= 0 -> mass.high <= 1": "it counts the smallest steps of numbers, of"
    " which the smallest double is many",
    "verify_weights.py counterweights: total_mass * machine.wide -> total_mass / machine.wide": "it is 1 with its"
    " rounding to both sides",
    "verify_first.py near_the_bound: above - SPECK * most -> above + SPECK * most": "an interval around 0 is its own"
    " negative",
    "verify_numbers.py ABOUT_ONE: SPECK + J * SPECK -> SPECK - J * SPECK": "an interval around 0 is its own negative",
    "verify_cranks.py balance_rates: size.low <= real(NEXT_TO_NOTHING).high"
    " -> size.low < real(NEXT_TO_NOTHING).high": "nothing is 1e-280 kg m to the bit",
    "verify_program.py bound: price.high > 0 -> price.high >= 0": "without a price what is free gains the smallest"
    " steps of numbers at most",
    "verify_cases.py cases: path[1:2] -> path[1:3]": "beside balance shafts the service takes no scenarios",
    "verify_weights.py shafts: ratio > 0 -> ratio >= 0": "no shaft stands still",
    "verify_weights.py active_limits: room <= TOUCHED - UNSURE -> room < TOUCHED - UNSURE": "no room is that exactly",
    "verify_shafts.py power: times > 0 -> times >= 0": "0 times nothing is multiplied",
    "verify_numbers.py _distance: low >= 0 -> low > 0": _ALIKE,
    "verify_rods.py _root: curve(middle) * first > 0 -> curve(middle) * first >= 0": "halving comes to the same place"
    " from its other side",
    "verify_harmonics.py MOST: 40000 -> 40001": "angles are counted in pairs",
    "verify_alternatives.py costs: mass_kg - masses[n - 1] > SAME * mass_kg"
    " -> mass_kg - masses[n - 1] >= SAME * mass_kg": "no mass is that to the bit",
    "verify_levels.py _sizes: mass - masses[n - 1] > SAME * mass"
    " -> mass - masses[n - 1] >= SAME * mass": "no mass is that to the bit",
    "verify_match.py _count: min(len(kind.masses), 20) -> min(len(kind.masses), 21)": "either is more than is compared",
}


def _with(places: tuple[str, ...], first: str, second: str, why: str) -> dict[str, str]:
    """Faults by what they are in, each with the last of some signs another."""
    return {f"{place} -> {second.join(_fault(place).rsplit(first, 1))}": why for place in places}


def _fault(place: str) -> str:
    return place.partition(": ")[2]


#: what is added is as wide to both sides of 0
_TO_BOTH_SIDES = (
    "verify_answer.py rates: mass.co + machine.blur",
    "verify_answer.py gaps: gap + noise",
    "verify_answer.py gaps: wide * size + noise",
    "verify_answer.py gaps: size * real(MASS_GAP) + noise",
    "verify_cranks.py balance_rates: direction((throw / 'crank_angle_deg').double()) + machine.blur",
    "verify_cranks.py balance_rates: total(against) + BLUR * total((abs(part) for part in against))",
    "verify_curves.py on_shaft: mass.co + machine.blur",
    "verify_curves.py unit: direction(degrees) + self.machine.blur",
    "verify_cuts.py _mean: real(mean.real) + around",
    "verify_cuts.py _mean: real(mean.imag) + around",
    "verify_cuts.py _mean: real(curve.plus(-mean).rms) + around",
    "verify_cuts.py _fixed: mass.co + self.machine.blur",
    "verify_cuts.py value: most[name] + SPECK * size",
    "verify_first.py near_the_bound: above + noise",
    "verify_first.py near_the_bound: size * real(SMALLEST) + noise",
    "verify_machine.py _plus: mass.co + self.blur",
    "verify_machine.py _plus: mass.counter + self.blur",
    "verify_front.py point: peaks[name] + SPECK * peaks[name]",
    "verify_match.py _gap: gap + noise",
    "verify_match.py _gap: wide * size + noise",
    "verify_multipliers.py reached: item * wide + self.machine.blur * size",
    "verify_numbers.py ABOUT_ONE: ONE + SPECK",
    "verify_orders.py first_order: direction(degrees) + BLUR",
    "verify_orders.py _plus: way + machine.blur",
    "verify_orders.py _phasor: direction(phase) + BLUR",
    "verify_prices.py prices: least + noise",
    "verify_quality.py quality: direction((place / 'angle_deg').double()) + BLUR",
    "verify_quality.py _in_planes: mass.co + machine.blur",
    "verify_shaking.py _foundation: direction(degrees) + BLUR",
    "verify_shaking.py _load: direction(degrees) + BLUR",
    "verify_turn.py over_turn: value + noise",
    "verify_turn.py over_turn: limit + noise",
    "verify_weights.py counterweight: direction(angle) + machine.blur",
)
#: factors that are 1 with their rounding to both sides
_ABOUT_ONE = (
    "verify_answer.py before: machine.own_plane * ABOUT_ONE",
    "verify_answer.py gaps: (gap + noise) * ABOUT_ONE",
    "verify_answer.py gaps: rest.number() * ABOUT_ONE",
    "verify_cases.py scatter: real(share) * ABOUT_ONE",
    "verify_cranks.py balance_rates: total(turning) * (throw / 'crank_radius_m').number() * machine.wide",
    "verify_cranks.py balance_rates: part * ABOUT_ONE",
    "verify_curves.py on_shaft: row.product * machine.wide",
    "verify_curves.py on_shaft: mass.product * machine.wide",
    "verify_cuts.py term: self.weights[kind] * ABOUT_ONE",
    "verify_cuts.py _mean: self.weights['bearing'] * ABOUT_ONE",
    "verify_first.py most: largest(mass - statement.machine.fixed, counts * real(MASS_SHARE)) * ABOUT_ONE",
    "verify_first.py yardstick: most * ABOUT_ONE",
    "verify_goals.py _exactly: value * ABOUT_ONE",
    "verify_goals.py _exactly: rest * ABOUT_ONE",
    "verify_goals.py _exactly: largest(*peaks) * ABOUT_ONE",
    "verify_machine.py _plus: mass.product * self.wide",
    "verify_machine.py arm: force * wide",
    "verify_machine.py arm: position * wide",
    "verify_machine.py arm: self.plane * wide",
    "verify_machine.py arm: along * moment * wide",
    "verify_front.py _shape: peak.number() * ABOUT_ONE",
    "verify_front.py _scale: largest(most, machine.square) * ABOUT_ONE",
    "verify_front.py point: (peaks[name] + SPECK * peaks[name] - corner.number()) * ABOUT_ONE",
    "verify_front.py point: gap * ABOUT_ONE",
    "verify_match.py matching: whole * ABOUT_ONE",
    "verify_match.py _gap: (gap + noise) * ABOUT_ONE",
    "verify_multipliers.py reached: item * wide",
    "verify_orders.py _plus: where * machine.wide",
    "verify_orders.py _plus: machine.plane * machine.wide",
    "verify_orders.py _plus: size * machine.wide",
    "verify_program.py reach: real(web.plate.mass(web.plate.most)) * ABOUT_ONE",
    "verify_program.py change: real(web.plate.lever(0.0)) * ABOUT_ONE",
    "verify_quality.py quality: grade * real(1 / 1000) * ABOUT_ONE",
    "verify_quality.py quality: permitted * real(part) * ABOUT_ONE",
    "verify_quality.py _in_planes: (mass.co + machine.blur) * mass.product * machine.wide",
    "verify_quality.py _in_planes: mass.position * machine.wide",
    "verify_weights.py counterweight: (direction(angle) + machine.blur) * mass * radius * machine.wide",
    "verify_weights.py counterweight: mass * radius * machine.wide",
    "verify_weights.py counterweight: mass * radius * fastest * machine.wide",
    "verify_weights.py shafts: on_shaft * machine.wide",
    "verify_weights.py shafts: mass * machine.wide",
)
#: numbers that count the smallest steps, of which the smallest double is many
_STEPS = (
    "verify_answer.py gaps: size.low > 0",
    "verify_claims.py _share: size.high > 0",
    "verify_curves.py on_shaft: upright.low <= 0",
    "verify_cuts.py __init__: weights['roll'].high > 0",
    "verify_cuts.py term: self.weights[kind].high <= 0",
    "verify_first.py optimum: weight.high > 0",
    "verify_first.py lightest: least.low <= 0",
    "verify_first.py yardstick: rest.low > 0",
    "verify_first.py near_the_bound: (above - SPECK * most).low <= 0",
    "verify_machine.py web_of: per_kg.low <= 0",
    "verify_machine.py over: by.low <= 0",
    "verify_front.py point: size.low > 0",
    "verify_match.py _gap: size.low > 0",
    "verify_misplacement.py __init__: u.product.high > 0",
    "verify_multipliers.py __init__: self.off.share.high > 0",
    "verify_multipliers.py __init__: self.off.besides.high > 0",
    "verify_multipliers.py __init__: weight.high > 0",
    "verify_multipliers.py bound: value.low > 0",
    "verify_multipliers.py _add: size.low > 0",
    "verify_multipliers.py _add_ceilings: abs(p).high <= 0",
    "verify_multipliers.py within_limits: gain.high <= 0",
    "verify_orders.py floor: abs(plane - machine.plane).low > 0",
    "verify_program.py _size: size.low > 0",
    "verify_program.py _size: arm.low > 0",
    "verify_program.py _size: abs(term.factor).low > 0",
    "verify_program.py _size: other.low > 0",
    "verify_program.py bound: total(rows.values()).low <= 0",
    "verify_program.py bound: price.low > 0",
    "verify_program.py bound: gain.high > 0",
    "verify_program.py bound: price.high > 0",
    "verify_program.py _multipliers: row.high > 0",
    "verify_program.py _multipliers: abs(vector).high > 0",
    "verify_program.py _balance: term.factor.low > 0",
    "verify_program.py _balance: abs(slope[name]).high > 0",
    "verify_program.py lightest: limit.high > 0",
    "verify_program.py lightest: does.low > 0",
    "verify_worth.py of_plate: pull.high <= 0",
    "verify_worth.py of_plate: web.limit.high <= 0",
    "verify_turn.py over_turn: (least.number() - machine.fixed).low <= 0",
    "verify_weights.py counterweight: mass.high > 0",
    "verify_weights.py _alike: (entry / 'mass_kg').number().high > 0",
    "verify_weights.py heavy_enough: mass.high > 0",
    "verify_weights.py catalogue: mass.high <= 0",
)
_VERIFY |= _with(_TO_BOTH_SIDES, " + ", " - ", "an interval around 0 is its own negative")
_VERIFY |= _with(_ABOUT_ONE, " * ", " / ", "it is 1 with its rounding to both sides")
_VERIFY |= _with(_STEPS, "0", "1", "it counts the smallest steps of numbers")
_SERVICE: dict[str, str] = {
    "guard/keys.py caller: record.expires < time.time() -> record.expires <= time.time()": "no clock stands still",
    "guard/keys.py _stamped": "no file is of such a time: it tells that there is none",
    "jobs/coordinator.py _AT_A_TIME": _SPEED,
    "jobs/coordinator.py _begin: 0 -> 1": "of a chunk of rows it is not read: a selection alone covers any",
    "jobs/coordinator.py _collect_rows: len(came) > _AT_A_TIME -> len(came) >= _AT_A_TIME": _SPEED,
    "jobs/coordinator.py stop: self._thread.join(6) -> self._thread.join(7)": _FINER,
    "report/chapters/bearing_loci.py _on_shaft: -1j * sense -> -1j / sense": "a sense is 1 or -1",
    "report/charts.py hodograph: ellipse.major / factor * (x.end - x.start) / (x.high - x.low) < _DOT"
    " -> ellipse.major / factor * (x.end - x.start) / (x.high - x.low) <= _DOT": _ALIKE,
    "report/charts.py chart: place[0] + 22 -> place[0] + 23": _LOOKS,
    "report/accuracy_picture.py _axes: 0.8 -> 0.809": _LOOKS,
    "report/charts.py _ends: 0.03 * (high - low) -> 0.0313 * (high - low)": _LOOKS,
    "report/scatter.py _LEFT: (72.0, 14.0, 34.0, 320.0) -> (72.721, 14.0, 34.0, 320.0)": _LOOKS,
    "report/scatter.py scatter: drawing.line([(x, _TOP), (x, bottom + 4)], FAINT, 0.8)"
    " -> drawing.line([(x, _TOP), (x, bottom + 4)], FAINT, 0.809)": _LOOKS,
    "report/stage_scheme.py _vector: vector.direction_deg + 180.0 -> vector.direction_deg - 180.0": _ALIKE,
}
#: `file of: fault`, of the function or name that it stands in; without a fault all that stands there
EQUAL = {
    f"{folder}/{where}": why
    for folder, mechanics in (
        ("optimizer/mechanics", _MECHANICS),
        ("optimizer/program", _PROGRAM),
        ("optimizer/formulation", _FORMULATION),
        ("examples/client", _VERIFY),
        ("service", _SERVICE),
    )
    for where, why in mechanics.items()
}
