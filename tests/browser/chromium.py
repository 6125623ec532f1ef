"""Chromium: where it is, and how it is installed where that may be done (``python -m tests.browser.chromium``)."""

import os
import shutil

from tests.debian import install, say_missing

#: the one without a window first: a page costs it half of the work
_NAMES = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome-stable", "google-chrome")
_INSTALL_WITHIN_S = 300.0
MISSING = "Chromium is missing: the tests of the page were NOT RUN. Install it (Debian: apt-get install chromium)."


def find() -> str | None:
    """Path of an installed Chromium; the variable CHROMIUM names another one."""
    return os.environ.get("CHROMIUM") or next(filter(None, map(shutil.which, _NAMES)), None)


def main() -> None:
    # not every release of Debian has the first
    for package in _NAMES[:2]:
        if find() is None:
            install(package, within_s=_INSTALL_WITHIN_S)
    if find() is None:
        say_missing(MISSING)


if __name__ == "__main__":
    main()
