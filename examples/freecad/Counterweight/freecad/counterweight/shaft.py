"""The shaft that faces show: one question to the service, and the tables that a designer completes. No CAD."""

from __future__ import annotations

from typing import Any, Dict, List, Mapping

from .asking import unanswered
from .service import Refused, Service
from .sheets import MACHINE, ROD, ROWS, THROW, THROWS, USE, WEBS, Table, Wrong, table

_ROW_HEADS = (
    THROW, "name", "axis_deg", "reciprocating_mass_kg", "connecting_rod.length_m", "connecting_rod.mass_kg",
    "connecting_rod.reciprocating_share", ROD,
)  # fmt: skip
#: angle on both sides that a plate may take until the designer says another
_HALF_ANGLE_DEG = 90


def ask_shaft(service: Service, question: Mapping[str, Any]) -> Dict[str, Any]:
    """The shaft that faces and bodies show.

    Raises
    ------
    Wrong
        if they show none.
    """
    try:
        return service.shaft(question)
    except Refused as refused:
        lines = [f"{place(question, pointer)}: {message}" for pointer, message in refused.fields.items()]
        raise Wrong([f"no crankshaft: {line}" for line in lines] or [str(refused)]) from None
    except (OSError, ValueError) as error:
        raise unanswered(service, error) from None


def place(question: Mapping[str, Any], pointer: str) -> str:
    """The face or the body that a pointer is about, by its name in the document."""
    _, *keys = pointer.split("/")
    if len(keys) > 1 and keys[0] in ("faces", "bodies") and keys[1].isdigit():
        return str(question[keys[0]][int(keys[1])]["name"])
    return "the selected bodies"


def doubts(question: Mapping[str, Any], answer: Mapping[str, Any], serious: bool) -> List[str]:
    """What the designer should look at, in words; or what has to be corrected first."""
    doubts = (doubt for doubt in answer["doubts"] if doubt["serious"] == serious)
    return [f"{place(question, entry['pointer'])}: {entry['message']}" for entry in doubts]


def tables(answer: Mapping[str, Any], density_kg_m3: float) -> Dict[str, Table]:
    """What the faces show, as the tables that the designer completes; a web without an envelope is not used."""
    throws = [{USE: "yes", **throw} for throw in answer[THROWS]]
    envelopes = {web["name"]: web["envelope"] for web in answer[WEBS]}
    webs = []
    for number, plate in enumerate(answer["plates"], start=1):
        envelope = envelopes.get(plate["web"], {})
        webs.append(
            {
                USE: "yes" if envelope else "no",
                "name": plate["web"] or f"web {number}",
                "position_m": (plate["from_m"] + plate["to_m"]) / 2,
                "envelope.shape": "sector",
                "envelope.inner_radius_m": envelope.get("inner_radius_m"),
                "envelope.outer_radius_m": envelope.get("outer_radius_m"),
                "envelope.thickness_m": plate["thickness_m"],
                "envelope.density_kg_m3": density_kg_m3,
                "envelope.max_half_angle_deg": _HALF_ANGLE_DEG,
            }
        )
    rows = [{THROW: throw["name"], "name": throw["name"], "axis_deg": 0} for throw in throws]
    return {
        MACHINE: [["field", "value"], ["machine.name", "from CAD"], ["machine.speed_rpm", None]],
        THROWS: table([USE, "name", "position_m", "crank_radius_m", "crank_angle_deg"], throws),
        ROWS: table(_ROW_HEADS, rows),
        WEBS: table(list(webs[0]) if webs else [USE, "name", "position_m"], webs),
    }
