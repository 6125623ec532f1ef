"""The files of the page: our own, and the plotting library of an installed package."""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.metadata import version
from importlib.resources import files
from pathlib import Path

MEDIA_TYPES: Mapping[str, str] = {
    ".css": "text/css; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".svg": "image/svg+xml",
}
PLOTS = "plotly.min.js"
_STATIC = Path(__file__).parent / "static"
_MODULES = b"<!-- modules -->"
_FRAMES = b"<!-- frames -->"


class UnknownAsset(LookupError):
    """The page has no file of this name."""


@dataclass(frozen=True)
class Asset:
    """A file."""

    media_type: str
    content: bytes


@cache
def names() -> tuple[str, ...]:
    """Names of all files, relative to the folder of the page."""
    own = (path.relative_to(_STATIC).as_posix() for path in _STATIC.rglob("*") if path.suffix in MEDIA_TYPES)
    return (*sorted(own), PLOTS)


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
    content = (files("plotly") / "package_data" / PLOTS if name == PLOTS else _STATIC / name).read_bytes()
    return Asset(MEDIA_TYPES[Path(name).suffix], content)


@cache
def release() -> str:
    """Changes whenever a file does, so that browsers may keep what they have for ever."""
    digest = hashlib.sha256(version("plotly").encode())
    for name in names():
        if name != PLOTS:
            digest.update(name.encode() + (_STATIC / name).read_bytes())
    return digest.hexdigest()[:12]


def page(origins: Sequence[str] = ()) -> bytes:
    """The page, with the addresses of this release and all modules announced at once.

    Parameters
    ----------
    origins : whose pages may show it in a frame, and are listened to.
    """
    modules = (name for name in names() if name.endswith(".js") and name != PLOTS)
    announced = "".join(f'<link rel="modulepreload" href="portal/{name}">\n' for name in modules).encode()
    framed = f'<meta name="frame-origins" content="{" ".join(origins)}">'.encode()
    content = (_STATIC / "index.html").read_bytes().replace(_MODULES, announced).replace(_FRAMES, framed)
    return content.replace(b'="portal/', f'="portal/{release()}/'.encode())
