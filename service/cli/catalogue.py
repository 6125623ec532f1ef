"""Commands that say what there is: effects, examples, schemas."""

from typing import Annotated

import typer

from service.cli.terminal import AsJson, fail, put, show


def effects(as_json: AsJson = False) -> None:
    """List what can be asked for, and what is simulated and read for it."""
    from optimizer.outputs.descriptions import catalogue

    if as_json:
        put(catalogue().model_dump_json())
    else:
        from service.report.chapters.catalogue import effects as chapters

        show(chapters(catalogue()))


def examples(
    name: Annotated[str | None, typer.Argument(metavar="NAME", help="Print this one, ready for optimize.")] = None,
    as_json: AsJson = False,
) -> None:
    """List the examples, or print one of them."""
    from service.documents.examples import UnknownExample, catalogue, load

    if name is not None:
        try:
            put(load(name).decode().rstrip("\n"))
        except UnknownExample:
            fail("there is no example of this name; `counterweight examples` lists them")
    elif as_json:
        put(catalogue().model_dump_json())
    else:
        from service.report.chapters.catalogue import names

        show(names("Examples", [(example.name, example.title) for example in catalogue().examples]))


def schema(
    name: Annotated[str | None, typer.Argument(metavar="NAME", help="Print the JSON schema of this document.")] = None,
) -> None:
    """List the documents that go in and come out, or print the JSON schema of one of them."""
    import json

    from service.documents.catalogue import documents

    index = documents()
    if name is None:
        from service.report.chapters.catalogue import names

        show(names("Documents", [(key, document.meaning) for key, document in index.items()]))
    elif name in index:
        put(json.dumps(index[name].json_schema(), indent=2))
    else:
        fail(f"there is no document of this name; there are {', '.join(index)}")
