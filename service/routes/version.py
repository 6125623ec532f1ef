"""Which version answers."""

from importlib.metadata import version

from fastapi import APIRouter
from pydantic import Field

from schemas.base import Model
from service.http.openapi import problems

router = APIRouter(tags=["health"])


class Version(Model):
    """The version of the service."""

    version: str = Field(description="version of the package that answers", examples=["0.1.0"])


@router.get("/v1/version", operation_id="read_version", summary="Which version answers?", responses=problems())
def read_version() -> Version:
    return Version(version=version("counterweight"))
