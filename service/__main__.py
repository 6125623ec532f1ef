"""``python -m service`` is the command line ``counterweight``."""

from service.cli import main

main()
