"""Whether the service can compute yet, and whether it can do all that it is for.

The solver takes seconds to load, and that happens in the background. Threads, database and disk are looked at every few
seconds, so that who asks is answered at once.
"""

import logging
from collections.abc import Callable, Mapping
from typing import Literal

from anyio import fail_after, sleep, to_thread

from service.fairness.threads import Threads

State = Literal["warming", "ready", "failed"]
_LOOK_S = 3.0
#: longer than a database that is locked for a while may take
_PATIENCE_S = 10.0
_LOG = logging.getLogger(__name__)


class NotReady(Exception):
    """The service cannot compute; a retry helps if there is a ``retry_after_s``."""

    def __init__(self, message: str, retry_after_s: int | None = None) -> None:
        self.retry_after_s = retry_after_s
        super().__init__(message)


class Readiness:
    """State of the warm-up: warming, then ready or failed; and of database, disk and workers.

    Parameters
    ----------
    checks : by name; each raises :class:`NotReady` where something is missing.
    threads : those that routes run in, in which it is looked; that there is one is looked at too.
    state : at first; ready where nothing has to be warm.
    """

    def __init__(self, checks: Mapping[str, Callable[[], None]], threads: Threads, state: State = "warming") -> None:
        self.state = state
        self._checks = checks
        self._threads = threads
        self._missing: dict[str, NotReady] = {}

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

    async def watch(self) -> None:
        """Run all checks again and again, until cancelled."""
        while True:
            for name, check in self._checks.items():
                problem = await self._probe(check)
                past_problem = self._missing.pop(name, None)
                if problem is not None:
                    self._missing[name] = problem
                if (problem is None) != (past_problem is None):
                    _LOG.warning("%s: %s", name, problem or "all is well again")
            await sleep(_LOOK_S)

    async def _probe(self, check: Callable[[], None]) -> NotReady | None:
        try:
            with fail_after(_PATIENCE_S):
                await self._threads.run("readiness", check, abandon=True)
        except NotReady as missing:
            return missing
        except TimeoutError:
            return NotReady(f"No thread has answered within {_PATIENCE_S:g} s.", retry_after_s=5)
        except Exception:
            _LOG.exception("readiness could not be looked at")
            return NotReady("Whether the service is ready cannot be found out; its log says why.", retry_after_s=5)
        return None

    def require_all(self) -> None:
        """Go on only if the service can compute, and has all else that it needs.

        Raises
        ------
        NotReady
        """
        self.require()
        for missing in self._missing.values():
            raise missing

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
