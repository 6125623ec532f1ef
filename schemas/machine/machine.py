"""The machine of a request, told apart by its kind. Frame and signs: docs/mathematics.md section 1."""

from typing import Annotated

from pydantic import Field

from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.machine.scroll_machine import ScrollMachine

Machine = Annotated[ReciprocatingMachine | ScrollMachine, Field(discriminator="kind")]
