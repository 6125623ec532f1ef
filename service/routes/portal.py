"""The portal page and its files."""

from fastapi import APIRouter
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import Response

from service.http.cached_document import ASKS_AGAIN, FOR_EVER, CachedDocument, Shelf
from service.portal.assets import asset, names, page, release

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
    document = await _PAGES.take(request, origins)
    return document.answer(request, **{"Content-Security-Policy": _POLICY + (" ".join(origins) or "'none'")})


@router.get("/portal/{of}/{name:path}")
async def file(request: Request, of: str, name: str) -> Response:
    """A file of the page. A page of another release gets the files of this one, but may not keep them."""
    if name not in names():
        raise HTTPException(404)
    document = await _FILES.take(request, name)
    return document.answer(request, FOR_EVER if of == release() else ASKS_AGAIN)


def _file(name: str) -> CachedDocument:
    # computed from all files, once: here no client waits for it on the event loop
    release()
    resource = asset(name)
    return CachedDocument(resource.content, resource.media_type)


_PAGES = Shelf[tuple[str, ...]](lambda origins: CachedDocument(page(origins), "text/html"))
_FILES = Shelf(_file)
