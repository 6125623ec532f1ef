"""The document as one HTML page: styles and drawings inside, no scripts, nothing from outside."""

from base64 import b64encode
from functools import cache

from jinja2 import Environment, PackageLoader, StrictUndefined, Template
from markupsafe import Markup

from service.common.figures import typeset
from service.common.plain import plain
from service.report.blocks import Document, Number


def html(document: Document) -> bytes:
    """The page, in UTF-8."""
    return _template().render(document=document).encode()


@cache
def _template() -> Template:
    environment = Environment(
        loader=PackageLoader("service.report"),
        autoescape=True,
        undefined=StrictUndefined,
        # what is markup already was made of plain text
        finalize=lambda value: plain(value) if isinstance(value, str) and not isinstance(value, Markup) else value,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    # the XML writer has escaped every text in a drawing
    environment.filters["svg"] = lambda drawing: Markup(drawing.svg())
    environment.filters["data"] = lambda image: f"data:image/png;base64,{b64encode(image).decode()}"
    environment.tests["number"] = lambda cell: isinstance(cell, Number)
    environment.tests["formula"] = lambda cell: isinstance(cell, tuple)
    environment.filters["kind"] = lambda block: type(block).__name__.lower()
    environment.filters["typeset"] = typeset
    return environment.get_template("report.html")
