"""Programs that tests need beside Python, from Debian's packages, where they may be installed."""

import os
import shutil
import subprocess
import sys
import time


def install(*packages: str, within_s: float) -> None:
    """Install packages, if we are root on a system that has apt; nothing waits for ever, nothing is asked."""
    if os.geteuid() != 0 or shutil.which("apt-get") is None:
        return
    until = time.monotonic() + within_s
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    for command in (["update"], ["install", "--yes", "--no-install-recommends", *packages]):
        try:
            subprocess.run(
                ["apt-get", "--quiet", "-o", "DPkg::Lock::Timeout=60", *command],
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                timeout=max(1.0, until - time.monotonic()),
                check=True,
            )
        except (subprocess.SubprocessError, OSError) as error:
            print(f"apt-get {command[0]} failed: {error}", file=sys.stderr)
            return


def say_missing(words: str) -> None:
    """What is not tested is said aloud."""
    print(f"\n{'!' * 110}\n{words}\n{'!' * 110}\n", file=sys.stderr)
