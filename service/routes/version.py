"""Which version answers."""

from fastapi import APIRouter

from schemas.base import Answer
from service.http.openapi import problems

router = APIRouter(tags=["health"])


class Version(Answer):
    """The version of the service."""


@router.get("/v1/version", operation_id="read_version", summary="Which version answers?", responses=problems())
async def read_version() -> Version:
    return Version()
