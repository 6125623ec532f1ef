"""Whether the process lives, and whether it can compute."""

from typing import Literal

from fastapi import APIRouter
from pydantic import Field
from starlette.requests import Request

from schemas.base.model import Model
from service.http.operations import problems

router = APIRouter(tags=["health"])


class Alive(Model):
    """The process answers."""

    status: Literal["alive"] = Field("alive", description="the process answers", examples=["alive"])


class Ready(Model):
    """The service can compute."""

    status: Literal["ready"] = Field("ready", description="the service can compute", examples=["ready"])


@router.get("/healthz", operation_id="healthz", summary="Is the process alive?", responses=problems())
async def healthz() -> Alive:
    return Alive()


@router.get("/readyz", operation_id="readyz", summary="Can the service compute?", responses=problems(503))
async def readyz(request: Request) -> Ready:
    request.app.state.readiness.require_all()
    return Ready()
