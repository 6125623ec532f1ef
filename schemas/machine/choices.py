"""The fields of a web with finitely many options for its counterweight: every kind of choice.

One more kind is one more field of :class:`schemas.machine.webs.Web` and one more entry here. All that looks at choices
goes by this table: rules, options, equal castings, refusals of studies, reports.
"""

from collections.abc import Callable, Iterator
from typing import Any, Literal, NamedTuple

from schemas.base.rules import Rule
from schemas.machine.catalogue import in_sector, masses_rules

#: mass [kg] and angle [deg, as drawn at shaft angle 0]; None is left to the catalogue
Option = tuple[float | None, float | None]


class ChoiceKind(NamedTuple):
    """What a field of a web says.

    says : what every option of it says.
    options : what its contents allow.
    rules : what is wrong with its contents, and with them in its web; paths from the web.
    label : in a report, after which the options stand.
    text : an option in a report.
    """

    says: Literal["mass", "angle", "both"]
    options: Callable[[Any], list[Option]]
    rules: Callable[[Any, Any], Iterator[Rule]]
    label: str
    text: str


class OwnOptions(NamedTuple):
    """What a web says of its masses [kg], of its angles [deg], and of both at once; None where it says nothing."""

    masses: tuple[float, ...] | None
    angles: tuple[float, ...] | None
    pairs: tuple[tuple[float, float], ...] | None


def _masses(masses: Any, _: Any) -> Iterator[Rule]:
    return masses_rules(("catalogue_masses_kg",), masses)


def _holes(angles: Any, web: Any) -> Iterator[Rule]:
    path = ("hole_angles_deg",)
    yield Rule(not angles, path, "must hold at least one angle")
    earlier: set[float] = set()
    for n, angle in enumerate(angles):
        yield Rule(angle % 360.0 in earlier, (*path, n), "this hole is in the list already")
        earlier.add(angle % 360.0)
        yield from sector_rules((*path, n), angle, web, "this hole")


def sector_rules(path: tuple[str | int, ...], angle_deg: Any, web: Any, subject: str) -> Iterator[Rule]:
    """Every option stands in the sector of its web."""
    if web.sector is not None:
        inside = in_sector(angle_deg, web.sector.centre_deg, web.sector.half_angle_deg)
        yield Rule(not inside, path, f"{subject} is outside the sector")


#: by field of a web
KINDS: dict[str, ChoiceKind] = {
    "catalogue_masses_kg": ChoiceKind(
        "mass", lambda masses: [(mass, None) for mass in masses], _masses, "masses of {}, kg", "{0:g}"
    ),
    "hole_angles_deg": ChoiceKind(
        "angle", lambda angles: [(None, angle) for angle in angles], _holes, "holes of {}, deg", "{1:g}"
    ),
    # beside these two
}
#: fields of which a web that states none is of any mass at any angle
CHOICE_FIELDS = frozenset({*KINDS, "min_fitted_mass_kg"})


def stated(web: Any) -> list[str]:
    """Fields of a web with options for its counterweight."""
    if KINDS.keys().isdisjoint(web.model_fields_set):
        return []
    return [name for name in KINDS if getattr(web, name) is not None]


def own_options(web: Any) -> OwnOptions:
    """What all of these fields of a web say."""
    parts = {KINDS[name].says for name in stated(web)}
    every = [option for name in stated(web) for option in KINDS[name].options(getattr(web, name))]
    masses = tuple(mass for mass, angle in every if mass is not None and angle is None)
    angles = tuple(angle for mass, angle in every if mass is None and angle is not None)
    pairs = tuple((mass, angle) for mass, angle in every if mass is not None and angle is not None)
    # an empty list leaves no option
    return OwnOptions(
        masses if "mass" in parts else None, angles if "angle" in parts else None, pairs if "both" in parts else None
    )
