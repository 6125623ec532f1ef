"""The version that every answer carries, the documents and the traces too."""

from functools import cache
from importlib.metadata import version


@cache
def package_version() -> str:
    """Version of this package as it is installed."""
    return version("counterweight")
