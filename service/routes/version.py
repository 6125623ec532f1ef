"""Which version answers."""

import os

from fastapi import APIRouter
from pydantic import Field

from schemas.base.model import Answer
from service.http.operations import problems

router = APIRouter(tags=["health"])


class Version(Answer):
    """The version of the service, and what its kernels are compiled for."""

    processor: str = Field(
        default_factory=lambda: os.environ.get("NUMBA_CPU_NAME") or "host",
        description="processor that the kernels are compiled for: `generic` is any of the architecture, `x86-64-v3` one"
        " with AVX2 and FMA, `host` this machine's own",
        examples=["x86-64-v3"],
    )


@router.get("/v1/version", operation_id="read_version", summary="Which version answers?", responses=problems())
async def read_version() -> Version:
    return Version()
