"""The machines that come with the service, each an optimisation request one can post; in folders, other requests."""

import json
from typing import Any

from pydantic import Field

from schemas.base.model import Model
from service.common.examples import directory


class UnknownExample(LookupError):
    """There is no example of this name."""


class ExampleLinks(Model):
    """Where an example is found and where it can be posted."""

    self: str = Field(description="the request body", examples=["/v1/examples/2d12"])
    optimize: str = Field(description="where to post it", examples=["/v1/optimize"])


class Example(Model):
    """An example."""

    name: str = Field(description="name of the example", examples=["2d12"])
    title: str = Field(description="name of the machine", examples=["2D12-90/2-20"])
    description: str = Field(
        description="what the machine is, and which data are assumed", examples=["Horizontal opposed compressor."]
    )
    gas: bool = Field(description="whether its rows have cylinders, and with them gas data", examples=[True])
    links: ExampleLinks = Field(description="where to go from here", examples=[{"self": "/v1/examples/2d12"}])


class Examples(Model):
    """All examples, by name."""

    examples: tuple[Example, ...] = Field(description="the examples", examples=[[{"name": "2d12"}]])


def names() -> list[str]:
    """Names of all examples, sorted."""
    return sorted(path.stem for path in directory().glob("*.json"))


def load(name: str) -> bytes:
    """The request body of an example, as it is in its file.

    Raises
    ------
    UnknownExample
        if there is none of this name.
    """
    # looked up in the listing: a name never becomes a path by itself
    if name not in names():
        raise UnknownExample(name)
    return (directory() / f"{name}.json").read_bytes()


def bodies(folder: str = "") -> dict[str, Any]:
    """The example bodies by name: of a folder, or the machines beside the folders."""
    return {path.stem: json.loads(path.read_bytes()) for path in sorted((directory() / folder).glob("*.json"))}


def catalogue(root_path: str = "") -> Examples:
    """All examples with links."""
    return Examples(examples=tuple(_describe(name, root_path) for name in names()))


def _describe(name: str, root_path: str) -> Example:
    machine = json.loads(load(name))["machine"]
    return Example(
        name=name,
        title=machine.get("name") or name,
        description=machine.get("description") or "",
        gas=any({"cylinder", "cylinders"} & row.keys() for throw in machine.get("throws", ()) for row in throw["rows"]),
        links=ExampleLinks.model_validate(
            {"self": f"{root_path}/v1/examples/{name}", "optimize": f"{root_path}/v1/optimize"}
        ),
    )
