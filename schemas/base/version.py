"""The version that every answer carries, the documents and the traces too."""

from functools import cache
from importlib.metadata import version

#: what the package is installed as; the name `counterweight` belongs to another project on the public index
DISTRIBUTION = "counterweight-optimizer"


@cache
def package_version() -> str:
    """Version of this package as it is installed."""
    return version(DISTRIBUTION)
