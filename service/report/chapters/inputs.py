"""The request: the machine, the places for counterweights, the objective."""

from collections.abc import Iterator, Sequence

from optimizer.formulation.formulate import span
from schemas.machine.catalogue import Catalogue
from schemas.machine.choices import KINDS as CHOICES
from schemas.machine.choices import stated
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.machine.scroll_machine import ScrollMachine
from schemas.machine.throws import Row, Throw, row_cylinders
from schemas.machine.webs import Web
from schemas.request.requests import OptimizeRequest
from schemas.scroll.over_turn import ForceTable, TorqueTable
from service.common.figures import digits
from service.report.blocks import Block, Cell, Chapter, Paragraph, Table, facts, table
from service.report.chapters.cylinders import cylinders
from service.report.chapters.objective import objective
from service.report.chapters.worst_case import stated_cases


def inputs(request: OptimizeRequest, reference_plane_m: float) -> Chapter:
    """Everything that the request says, in SI units, defaults filled in."""
    machine = request.machine
    blocks: list[Block] = []
    if machine.description:
        blocks.append(Paragraph(machine.description))
    blocks.append(_general(machine, reference_plane_m))
    if isinstance(machine, ReciprocatingMachine):
        blocks += _reciprocating(machine)
    else:
        blocks.append(_scroll(machine))
    blocks += [
        *_unbalances(machine),
        _webs(machine),
        *_groups(machine),
        *_balance_shafts(machine),
        objective(request),
        *stated_cases(request),
    ]
    return Chapter("Inputs", tuple(blocks))


def _general(machine: Machine, reference_plane_m: float) -> Table:
    presence = machine.reference_plane_m is not None
    return facts(
        "Machine",
        [
            ("kind", machine.kind),
            ("speed, rpm", machine.speed_rpm),
            *_limit("largest speed, at which bolts hold, rpm", machine.overspeed_rpm),
            ("sense of rotation, seen from +z", machine.rotation),
            ("reference plane of the moments z, m", reference_plane_m),
            ("reference plane", "as given" if presence else "midway between the outermost throws"),
            ("axial span of throws and webs, m", float(span(machine))),
            *_limit("largest total mass of counterweights, kg", machine.max_total_mass_kg),
            *_catalogue(machine),
        ],
    )


def _catalogue(machine: Machine) -> Iterator[tuple[str, Cell | float]]:
    """The options of counterweights, if they have any."""
    if not machine.discrete:
        return
    general = machine.catalogue or Catalogue()
    if general.masses_kg is not None:
        yield "masses that there are, kg", ", ".join(f"{mass:g}" for mass in general.masses_kg)
    if general.mass_step_kg is not None:
        yield "step of masses, kg", general.mass_step_kg
    if general.angle_step_deg is not None:
        yield "step of angles from the crank, deg", general.angle_step_deg
    for web in machine.every_web:
        for name in stated(web):
            kind = CHOICES[name]
            yield (
                kind.label.format(web.name),
                ", ".join(kind.text.format(*option) for option in kind.options(getattr(web, name))),
            )
    yield from _limit("most counterweights", machine.max_counterweights)
    yield from _limit("most part numbers", general.max_part_numbers)


def _limit(title: str, value: float | None) -> Iterator[tuple[str, float]]:
    """A limit, where there is one."""
    if value is not None:
        yield title, value


def throw_name(throw: Throw, number: int) -> str:
    return throw.name or str(number + 1)


def row_name(machine: Machine, throw: int, row: int) -> str:
    """A row as the charts and tables call it: its name, with that of its throw where names repeat."""
    if not isinstance(machine, ReciprocatingMachine):
        return "ring"
    names = [bank.name for crank in machine.throws for bank in crank.rows]
    name = machine.throws[throw].rows[row].name
    if name is not None and names.count(name) == 1:
        return name
    return f"{throw_name(machine.throws[throw], throw)}-{name or row + 1}"


def _reciprocating(machine: ReciprocatingMachine) -> Iterator[Block]:
    yield table(
        "Throws",
        ["throw", "#plane z, m", "#crank radius, m", "#crank angle, deg", "#rotating mass, kg"],
        [
            (
                throw_name(throw, number),
                throw.position_m,
                throw.crank_radius_m,
                throw.crank_angle_deg,
                throw.rotating_mass_kg,
            )
            for number, throw in enumerate(machine.throws)
        ],
    )
    rows = [
        (throw_name(throw, t), row_name(machine, t, r), throw.position_m + row.offset_m, row)
        for t, throw in enumerate(machine.throws)
        for r, row in enumerate(throw.rows)
    ]
    if rows:
        yield table(
            "Rows",
            [
                "throw", "row", "#plane z, m", "#axis, deg", "#reciprocating mass, kg", "#rod length, m",
                "#rod mass, kg", "#share reciprocating",
            ],
            [
                (throw, name, plane, row.axis_deg, row.reciprocating_mass_kg, *_rod(row))
                for throw, name, plane, row in rows
            ],
        )  # fmt: skip
    parts = [(name, part.name, part.mass_kg, part.motion) for _, name, _, row in rows for part in row.parts]
    if parts:
        yield table("Parts of the rows", ["row", "part", "#mass, kg", "motion"], parts)
    if machine.shaft_parts:
        turning = [(part.name, part.position_m, part.mass_kg) for part in machine.shaft_parts]
        yield table("Balanced parts of the shaft", ["part", "#plane z, m", "#mass, kg"], turning)
    entries = [
        (
            name
            if at == ("cylinder",)
            else f"{name}, {getattr(cylinder, 'name', None) or f'cylinder {int(at[-1]) + 1}'}",
            cylinder,
        )
        for _, name, _, row in rows
        for at, cylinder in row_cylinders(row)
    ]
    if entries:
        yield from cylinders(entries)
    yield from _drive(machine)


def _rod(row: Row) -> tuple[Cell | float | None, float | None, float | None]:
    rod = row.connecting_rod
    if rod is None:
        return None, None, None
    return "infinite" if rod.length_m is None else rod.length_m, rod.mass_kg, rod.share


def _drive(machine: ReciprocatingMachine) -> Iterator[Block]:
    friction, flywheel = machine.friction, machine.flywheel
    rows: list[tuple[str, Cell | float | None]] = []
    if friction is not None:
        rows += [
            ("mechanical efficiency", friction.mechanical_efficiency),
            ("share of the losses in the rows", friction.reciprocating_share),
            ("indicated power of the rows, W", _list(friction.indicated_power_W)),
            ("friction force of the rows, N", _list(friction.reciprocating_force_N)),
            ("friction torque of the shaft, N m", friction.rotating_torque_Nm),
        ]
    if flywheel is not None:
        rows += [("irregularity allowed", flywheel.irregularity), ("turning inertia, kg m2", flywheel.inertia_kg_m2)]
    entries = [row for row in rows if row[1] is not None]
    if entries:
        yield facts("Friction and flywheel", entries)
    if machine.bearings:
        heads = ["bearing", "#plane z, m"]
        rows_of: list[tuple[str | float | None, ...]] = [
            (bearing.name, bearing.position_m) for bearing in machine.bearings
        ]
        if any(bearing.diameter_m is not None or bearing.length_m is not None for bearing in machine.bearings):
            heads += ["#diameter, m", "#length, m"]
            rows_of = [
                (*row, bearing.diameter_m, bearing.length_m)
                for row, bearing in zip(rows_of, machine.bearings, strict=True)
            ]
        yield table("Main bearings", heads, rows_of)


def _list(values: tuple[float, ...] | None) -> str | None:
    return None if values is None else ", ".join(map(digits, values))


def _scroll(machine: ScrollMachine) -> Table:
    guide = machine.anti_rotation
    rows: list[tuple[str, Cell | float | None]] = [
        ("orbit radius, m", machine.orbit_radius_m),
        ("orbiting mass, kg", machine.orbiting_mass_kg),
        ("plane of the orbiting scroll z, m", machine.orbiting_position_m),
    ]
    if guide.type == "oldham":
        rows += [
            ("anti-rotation", "Oldham ring"),
            ("mass of the ring, kg", guide.mass_kg),
            ("direction in which the ring slides, deg", guide.axis_deg),
            ("plane of the ring z, m", guide.position_m),
        ]
    else:
        rows += [
            ("anti-rotation", "crank pins"),
            ("number of pins", guide.count),
            ("pin circle radius, m", guide.pin_circle_radius_m),
            ("eccentric mass of one pin, kg", guide.eccentric_mass_kg),
            ("plane of the pins z, m", guide.position_m),
        ]
    torque, force = machine.rotation_torque_Nm, machine.tangential_gas_force_N
    if torque is not None:
        rows.append(("rotation torque, N m", _over_turn(torque)))
    if force is not None:
        rows.append(("tangential gas force, N", _over_turn(force)))
    return facts("Scroll", rows)


def _over_turn(value: float | TorqueTable | ForceTable) -> Cell | float:
    if isinstance(value, float | int):
        return value
    values = value.torque_Nm if isinstance(value, TorqueTable) else value.force_N
    return f"table of {len(values)} angles, {digits(min(values))} to {digits(max(values))}"


def _unbalances(machine: Machine) -> Iterator[Block]:
    if machine.unbalances:
        yield table(
            "Unbalances of the shaft itself",
            ["unbalance", "#plane z, m", "#x, kg m", "#y, kg m"],
            [
                (unbalance.name, unbalance.position_m, unbalance.x_kg_m, unbalance.y_kg_m)
                for unbalance in machine.unbalances
            ],
        )


def _groups(machine: Machine) -> Iterator[Block]:
    if machine.web_groups:
        yield table(
            "Identical castings, each in the same place on its own crank",
            ["group", "webs"],
            [
                (
                    group.name,
                    ", ".join(f"{web} mirrored" if group.mirrors(n) else web for n, web in enumerate(group.webs)),
                )
                for group in machine.web_groups
            ],
        )


def _webs(machine: Machine) -> Block:
    if not machine.webs:
        return Paragraph("The crankshaft has no place for counterweights.", "warning")
    return _places("Places for counterweights", machine.webs)


def _balance_shafts(machine: Machine) -> Iterator[Block]:
    if isinstance(machine, ReciprocatingMachine):
        for shaft in machine.balance_shafts:
            where = f"{shaft.speed_ratio:+d} times the crankshaft's speed, at x {shaft.x_m:g} m, y {shaft.y_m:g} m"
            yield _places(f"Places on balance shaft {shaft.name}, {where}", shaft.webs)


def _places(title: str, webs: Sequence[Web]) -> Table:
    heads = [
        "web", "#plane z, m", "#radius of the centre of mass, m", "#largest mass, kg", "#sector centre, deg",
        "#sector half angle, deg",
    ]  # fmt: skip
    rows: list[tuple[Cell | float | None, ...]] = [
        (
            web.name,
            web.position_m,
            *_place(web),
            *(("any angle", "") if web.sector is None else (web.sector.centre_deg, web.sector.half_angle_deg)),
        )
        for web in webs
    ]
    least = [web.min_fitted_mass_kg for web in webs]
    if any(least):
        heads.append("#smallest fitted mass, kg")
        rows = [(*row, mass) for row, mass in zip(rows, least, strict=True)]
    forces = [web.max_centrifugal_force_N for web in webs]
    if any(forces):
        heads.append("#largest centrifugal force, N")
        rows = [(*row, force) for row, force in zip(rows, forces, strict=True)]
    return table(title, heads, rows)


def _place(web: Web) -> tuple[Cell | float, Cell | float]:
    """Radius and largest mass, or the plate that both follow from."""
    plate = web.envelope
    if web.fixed is not None:
        return web.radius_m or 0.0, f"fixed: {digits(web.fixed.mass_kg)} kg at {digits(web.fixed.angle_deg)}°"
    if plate is None:
        return web.radius_m or 0.0, "no limit" if web.max_mass_kg is None else web.max_mass_kg
    cut = f"{plate.shape}, radii {digits(plate.inner_radius_m)} to {digits(plate.outer_radius_m)} m"
    return cut, f"{digits(plate.thickness_m)} m thick, half angle to {digits(plate.max_half_angle_deg)}°"
