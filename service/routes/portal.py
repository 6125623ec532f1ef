"""The portal page and its files."""

from functools import cache

from fastapi import APIRouter
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import Response

from service.http.kept import ASKS_AGAIN, FOR_EVER, Kept
from service.portal.assets import UnknownAsset, asset, names, page, release

router = APIRouter(include_in_schema=False)

# the digest is that of an empty text: the plotting library makes an empty style element and fills it by script
_POLICY = (
    "default-src 'none'; script-src 'self'; connect-src 'self'; img-src 'self' data: blob:; "
    "style-src 'self' 'sha256-47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU='; "
    "base-uri 'none'; form-action 'none'; frame-ancestors "
)


@router.get("/")
async def home(request: Request) -> Response:
    """One page that asks the service what everyone can ask."""
    origins: tuple[str, ...] = request.app.state.frame_origins
    return _page(origins).answer(request, **{"Content-Security-Policy": _POLICY + (" ".join(origins) or "'none'")})


@router.get("/portal/{of}/{name:path}")
async def file(request: Request, of: str, name: str) -> Response:
    """A file of the page. A page of another release gets the files of this one, but may not keep them."""
    try:
        found = _file(name)
    except UnknownAsset:
        raise HTTPException(404) from None
    return found.answer(request, FOR_EVER if of == release() else ASKS_AGAIN)


def prepare() -> int:
    """Join and compress all files, before anybody asks for them; how many bytes they travel as."""
    return sum(len(_file(name).compressed) for name in names())


@cache
def _page(origins: tuple[str, ...]) -> Kept:
    return Kept(page(origins), "text/html")


@cache
def _file(name: str) -> Kept:
    found = asset(name)
    return Kept(found.content, found.media_type)
