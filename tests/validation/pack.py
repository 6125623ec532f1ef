"""The chapters of the validation pack, and their tables as docs/validation.md shows them."""

from collections.abc import Callable, Iterator

from tests.validation import arrangements, bodies, harmonics, printed_tables, rotor, scroll, thermal
from tests.validation.comparison import Comparison, Misprint

CHAPTERS: dict[str, Callable[[], Iterator[Comparison]]] = {
    "Crank arrangements": arrangements.comparisons,
    "Harmonics of the piston": harmonics.comparisons,
    "Tables of the 2D12": printed_tables.comparisons,
    "Rating of the 2D12": thermal.comparisons,
    "Scroll pins": scroll.comparisons,
    "Rotor by influence coefficients": rotor.comparisons,
    "Rigid bodies in EXUDYN": bodies.comparisons,
}
#: chapters that need nothing but this package
AT_ONCE = tuple(title for title in CHAPTERS if "EXUDYN" not in title)


def misprints() -> Iterator[Misprint]:
    yield from printed_tables.misprints()
    yield from arrangements.misprints()
    yield from rotor.misprints()


def figures(misprint: Misprint) -> tuple[str, ...]:
    """What is printed, what is right, ours, and the unit."""
    return (
        f"{misprint.printed:.6g}",
        f"{misprint.right.expected:.6g}",
        f"{misprint.right.ours:.6g}",
        misprint.right.unit,
    )
