"""First-order force and moment drawn: the ellipses of before and after, and the circle that none can fall below."""

from optimizer.formulation.formulate import span
from schemas.answer.first_order import FirstOrder, Floor
from schemas.machine.machine import Machine
from service.drawings.svg import Drawing
from service.report import charts

#: the hodographs reach at least to this share of force and moment without counterweights taken together
_VISIBLE = 1e-3


def hodographs(
    machine: Machine,
    was: FirstOrder,
    left: FirstOrder | None,
    floor: Floor,
    label: str,
    built: FirstOrder | None = None,
) -> tuple[Drawing, Drawing]:
    """Hodographs of force and moment, N and N m.

    Parameters
    ----------
    left : with counterweights, if there are any.
    label : what these are.
    built : with what is fitted, if anything is.
    """
    name = f"{label}: peak"
    force, moment = was.force, was.moment
    forces = [charts.before(force.peak_N, force.minor_N, force.major_axis_deg)]
    moments = [charts.before(moment.peak_Nm, moment.minor_Nm, moment.major_axis_deg)]
    if left is not None:
        force, moment = left.force, left.moment
        forces.append(charts.after(name, force.peak_N, force.minor_N, force.major_axis_deg))
        moments.append(charts.after(name, moment.peak_Nm, moment.minor_Nm, moment.major_axis_deg))
    if built is not None:
        force, moment = built.force, built.moment
        forces.append(charts.as_built(force.peak_N, force.minor_N, force.major_axis_deg))
        moments.append(charts.as_built(moment.peak_Nm, moment.minor_Nm, moment.major_axis_deg))
    length = float(span(machine)) or 1.0
    reach = _VISIBLE * (was.force.peak_N + was.moment.peak_Nm / length)
    forces.append(charts.floor(floor.force_N))
    moments.append(charts.floor(floor.moment_Nm))
    return (
        charts.hodograph("force", "N", forces, reach),
        charts.hodograph("moment", "N m", moments, reach * length, charts.COUPLE_AXES),
    )
