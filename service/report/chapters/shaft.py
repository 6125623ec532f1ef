"""The crankshaft that faces and bodies show: throws, webs, bearings, unbalance, and what to look at."""

from collections.abc import Iterator

from schemas.answer.shaft import ShaftAnswer
from schemas.request.shaft import ShaftRequest
from service.report.blocks import Chapter, Paragraph, facts, table


def shaft(request: ShaftRequest, answer: ShaftAnswer) -> Iterator[Chapter]:
    """The answer to a request."""
    serious = sum(doubt.serious for doubt in answer.doubts)
    if serious:
        yield Chapter("Verdict", (Paragraph(f"Serious doubts: {serious}. Correct the model first.", "warning"),))
    frame = answer.frame
    vectors = (("origin, m", frame.origin_m), ("x", frame.x), ("y", frame.y), ("z, the axis", frame.z))
    rows = [(name, x, y, z) for name, (x, y, z) in vectors]
    yield Chapter("Frame of the shaft, in the model", (table("", ["", "#x", "#y", "#z"], rows),))
    if answer.throws:
        throws = [
            (throw.name, throw.position_m, throw.crank_radius_m, throw.crank_angle_deg, pin.diameter_m)
            for throw, pin in zip(answer.throws, answer.pins, strict=True)
        ]
        heads = ["throw", "#position, m", "#crank radius, m", "#crank angle, deg", "#pin diameter, m"]
        yield Chapter("Throws", (table("", heads, throws),))
    if answer.plates:
        plates = [
            (
                plate.web or "no envelope",
                (plate.from_m + plate.to_m) / 2,
                plate.thickness_m,
                "not known" if plate.hub_m is None else plate.hub_m,
                "not known" if plate.reach_m is None else plate.reach_m,
            )
            for plate in answer.plates
        ]
        heads = ["web", "#position, m", "#thickness, m", "#reach opposite its crank, m", "#reach, m"]
        yield Chapter("Webs", (table("", heads, plates),))
    if answer.bearings:
        journals = [
            (bearing.name, bearing.position_m, bearing.diameter_m, bearing.length_m) for bearing in answer.bearings
        ]
        yield Chapter("Bearings", (table("", ["bearing", "#position, m", "#diameter, m", "#length, m"], journals),))
    if answer.rotor is not None:
        mass = facts("", [("mass, kg", answer.rotor.mass_kg), ("unbalance, kg m", answer.rotor.unbalance_kg_m)])
        planes = [
            (unbalance.name, unbalance.position_m, unbalance.x_kg_m, unbalance.y_kg_m)
            for unbalance in answer.unbalances
        ]
        unbalances = table("In two planes", ["plane", "#position, m", "#x, kg m", "#y, kg m"], planes)
        yield Chapter("Unbalance of the bodies", (mass, unbalances))
    if answer.doubts:
        doubts = [(_name(request, doubt.pointer), doubt.code, doubt.message) for doubt in answer.doubts]
        yield Chapter("What to look at", (table("", ["face or body", "about", "<what was seen"], doubts),))


def _name(request: ShaftRequest, pointer: str) -> str:
    """Where a doubt points, with the name that the CAD gives it."""
    _, kind, number = pointer.split("/")
    name = (request.faces if kind == "faces" else request.bodies)[int(number)].name
    return pointer if name is None else f"{name} ({pointer})"
