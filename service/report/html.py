"""The document as one HTML page: styles and drawings inside, no scripts, nothing from outside."""

from base64 import b64encode
from functools import cache

from jinja2 import Environment, PackageLoader, StrictUndefined, Template
from markupsafe import Markup

from service.common.figures import typeset
from service.common.plain import plain
from service.drawings.svg import Drawing
from service.report.blocks import Block, Document, Number


def html(document: Document) -> bytes:
    """The page, in UTF-8."""
    return _template().render(document=document).encode()


@cache
def _template() -> Template:
    environment = Environment(
        loader=PackageLoader("service.report"),
        autoescape=True,
        undefined=StrictUndefined,
        finalize=_finalize,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters["svg"] = _svg
    environment.filters["data"] = _data
    environment.tests["number"] = lambda cell: isinstance(cell, Number)
    environment.tests["formula"] = lambda cell: isinstance(cell, tuple)
    environment.filters["kind"] = _kind
    environment.filters["typeset"] = typeset
    return environment.get_template("report.html")


def _finalize(value: object) -> object:
    # what is markup already was made of plain text
    return plain(value) if isinstance(value, str) and not isinstance(value, Markup) else value


def _svg(drawing: Drawing) -> Markup:
    # the XML writer has escaped every text in it
    return Markup(drawing.svg())


def _data(image: bytes) -> str:
    return f"data:image/png;base64,{b64encode(image).decode()}"


def _kind(block: Block) -> str:
    return type(block).__name__.lower()
