"""Chromium: where it is, and how it is installed where that may be done (``python -m tests.browser.chromium``)."""

import os
import shutil
import subprocess
import sys

_NAMES = ("chromium", "chromium-browser", "google-chrome-stable", "google-chrome")
_INSTALL_WITHIN_S = 300.0
MISSING = "Chromium is missing: the tests of the page were NOT RUN. Install it (Debian: apt-get install chromium)."


def find() -> str | None:
    """Path of an installed Chromium; the variable CHROMIUM names another one."""
    return os.environ.get("CHROMIUM") or next(filter(None, map(shutil.which, _NAMES)), None)


def install() -> None:
    """Install Debian's package, if we are root on a system that has apt; nothing waits for ever, nothing is asked."""
    if os.geteuid() != 0 or shutil.which("apt-get") is None:
        return
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    for command in (["update"], ["install", "--yes", "--no-install-recommends", "chromium"]):
        try:
            subprocess.run(
                ["apt-get", "--quiet", "-o", "DPkg::Lock::Timeout=60", *command],
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                timeout=_INSTALL_WITHIN_S,
                check=True,
            )
        except (subprocess.SubprocessError, OSError) as error:
            print(f"apt-get {command[0]} failed: {error}", file=sys.stderr)
            return


def main() -> None:
    if find() is None:
        install()
    if find() is None:
        print(f"\n{'!' * 100}\n{MISSING}\n{'!' * 100}\n", file=sys.stderr)


if __name__ == "__main__":
    main()
