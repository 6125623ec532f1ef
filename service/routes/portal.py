"""The portal page and its files."""

from fastapi import APIRouter
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import Response

from service.http.accept import preferred
from service.portal.assets import UnknownAsset, asset, page, release

router = APIRouter(include_in_schema=False)

# the digest is that of an empty text: the plotting library makes an empty style element and fills it by script
_POLICY = (
    "default-src 'none'; script-src 'self'; connect-src 'self'; img-src 'self' data: blob:; "
    "style-src 'self' 'sha256-47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU='; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
_FOR_EVER = "public, max-age=31536000, immutable"


@router.get("/")
async def home(request: Request) -> Response:
    """One page that asks the service what everyone can ask."""
    tag = f'"{release()}"'
    headers = {"Cache-Control": "no-cache", "Content-Security-Policy": _POLICY, "ETag": tag}
    if request.headers.get("if-none-match") == tag:
        return Response(status_code=304, headers=headers)
    return Response(page(), media_type="text/html", headers=headers)


@router.get("/portal/{of}/{name:path}")
async def file(request: Request, of: str, name: str) -> Response:
    """A file of the page. A page of another release gets the files of this one, but may not keep them."""
    try:
        found = asset(name)
    except UnknownAsset:
        raise HTTPException(404) from None
    headers = {"Cache-Control": _FOR_EVER if of == release() else "no-cache", "Vary": "Accept-Encoding"}
    content = found.content
    # a client that says nothing takes the file as it is
    if preferred(request.headers.get("accept-encoding") or "identity", ("gzip",)):
        content, headers["Content-Encoding"] = found.compressed, "gzip"
    return Response(content, media_type=found.media_type, headers=headers)
