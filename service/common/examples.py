"""Where the examples and what goes with them are."""

from functools import cache
from pathlib import Path


@cache
def directory() -> Path:
    """Inside the installed package, or beside it in a checkout."""
    packaged = Path(__file__).parents[1] / "examples"
    return packaged if packaged.is_dir() else Path(__file__).parents[2] / "examples"
