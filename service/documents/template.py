"""A machine as a workbook, to begin with."""

import json

from service.documents.examples import load


def template(name: str) -> bytes:
    """An example as a workbook.

    Raises
    ------
    UnknownExample
        if there is none of this name.
    """
    # only who asks for one pays for the library
    from service.workbook.files import workbook
    from service.workbook.sheets import written

    return workbook(written(json.loads(load(name))))
