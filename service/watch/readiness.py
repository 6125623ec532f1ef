"""Whether the service can compute yet: the solver takes seconds to load, and that happens in the background."""

import logging
from collections.abc import Callable
from typing import Literal

from anyio import to_thread

State = Literal["warming", "ready", "failed"]
_LOG = logging.getLogger(__name__)


class NotReady(Exception):
    """The service cannot compute; a retry helps if ``retry_after_s`` is given."""

    def __init__(self, message: str, retry_after_s: int | None = None) -> None:
        self.retry_after_s = retry_after_s
        super().__init__(message)


class Readiness:
    """State of the warm-up: warming, then ready or failed."""

    def __init__(self) -> None:
        self.state: State = "warming"

    async def warm(self, warm_up: Callable[[], None]) -> None:
        """Run the warm-up in a thread; its failure is logged and kept as a state."""
        try:
            # a shutdown does not wait for it
            await to_thread.run_sync(warm_up, abandon_on_cancel=True)
        except Exception:
            self.state = "failed"
            _LOG.exception("the warm-up failed")
        else:
            self.state = "ready"

    def require(self) -> None:
        """Go on only if the service can compute.

        Raises
        ------
        NotReady
            if it cannot, yet or at all.
        """
        if self.state == "warming":
            raise NotReady("The solver is still loading.", retry_after_s=2)
        if self.state == "failed":
            raise NotReady("The solver could not be loaded; the log of the service says why.")
