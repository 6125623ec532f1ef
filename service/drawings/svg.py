"""Drawings of a few shapes, written as SVG with attributes only: no styles, no references, nothing from outside.

Lengths are px, 96 to the inch, x to the right and y downwards; 640 px are the width of a page. Text is escaped by the
XML writer.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Literal
from xml.etree import ElementTree

from service.common.plain import plain

Point = tuple[float, float]
Anchor = Literal["start", "middle", "end"]

PAGE_WIDTH = 640.0

# everybody can distinguish them, and by dash or lightness also in black and white (Okabe and Ito)
INK = "#222222"
MUTED = "#777777"
FAINT = "#d5d5d5"
BEFORE = "#d55e00"
AFTER = "#0072b2"
SERIES = ("#0072b2", "#d55e00", "#009e73", "#aa4499", "#56a0d0", "#a07800", "#444444", "#e06090")
DASHES = (None, "7 3", "2 2", "9 3 2 3", "12 3", "4 4", "1 3", "6 2 1 2 1 2")


@dataclass
class Drawing:
    """A drawing under construction.

    label : what it shows, for those who cannot see it.
    scale : pixels to a px of the drawing.
    """

    width: float
    height: float
    label: str
    scale: float = 1.0
    _shapes: list[ElementTree.Element] = field(default_factory=list)

    def line(self, points: Sequence[Point], stroke: str = INK, width: float = 1.0, dash: str | None = None) -> None:
        """An open line through points."""
        self._add("path", d=_path(points), fill="none", **_pen(stroke, width, dash))

    def area(
        self,
        points: Sequence[Point],
        fill: str,
        opacity: float = 1.0,
        stroke: str = "none",
        width: float = 1.0,
        dash: str | None = None,
    ) -> None:
        """A closed area."""
        pen = _pen(stroke, width, dash)
        self._add("path", d=_path(points) + "Z", fill=fill, **{"fill-opacity": _short(opacity)}, **pen)

    def circle(
        self,
        centre: Point,
        radius: float,
        stroke: str = INK,
        fill: str = "none",
        width: float = 1.0,
        dash: str | None = None,
    ) -> None:
        x, y = centre
        self._add("circle", cx=_short(x), cy=_short(y), r=_short(radius), fill=fill, **_pen(stroke, width, dash))

    def text(
        self,
        place: Point,
        content: str,
        anchor: Anchor = "start",
        size: float = 11.0,
        fill: str = INK,
        vertical: bool = False,
        halo: bool = False,
    ) -> None:
        """Text on a base line; ``vertical`` reads upwards, ``halo`` keeps it legible over lines."""
        x, y = (_short(value) for value in place)
        more = {"transform": f"rotate(-90 {x} {y})"} if vertical else {}
        style = {"font-size": _short(size), "text-anchor": anchor}
        if halo:
            more |= {"stroke": "white", "stroke-width": "3", "stroke-linejoin": "round", "paint-order": "stroke"}
        self._add("text", x=x, y=y, fill=fill, **style, **more).text = plain(content)

    @contextmanager
    def group(self, kind: str, title: str | None = None) -> Iterator[None]:
        """What is drawn within belongs together.

        Parameters
        ----------
        kind : what it is, for pages that show it in colours of their own, or move it.
        title : what a page says where it is pointed at.
        """
        around, self._shapes = self._shapes, []
        yield
        group = ElementTree.Element("g", {"class": kind})
        if title is not None:
            ElementTree.SubElement(group, "title").text = plain(title)
        group.extend(self._shapes)
        self._shapes = [*around, group]

    def inset(self, drawing: "Drawing", corner: Point) -> None:
        """Another drawing in this one, its upper left corner at a point."""
        x, y = (_short(value) for value in corner)
        self._add("g", transform=f"translate({x} {y})").extend(drawing._shapes)  # noqa: SLF001 - of the same class

    def svg(self, font: str | None = None) -> str:
        """The drawing as an SVG element, which stands alone as well as inside a page.

        Parameters
        ----------
        font : of its texts; by default that of the page.
        """
        size = {"width": _short(self.width * self.scale), "height": _short(self.height * self.scale)}
        box = {
            "viewBox": f"0 0 {_short(self.width)} {_short(self.height)}",
            "role": "img",
            "aria-label": plain(self.label),
        }
        family = {} if font is None else {"font-family": font}
        root = ElementTree.Element("svg", {"xmlns": "http://www.w3.org/2000/svg", **size, **box, **family})
        root.extend(self._shapes)
        return ElementTree.tostring(root, encoding="unicode")

    def _add(self, name: str, **attributes: str) -> ElementTree.Element:
        shape = ElementTree.Element(name, attributes)
        self._shapes.append(shape)
        return shape


def beside(label: str, drawings: Sequence[Drawing]) -> Drawing:
    """Drawings of one size, two to a row where they are no wider than half a page."""
    width, height = max(drawing.width for drawing in drawings), max(drawing.height for drawing in drawings)
    columns = min(2 if 2 * width <= PAGE_WIDTH else 1, len(drawings))
    gap = PAGE_WIDTH - 2 * width if columns == 2 else 0.0
    whole = Drawing(columns * width + gap, height * -(-len(drawings) // columns), label)
    for number, drawing in enumerate(drawings):
        whole.inset(drawing, ((width + gap) * (number % columns), height * (number // columns)))
    return whole


def shortened(text: str, most: int) -> str:
    """The text, or its beginning where it is longer than so many characters."""
    return text if len(text) <= most else text[: most - 1] + "…"


def _pen(stroke: str, width: float, dash: str | None) -> dict[str, str]:
    if stroke == "none":
        return {"stroke": "none"}
    pen = {"stroke": stroke, "stroke-width": _short(width), "stroke-linejoin": "round"}
    return pen if dash is None else {**pen, "stroke-dasharray": dash}


def _path(points: Sequence[Point]) -> str:
    return "M" + "L".join(f"{_short(x)} {_short(y)}" for x, y in points)


def _short(value: float) -> str:
    """A hundredth of a px is enough, and the same on every machine; never ``-0``."""
    return f"{round(value, 2) + 0.0:g}" if abs(value) < 1e5 else f"{value:.0f}"
