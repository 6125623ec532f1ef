"""Settings of the service, from ``COUNTERWEIGHT_*`` environment variables."""

import os

from pydantic import AliasChoices, Field
from pydantic_settings import BaseSettings, SettingsConfigDict


class Settings(BaseSettings):
    """What an operator can set; the defaults suit one user on one machine."""

    model_config = SettingsConfigDict(
        env_prefix="COUNTERWEIGHT_", env_ignore_empty=True, populate_by_name=True, frozen=True, extra="ignore"
    )

    host: str = Field("127.0.0.1", description="address to listen on")
    port: int = Field(
        8000,
        ge=0,
        le=65535,
        # hosting platforms hand the port over without a prefix
        validation_alias=AliasChoices("COUNTERWEIGHT_PORT", "PORT"),
        description="port to listen on; 0 takes a free one",
    )
    root_path: str = Field("", description="path prefix that a proxy in front strips")
    max_body_bytes: int = Field(1_000_000, ge=1, description="largest request body")
    concurrent_solves: int = Field(
        default_factory=lambda: os.cpu_count() or 1, ge=1, description="computations at the same time"
    )
    graceful_shutdown_s: int = Field(10, ge=0, description="time for open requests to end at shutdown")
