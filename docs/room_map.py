"""Draw the rooms of the packages from their imports: ``python docs/room_map.py`` writes picture and table."""

import ast
from collections.abc import Iterator, Mapping
from html import escape
from pathlib import Path

ROOT = Path(__file__).parents[1]
PICTURE, PAGE = ROOT / "docs" / "rooms.svg", ROOT / "docs" / "architecture.md"
BEGIN, END = "<!-- rooms: written by docs/room_map.py -->\n", "<!-- /rooms -->\n"
#: from the top of the picture to its foot; the colours of their bands
PACKAGES = {"service": "#eef4fb", "optimizer": "#f3f8ee", "schemas": "#fbf4e8"}

Imports = Mapping[str, frozenset[str]]

_CHARACTER, _BOX, _GAP, _FLOOR, _MARGIN, _TITLE = 6.9, 24, 16, 54, 20, 26


def room(module: str) -> str | None:
    """The room of a dotted module, `package.room`; None outside the packages and for a package itself."""
    parts = module.split(".")
    return ".".join(parts[:2]) if parts[0] in PACKAGES and len(parts) > 1 else None


def imports() -> Imports:
    """Every room with the rooms that its files import, at the top of a file or inside a function."""
    rooms: dict[str, set[str]] = {}
    for package in PACKAGES:
        for path in sorted((ROOT / package).rglob("*.py")):
            own = room(".".join(path.relative_to(ROOT).with_suffix("").parts))
            if own is not None and not own.endswith(".__init__"):
                rooms.setdefault(own, set()).update(_imported(path) - {own})
    return {name: frozenset(targets & rooms.keys()) for name, targets in rooms.items()}


def _imported(path: Path) -> set[str]:
    rooms = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            modules = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.module:
            # of a package itself what is imported are its rooms, or names of its own
            modules = [f"{node.module}.{alias.name}" for alias in node.names]
        else:
            continue
        rooms.update(name for name in map(room, modules) if name is not None)
    return rooms


def within(package: str, arrows: Imports) -> Imports:
    """The rooms of one package, and the imports between them."""
    return {
        name: frozenset(target for target in targets if target.startswith(f"{package}."))
        for name, targets in arrows.items()
        if name.startswith(f"{package}.")
    }


def floors(arrows: Imports) -> dict[str, int]:
    """The length of the longest chain of imports below each room.

    Raises
    ------
    ValueError
        if rooms import each other in a circle.
    """
    heights: dict[str, int] = {}
    while len(heights) < len(arrows):
        ready = [name for name, targets in arrows.items() if name not in heights and targets <= heights.keys()]
        if not ready:
            raise ValueError(f"a circle of imports among {sorted(arrows.keys() - heights.keys())}")
        heights |= {name: 1 + max((heights[target] for target in arrows[name]), default=-1) for name in ready}
    return heights


def reduced(arrows: Imports) -> Imports:
    """The arrows that no chain of others implies."""
    reach: dict[str, frozenset[str]] = {}
    for name in sorted(arrows, key=floors(arrows).__getitem__):
        reach[name] = arrows[name].union(*(reach[target] for target in arrows[name]))
    return {
        name: frozenset(target for target in targets if not any(target in reach[other] for other in targets))
        for name, targets in arrows.items()
    }


def _rows(arrows: Imports) -> list[list[str]]:
    """The rooms floor by floor from the top, each near the rooms that import it."""
    of, edges = floors(arrows), reduced(arrows)
    rows = [sorted(name for name in arrows if of[name] == floor) for floor in range(max(of.values()), -1, -1)]
    centre: dict[str, float] = {}
    for row in rows:
        above = {name: [centre[importer] for importer in edges if name in edges[importer]] for name in row}
        row.sort(key=lambda name: (sum(above[name]) / len(above[name]) if above[name] else 0.5, name))
        centre |= {name: (place + 0.5) / len(row) for place, name in enumerate(row)}
    return rows


def _width(name: str) -> float:
    return _CHARACTER * len(name.split(".")[1]) + 16


def _row_width(row: list[str]) -> float:
    return sum(map(_width, row)) + _GAP * (len(row) - 1)


def picture(arrows: Imports) -> str:
    """The drawing: a band for each package, an arrow from a room to each that it imports and no other room implies."""
    bands = {package: within(package, arrows) for package in PACKAGES}
    rows = {package: _rows(band) for package, band in bands.items()}
    boxes: dict[str, tuple[float, float]] = {}
    below: list[str] = []
    left = float(_MARGIN)
    height = _TITLE + _FLOOR * max(map(len, rows.values()))
    for package, colour in PACKAGES.items():
        wide = max(map(_row_width, rows[package])) + 2 * _MARGIN
        below.append(
            f'<rect x="{left:.0f}" y="{_MARGIN}" width="{wide:.0f}" height="{height}" fill="{colour}"/>'
            f'<text x="{left + 10:.0f}" y="{_MARGIN + 18}" font-weight="bold">{package}/</text>'
        )
        for number, row in enumerate(rows[package]):
            edge = left + (wide - _row_width(row)) / 2
            for name in row:
                boxes[name] = (edge + _width(name) / 2, _MARGIN + _TITLE + _FLOOR * number)
                edge += _width(name) + _GAP
        left += wide + _MARGIN
    width, tall = left, height + 2 * _MARGIN
    lines = [_arrow(boxes[source], boxes[other]) for band in bands.values() for source, other in _pairs(reduced(band))]
    shapes = [_box(name, boxes[name]) for name in sorted(boxes)]
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {tall}"'
            ' font-family="monospace" font-size="11.5">',
            "<title>Rooms of the packages and their imports</title>",
            '<defs><marker id="tip" viewBox="0 0 6 6" refX="6" refY="3" markerWidth="6" markerHeight="6" orient="auto">'
            '<path d="M0 0L6 3L0 6z" fill="#777"/></marker></defs>',
            f'<rect width="{width:.0f}" height="{tall}" fill="#fff"/>',
            *below,
            *lines,
            *shapes,
            "</svg>\n",
        ]
    )


def _pairs(arrows: Imports) -> Iterator[tuple[str, str]]:
    for name in sorted(arrows):
        for other in sorted(arrows[name]):
            yield name, other


def _arrow(start: tuple[float, float], end: tuple[float, float]) -> str:
    (x1, y1), (x2, y2) = start, end
    y1, bend = y1 + _BOX, (y2 - y1 - _BOX) / 2
    return (
        f'<path d="M{x1:.0f} {y1:.0f}C{x1:.0f} {y1 + bend:.0f} {x2:.0f} {y2 - bend:.0f} {x2:.0f} {y2:.0f}"'
        ' fill="none" stroke="#777" marker-end="url(#tip)"/>'
    )


def _box(name: str, place: tuple[float, float]) -> str:
    x, y = place
    title = escape(name.split(".")[1])
    return (
        f'<rect x="{x - _width(name) / 2:.0f}" y="{y:.0f}" width="{_width(name):.0f}" height="{_BOX}" rx="4"'
        f' fill="#fff" stroke="#333"/><text x="{x:.0f}" y="{y + 16:.0f}" text-anchor="middle">{title}</text>'
    )


def purpose(name: str) -> str:
    """The first sentence of what a room says of itself; empty where it says nothing."""
    path = ROOT / name.replace(".", "/")
    file = path / "__init__.py" if path.is_dir() else path.with_suffix(".py")
    paragraph = (ast.get_docstring(ast.parse(file.read_text())) or "").split("\n\n")[0]
    sentence = " ".join(paragraph.split()).split(". ")[0].rstrip(".")
    return sentence.replace("``", "`").replace("|", "/")


def table(arrows: Imports) -> str:
    """A row for each room, package by package, from the top of the picture to its foot."""
    names = [name for package in PACKAGES for row in _rows(within(package, arrows)) for name in row]
    return "\n".join(["| room | purpose |", "|---|---|", *(f"| `{name}` | {purpose(name)} |" for name in names)]) + "\n"


def page(text: str, arrows: Imports) -> str:
    """The page with the table of today between its marks."""
    before, rest = text.split(BEGIN)
    return before + BEGIN + table(arrows) + END + rest.split(END)[1]


def main() -> None:
    """Write picture and table."""
    arrows = imports()
    PICTURE.write_text(picture(arrows))
    PAGE.write_text(page(PAGE.read_text(), arrows))


if __name__ == "__main__":
    main()
