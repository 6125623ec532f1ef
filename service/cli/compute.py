"""Commands that compute an answer to a request in a file."""

import typer

from service.cli.terminal import AsJson, File, Outputs, answer, put, question, show


def optimize(file: File, as_json: AsJson = False, output: Outputs = None) -> None:
    """Choose the counterweights of a machine."""
    from optimizer.optimize import optimize as compute
    from schemas.requests import OptimizeRequest

    request = question(OptimizeRequest, file, output)
    found = answer(compute, request)
    if as_json:
        put(found.model_dump_json())
    else:
        from service.tables import optimize_report

        show(optimize_report(request.machine.name or "machine", request.objective, found))
    raise typer.Exit(0 if found.status == "optimal" else 1)


def analyze(file: File, as_json: AsJson = False, output: Outputs = None) -> None:
    """Say what a machine does as it stands, or with given counterweights."""
    from optimizer.analyze import analyze as compute
    from schemas.requests import AnalyzeRequest

    request = question(AnalyzeRequest, file, output)
    found = answer(compute, request)
    if as_json:
        put(found.model_dump_json())
    else:
        from service.tables import analyze_report

        show(analyze_report(request.machine.name or "machine", found))


def pin_loads(file: File, as_json: AsJson = False) -> None:
    """Say what the anti-rotation pins of a scroll carry over a turn."""
    from optimizer.pins.answer import pin_loads as compute
    from schemas.scroll import PinLoadsRequest

    found = answer(compute, question(PinLoadsRequest, file))
    if as_json:
        put(found.model_dump_json())
    else:
        from service.pin_tables import pin_loads_report

        show(pin_loads_report(found))


def rating(file: File, as_json: AsJson = False) -> None:
    """Size the cylinders of a compressor, and say what they deliver and need."""
    from optimizer.rating.rate import rate
    from schemas.rating import RatingRequest

    request = question(RatingRequest, file)
    found = answer(rate, request)
    if as_json:
        put(found.model_dump_json())
    else:
        from service.rating_tables import rating_report

        show(rating_report(request.name or "compressor", found))
