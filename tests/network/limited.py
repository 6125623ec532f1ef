"""The command line where few files may be opened: ``python -m tests.network.limited FILES OTHERS serve ...``.

Of the files that may be opened OTHERS are kept from connections.
"""

import resource
import sys

if __name__ == "__main__":
    from service.cli import main
    from service.wire import server

    files, server._OTHER_FILES = map(int, sys.argv[1:3])
    resource.setrlimit(resource.RLIMIT_NOFILE, (files, files))
    del sys.argv[1:3]
    main()
