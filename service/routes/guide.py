"""The documents as a site, where they have been built."""

from pathlib import Path

from fastapi import FastAPI
from starlette.exceptions import HTTPException
from starlette.responses import FileResponse, RedirectResponse, Response
from starlette.staticfiles import StaticFiles
from starlette.types import Scope

PATH = "/docs/guide"
# pages of the generator hold short scripts and styles of their own; browsers enforce that nothing comes from elsewhere
_POLICY = "default-src 'self' 'unsafe-inline'; img-src 'self' data:; frame-ancestors 'none'; base-uri 'none'"


class MissingGuide(Exception):
    """No site has been built."""


class Guide(StaticFiles):
    """A folder of pages; an unknown path is answered 404 with the page that the generator made for it."""

    def __init__(self, folder: Path) -> None:
        super().__init__(directory=folder, html=True, check_dir=False)
        self._unknown = folder / "404.html"

    async def check_config(self) -> None:
        """Nothing at the first request alone: the folder may be built, or removed, while the service runs."""

    async def get_response(self, path: str, scope: Scope) -> Response:
        """The file at a path.

        Raises
        ------
        MissingGuide
        """
        if not self._unknown.is_file():
            raise MissingGuide
        try:
            response = await super().get_response(path, scope)
        except HTTPException as error:
            # of names that no file may have
            if error.status_code != 404:
                raise
            response = FileResponse(self._unknown, 404)
        response.headers["Content-Security-Policy"] = _POLICY
        return response


def install(app: FastAPI, folder: Path) -> None:
    """Serve a folder below ``/docs/guide``; all addresses in it are relative, but for those of the 404 page."""

    @app.get(PATH, include_in_schema=False)
    async def start() -> Response:
        return RedirectResponse("guide/", 308)

    app.mount(PATH, Guide(folder), "guide")
