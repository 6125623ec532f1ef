"""Faults that change nothing of what is promised, each with the reason: they are not put in."""

_STEERS = "it leads a search: every point is judged, and every bound proven, by what does not depend on it"
_SPEED = "it says how the same is computed, and how fast"
_ALIKE = "both come to the same there"
_FINER = "finer or coarser than is needed, within what is told of it"
_LOOKS = "a hundredth of the width of a line: nobody can see it"
_MECHANICS: dict[str, str] = {
    "bearings.py bending_moment: terms(-1.0) < terms(1.0) -> terms(-1.0) <= terms(1.0)": _ALIKE,
    "bearings.py bending_moment: 1.0 -> 1.011": "the moment is the same from either side",
    "curve_series.py _about: curve.size * rows > _FEW -> curve.size * rows >= _FEW": _SPEED,
    "row_data.py _opened: 1.0 -> 1.011": "of open sides nothing is used",
    "row_work.py beside_mean: own < 0.5 * TURN -> own <= 0.5 * TURN": _ALIKE,
    "turn.py _NODES": _FINER,
    "whole_turn.py _LEFT_OUT": _FINER,
    "whole_turn.py _parts": _FINER,
}
_PROGRAM: dict[str, str] = {
    "certificate.py spread: not ceilings.scatter -> not not ceilings.scatter": _SPEED,
    "cuts/attempts.py FREELY": _STEERS,
    "cuts/attempts.py WITHIN": _STEERS,
    "cuts/cut.py alike: max -> min": _ALIKE,
    "cuts/optimum.py _nearest: 0.5 * -bound -> 0.5 / -bound": _STEERS,
    "cuts/row_generation.py single_group: max -> min": _SPEED,
    "cuts/samples.py maxima: np.argmax(around, axis=-1) - 1 -> np.argmax(around, axis=-1) + 1": _STEERS,
    "cuts/samples.py supports: abs(circle.radius - before) > _STEADY * circle.radius"
    " -> abs(circle.radius - before) >= _STEADY * circle.radius": _ALIKE,
    "cuts/stage.py run: 0.0 -> 0.001": _STEERS,
    "methods/cascade.py _under_ceilings: nearest.objective <= -AMPLE -> nearest.objective < -AMPLE": _ALIKE,
    "methods/compiled.py _solve: 0 -> 1": _STEERS,
    "methods/compiled.py plain_discs: 0 -> 1": _SPEED,
    "methods/rounding.py _RUNGS": _STEERS,
}
_FORMULATION: dict[str, str] = {
    "counterweights.py _ABOVE_ENVELOPE": _FINER,
    "groups.py _masses: mass is not None and angle is None -> mass is not None or angle is None": "angles are"
    " compared with their masses beside",
}
_SERVICE: dict[str, str] = {
    "guard/keys.py caller: record.expires < time.time() -> record.expires <= time.time()": "no clock stands still",
    "jobs/coordinator.py _AT_A_TIME": _SPEED,
    "jobs/coordinator.py _collect_rows: len(came) > _AT_A_TIME -> len(came) >= _AT_A_TIME": _SPEED,
    "jobs/coordinator.py stop: 6 -> 7": _FINER,
    "report/accuracy_picture.py _axes: 0.8 -> 0.809": _LOOKS,
}
#: `file of: fault`, of the function or name that it stands in; without a fault all that stands there
EQUAL = {
    f"{folder}/{where}": why
    for folder, each in (
        ("optimizer/mechanics", _MECHANICS),
        ("optimizer/program", _PROGRAM),
        ("optimizer/formulation", _FORMULATION),
        ("service", _SERVICE),
    )
    for where, why in each.items()
}
