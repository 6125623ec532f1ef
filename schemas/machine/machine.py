"""The machine of a request, one of several kinds. Frame and signs: docs/mathematics.md section 1."""

from typing import Annotated

from pydantic import Field

from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.machine.scroll_machine import ScrollMachine

Machine = Annotated[ReciprocatingMachine | ScrollMachine, Field(discriminator="kind")]
