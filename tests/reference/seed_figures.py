"""The figures of seed_checks.json, and how their rows become a layout or a machine."""

import json
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from optimizer.mechanics.angles import direction
from optimizer.mechanics.layout import Layout, Reciprocating, Rotating, Webs, layout
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.machine.throws import ConnectingRod, Row, Throw

_FILE = json.loads((Path(__file__).parent / "seed_checks.json").read_text())
RTOL, ATOL = _FILE["rtol"], _FILE["atol"]
THETA = np.deg2rad(_FILE["theta_deg"])


def checks(topic: str) -> list[Any]:
    """Parameters of one topic, each with its label (published or analytic) in its name."""
    return [pytest.param(c, id=f"{c['label']}-{c['id']}") for c in _FILE["checks"] if c["topic"] == topic]


def check(name: str) -> Any:
    """Inputs and expected figures of one check."""
    check = next(c for c in _FILE["checks"] if c["id"] == name)
    return check["inputs"], check["expected"]


def as_arrays(inputs: Any) -> Layout:
    """The rows as a layout, written down by hand."""
    mass, rotating_mass, radius, ratio, axis, crank, z = np.array(inputs["rows"], dtype=float).T
    crank_direction = direction(inputs["rot"] * crank)
    return Layout(
        omega=np.asarray(inputs["omega"]),
        sense=np.asarray(float(inputs["rot"])),
        centre_plane=np.asarray(0.5 * (z.min() + z.max())),
        reference_plane=np.asarray(inputs["z_ref"]),
        rotating=Rotating(rotating_mass, radius, crank_direction, z),
        reciprocating=Reciprocating(mass, radius, crank_direction, direction(axis), z, ratio),
        webs=Webs(np.zeros(0), np.zeros(0)),
    )


def as_machine(inputs: Any) -> Layout:
    """The rows as a machine that a client would post; rows on one pin share a throw."""
    throws = []
    for (radius, crank, z), group in groupby(inputs["rows"], key=lambda r: (r[2], r[5], r[6])):
        members = list(group)
        rows = tuple(
            Row(
                axis_deg=axis,
                reciprocating_mass_kg=mass,
                connecting_rod=ConnectingRod(length_m=radius / ratio),
            )
            for mass, _, _, ratio, axis, _, _ in members
        )
        throws.append(
            Throw(
                position_m=z,
                crank_radius_m=radius,
                crank_angle_deg=inputs["rot"] * crank,
                rotating_mass_kg=sum(member[1] for member in members),
                rows=rows,
            )
        )
    return layout(
        ReciprocatingMachine(
            kind="reciprocating",
            speed_rpm=inputs["omega"] * 30.0 / np.pi,
            rotation="ccw" if inputs["rot"] > 0 else "cw",
            reference_plane_m=inputs["z_ref"],
            throws=tuple(throws),
        )
    )
