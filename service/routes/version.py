"""Which version answers."""

import os

from fastapi import APIRouter
from pydantic import Field

from schemas.base.model import Answer
from service.http.operations import problems

router = APIRouter(tags=["health"])


def processor() -> str:
    """What kernels are compiled for, by the rules of numba, which only workers load."""
    name = os.environ.get("NUMBA_CPU_NAME")
    if name is None:
        return "host"
    # beside a name numba takes all features of this machine, unless a setting lists them
    own = "NUMBA_CPU_FEATURES" not in os.environ and name.lower() != "generic"
    return f"{name or 'generic'}{'+host' if own else ''}"


class Version(Answer):
    """The version of the service, and what its kernels are compiled for."""

    processor: str = Field(
        default_factory=processor,
        description="processor that the kernels are compiled for: `generic` is any of the architecture, `x86-64-v3` one"
        " with AVX2 and FMA, `host` this machine's own; `+host` after a name is all that this machine has beside it",
        examples=["x86-64-v3"],
    )


@router.get("/v1/version", operation_id="read_version", summary="Which version answers?", responses=problems())
async def read_version() -> Version:
    return Version()
