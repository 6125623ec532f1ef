"""A machine as a workbook, to begin with."""

import json

from service.documents.examples import load

#: in place of the name of an example: heads alone, to be filled in
EMPTY = "empty"
_FIELDS = ("machine.kind", "machine.name", "machine.speed_rpm", "machine.rotation", "objective.moment_weight")
_HEADS = {
    "throws": ("name", "position_m", "crank_radius_m", "crank_angle_deg", "rotating_mass_kg"),
    "rows": (
        "throw",
        "name",
        "axis_deg",
        "reciprocating_mass_kg",
        "connecting_rod.length_m",
        "connecting_rod.mass_kg",
        "connecting_rod.reciprocating_share",
    ),
    "webs": (
        "name",
        "position_m",
        "counterweight_radius_m",
        "max_mass_kg",
        "sector.centre_deg",
        "sector.half_angle_deg",
    ),
    "bearings": ("name", "position_m", "diameter_m", "length_m"),
}


def template(name: str) -> bytes:
    """An example as a workbook, or the heads of one that holds no machine yet.

    Raises
    ------
    UnknownExample
        if there is none of this name.
    """
    # only who asks for one pays for the library
    from service.workbook.files import workbook
    from service.workbook.sheets import Sheets, request_sheets

    if name != EMPTY:
        return workbook(request_sheets(json.loads(load(name))))
    values = {"machine.kind": "reciprocating"}
    fields: Sheets = {"machine": [["field", "value"]]}
    for field in _FIELDS:
        fields["machine"].append([field, values.get(field)])
    return workbook(fields | {sheet: [list(heads)] for sheet, heads in _HEADS.items()})
