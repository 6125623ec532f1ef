"""The documentation page, from assets of an installed package: it works without a network."""

from collections.abc import Mapping
from importlib.resources import files

from fastapi import FastAPI
from fastapi.openapi.docs import get_swagger_ui_html
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import HTMLResponse, Response

from service.http.cached_document import CachedDocument, Shelf

# the browser enforces that nothing is loaded from elsewhere
_POLICY = "default-src 'self' 'unsafe-inline'; img-src 'self' data:"
_MEDIA_TYPES: Mapping[str, str] = {
    "swagger-ui-bundle.js": "text/javascript; charset=utf-8",
    "swagger-ui.css": "text/css; charset=utf-8",
    "favicon.png": "image/png",
}


#: each file is read and compressed once: nobody waits for a disk while it is answered
_ASSETS = Shelf[str](
    lambda name: CachedDocument((files("fastapi_offline") / "static" / name).read_bytes(), _MEDIA_TYPES[name])
)


def install(app: FastAPI) -> None:
    """Serve ``/docs``; every address in it is relative, so that it works behind any prefix."""

    @app.get("/docs/assets/{name}", include_in_schema=False)
    async def asset(request: Request, name: str) -> Response:
        if name not in _MEDIA_TYPES:
            raise HTTPException(404)
        document = await _ASSETS.take(request, name)
        return document.answer(request)

    @app.get("/docs", include_in_schema=False)
    async def docs() -> HTMLResponse:
        page = get_swagger_ui_html(
            openapi_url="openapi.json",
            title=app.title,
            swagger_js_url="docs/assets/swagger-ui-bundle.js",
            swagger_css_url="docs/assets/swagger-ui.css",
            swagger_favicon_url="docs/assets/favicon.png",
            swagger_ui_parameters={"validatorUrl": None, "tryItOutEnabled": True, "deepLinking": False},
        )
        page.headers["Content-Security-Policy"] = _POLICY
        return page
