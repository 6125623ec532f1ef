"""How many examples a search for hard machines looks at."""

import os

from hypothesis import HealthCheck, settings

_COUNT = int(os.environ.get("HARD_SEARCH", "0"))


def search(count: int) -> settings:
    """So many as HARD_SEARCH says, at random; else at night ten times ``count``, by day two thirds, always the same."""
    return settings(
        max_examples=_COUNT or count * settings.default.max_examples // 30,
        derandomize=not _COUNT,
        database=None,
        deadline=None,
        suppress_health_check=list(HealthCheck),
    )
