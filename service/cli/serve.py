"""The command that runs the service."""

from typing import Annotated, Any

import typer

from service.cli.terminal import fail, put


def serve(
    host: Annotated[str | None, typer.Option(help="Address to listen on.", show_default="127.0.0.1")] = None,
    port: Annotated[int | None, typer.Option(help="Port; 0 takes a free one.", show_default="8000")] = None,
    engine: Annotated[
        str | None,
        typer.Option(help="Where sweeps run: processes, or dask:tcp://host:port.", show_default="processes"),
    ] = None,
) -> None:
    """Run the REST service until it is interrupted."""
    import os
    from contextlib import ExitStack

    from service.watch.memory import keep_little

    # libraries that are imported from here on read it
    keep_little()

    from pydantic import ValidationError

    from service.settings import Settings, unknown_variables, wrong_values
    from service.watch import logs
    from service.wire.server import listen, run, url
    from service.workers.process import load

    options = {"host": host, "port": port, "engine": engine}
    values: dict[str, Any] = {key: value for key, value in options.items() if value is not None}
    unknown = list(unknown_variables(os.environ))
    if unknown:
        fail(*unknown)
    try:
        settings = Settings(**values)
        logs.configure(settings)
        with ExitStack() as refused:
            socket = refused.enter_context(listen(settings))
            # beside what takes as long here
            load()
            from service.app import create_app

            app = create_app(settings)
            refused.pop_all()
    except ValidationError as error:
        fail(*wrong_values(error, values))
    except ValueError as error:
        fail(str(error))
    except OSError as error:
        fail(f"cannot listen on {settings.host}, port {settings.port}: {error.strerror or error}")
    put(f"counterweight listens on {url(socket)} (documentation at {url(socket)}/docs)")
    run(app, settings, socket)
