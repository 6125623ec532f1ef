"""The files of the page: our own, one of each kind, and the plotting library of an installed package."""

import hashlib
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.metadata import version
from importlib.resources import files
from pathlib import Path

from pydantic.json_schema import models_json_schema

from schemas.front.pareto import ParetoRequest
from schemas.request.requests import OptimizeRequest
from service.portal.bundle import bundle

MEDIA_TYPES: Mapping[str, str] = {
    ".css": "text/css; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".json": "application/json",
    ".svg": "image/svg+xml",
}
PLOTS = "plotly.min.js"
SCHEMAS = "schemas.json"
STATIC = Path(__file__).parent / "static"
_STYLES = ("theme.css", "form.css", "results.css")
_FRAMES = b"<!-- frames -->"


def _schemas() -> str:
    """What the form is made from: of the service's document, which is ten times as long, what it needs."""
    _, document = models_json_schema(
        [(OptimizeRequest, "validation"), (ParetoRequest, "validation")], ref_template="#/components/schemas/{model}"
    )
    return json.dumps(document["$defs"], ensure_ascii=False, separators=(",", ":"))


_OWN: Mapping[str, Callable[[], str]] = {
    "page.js": lambda: bundle(STATIC, "main.js"),
    "page.css": lambda: "".join((STATIC / name).read_text(encoding="utf-8") for name in _STYLES),
    SCHEMAS: _schemas,
    "icon.svg": lambda: (STATIC / "icon.svg").read_text(encoding="utf-8"),
}


class UnknownAsset(LookupError):
    """The page has no file of this name."""


@dataclass(frozen=True)
class Asset:
    """A file."""

    media_type: str
    content: bytes


def names() -> tuple[str, ...]:
    """Names of all files."""
    return (*_OWN, PLOTS)


@cache
def asset(name: str) -> Asset:
    """A file of the page.

    Raises
    ------
    UnknownAsset
        if there is none of this name.
    """
    # looked up in the listing: a name never becomes a path by itself
    if name not in names():
        raise UnknownAsset(name)
    factory = _OWN.get(name)
    content = factory().encode() if factory else (files("plotly") / "package_data" / PLOTS).read_bytes()
    return Asset(MEDIA_TYPES[Path(name).suffix], content)


@cache
def release() -> str:
    """Changes whenever a file does, so that browsers may keep what they have for ever."""
    digest = hashlib.sha256(version("plotly").encode())
    for name in _OWN:
        digest.update(name.encode() + asset(name).content)
    return digest.hexdigest()[:12]


def page(origins: Sequence[str] = ()) -> bytes:
    """The page, with the addresses of this release.

    Parameters
    ----------
    origins : whose pages may show it in a frame, and are listened to.
    """
    framed = f'<meta name="frame-origins" content="{" ".join(origins)}">'.encode()
    content = (STATIC / "index.html").read_bytes().replace(_FRAMES, framed)
    return content.replace(b'="portal/', f'="portal/{release()}/'.encode())
