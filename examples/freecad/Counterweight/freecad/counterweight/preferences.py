"""What a designer has set, with a window or without. The key is not among it: see :mod:`asking`."""

from __future__ import annotations

import FreeCAD as App

GROUP = "User parameter:BaseApp/Preferences/Mod/Counterweight"
_URL = "http://127.0.0.1:8000"


def url():
    """Where the service is."""
    return App.ParamGet(GROUP).GetString("Url", _URL)
