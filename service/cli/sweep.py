"""The command that runs a sweep on this machine, with the store and the engines of the service."""

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NoReturn

import typer

from service.cli.terminal import FAULT, AsJson, File, fail, fail_fields, put, question, show

if TYPE_CHECKING:
    import pyarrow as pa

    from schemas.sweep.request import SweepRequest
    from service.jobs.desk import JobService
    from service.jobs.job import Job
    from service.jobs.owner_jobs import OwnerJobs

_INTERRUPTED = 130
_POLL_S = 0.1
_FIRST_ROWS = 5
#: an interrupted sweep has one key in its folder: another request there is refused
_KEY = "sweep"
#: the folder is one's own: what is in it stays, and may be large
_ALONE: dict[str, Any] = {"results_keep_days": 0, "disk_quota_mb": 0, "lease_s": 5}
#: a database that is away for longer ends the command [s]
_PATIENCE_S = 30.0


def sweep(
    file: File,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="Result: .parquet, .arrow, .csv, .ndjson or .xlsx.")
    ] = None,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Count the designs, run nothing.")] = False,
    workers: Annotated[int | None, typer.Option(min=1, help="Processes.", show_default="one a core")] = None,
    engine: Annotated[
        str | None, typer.Option(help="Where to run: processes, or dask:tcp://host:port.", show_default="processes")
    ] = None,
    folder: Annotated[
        Path | None,
        typer.Option(help="Where the work is kept; stays there at the end.", show_default="OUTPUT.sweep, removed"),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Compute thousands to millions of designs of one machine; go on where an interrupted sweep ended."""
    try:
        _sweep(file, output, dry_run, workers, engine, folder, as_json)
    except KeyboardInterrupt:
        typer.echo("interrupted; what is finished is kept, and the same command goes on from there", err=True)
        raise typer.Exit(_INTERRUPTED) from None


def _sweep(
    file: str,
    output: Path | None,
    dry_run: bool,
    workers: int | None,
    engine: str | None,
    folder: Path | None,
    as_json: bool,
) -> None:
    from schemas.sweep.request import SweepRequest

    request = question(SweepRequest, file)
    if dry_run or request.dry_run:
        _estimate(request, workers, as_json)
        return
    if output is None:
        fail("say where the rows shall go: --output results.parquet")
    _require_writable(output)
    _require_fits(output, request)
    place = folder or output.with_name(output.name + ".sweep")
    desk = _desk(place, workers, engine)
    try:
        jobs = desk.of()
        job = _run(jobs, request, place, quiet=as_json)
        if job.state == "done":
            counts = _finish(jobs, job, request, output, as_json)
    finally:
        desk.close()
    if job.state != "done":
        typer.echo(f"the sweep {job.state} after {job.done} of {job.total} designs: {job.error}", err=True)
        typer.echo("what is finished is kept; the same command goes on from there", err=True)
        raise typer.Exit(1)
    if folder is None:
        from shutil import rmtree

        rmtree(place)
    # a row that computing broke down for is no row that has no optimum
    raise typer.Exit(FAULT if "failed" in counts else 0 if set(counts) <= {"optimal", "analyzed"} else 1)


def _estimate(request: "SweepRequest", workers: int | None, as_json: bool) -> None:
    from os import cpu_count

    from optimizer.errors import MissingInput
    from optimizer.studies.sweep.plan import plan

    try:
        estimate = plan(request).estimate_for(workers or cpu_count() or 1)
    except MissingInput as error:
        fail_fields(error.problems)
    if as_json:
        put(estimate.model_dump_json())
    else:
        from service.report.chapters.sweep import estimated

        show(estimated(estimate))


def _require_writable(output: Path) -> None:
    from service.jobs.export import WRITERS

    if output.suffix not in WRITERS:
        fail(f"{output}: the name must end in {', '.join(WRITERS)}")
    if not output.parent.is_dir():
        fail(f"{output}: there is no folder {output.parent}")


def _require_fits(output: Path, request: "SweepRequest") -> None:
    """Before anything is computed; of a front nobody knows yet how many stay."""
    from service.jobs.worksheet import TooLargeForWorksheet, require_fits

    if output.suffix == ".xlsx" and request.pareto is None:
        rows = request.total if request.top is None else min(request.total, request.top.count)
        try:
            require_fits(rows, len(request.column_selection))
        except TooLargeForWorksheet as error:
            fail(f"{output}: {error}")


def _desk(place: Path, workers: int | None, engine: str | None) -> "JobService":
    import multiprocessing

    from service.jobs.desk import JobService
    from service.settings import Settings

    multiprocessing.set_forkserver_preload(["service.jobs.preload"])
    options: dict[str, Any] = {} if workers is None else {"sweep_workers": workers}
    settings = Settings(data_dir=place, database_url=None, engine=engine or "processes", **_ALONE, **options)
    try:
        return JobService(settings)
    except ValueError as error:
        fail(str(error))


def _run(desk: "OwnerJobs", request: "SweepRequest", place: Path, quiet: bool) -> "Job":
    from optimizer.errors import MissingInput
    from service.jobs.database import DatabaseUnavailable
    from service.jobs.store import KeyReused

    try:
        job, new = desk.sweep(request, _KEY)
        if not new and job.state in ("failed", "cancelled"):
            job = desk.resume(job.id)
    except MissingInput as error:
        fail_fields(error.problems)
    except KeyReused:
        fail(f"{place} holds another sweep that is not finished: run that one, remove the folder, or give a --folder")
    except DatabaseUnavailable as error:
        fail(f"cannot work in {place}: {error}")
    if not new:
        typer.echo(f"going on with the sweep in {place}: {job.done} of {job.total} designs are there", err=True)
    try:
        return _watch(desk, job, quiet)
    except KeyboardInterrupt:
        finished = desk.get(job.id).done
        typer.echo(
            f"interrupted after {finished} of {job.total} designs; the same command goes on from there ({place})",
            err=True,
        )
        raise typer.Exit(_INTERRUPTED) from None


def _watch(desk: "OwnerJobs", job: "Job", quiet: bool) -> "Job":
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    from service.jobs.database import DatabaseUnavailable

    columns = (
        TextColumn("designs"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(),
        TextColumn("{task.fields[outcomes]}"),
    )
    with Progress(*columns, console=Console(stderr=True), disable=quiet) as progress:
        bar = progress.add_task("designs", total=job.total, completed=job.done, outcomes=_outcomes(job))
        contact = time.monotonic()
        while job.active:
            time.sleep(_POLL_S)
            try:
                job = desk.get(job.id)
            except DatabaseUnavailable as error:
                if time.monotonic() - contact > _PATIENCE_S:
                    fail(f"{error}; the same command goes on from there")
                continue
            contact = time.monotonic()
            progress.update(bar, completed=job.done, outcomes=_outcomes(job))
    return job


def _outcomes(job: "Job") -> str:
    """Rows without counterweights, by the reason; what is proven infeasible is certified."""
    return f"{job.invalid} invalid, {job.infeasible} infeasible, {job.failed - job.infeasible} not certified"


def _finish(desk: "OwnerJobs", job: "Job", request: "SweepRequest", output: Path, as_json: bool) -> dict[str, int]:
    from service.jobs.export import export
    from service.jobs.files import FilesUnavailable
    from service.jobs.owner_jobs import NotFinished, RowsDamaged
    from service.jobs.worksheet import TooLargeForWorksheet

    schema = desk.schema(job)
    try:
        export(output, schema, (desk.selection if job.selects else desk.rows)(job, schema).batches)
        counts = _counts(desk, job, schema)
    except OSError as error:
        _write_failure(f"cannot write {output}: {error.strerror}; the same command tries again")
    except (RowsDamaged, FilesUnavailable) as error:
        _write_failure(f"cannot write {output}: {error} The same command goes on.")
    except (NotFinished, TooLargeForWorksheet) as error:
        _write_failure(f"cannot write {output}: {error}")
    if as_json:
        put(desk.state(job).model_dump_json())
    else:
        from service.report.chapters.sweep import swept

        best, title = _best(desk, job, request)
        show(swept(counts, best, tuple(axis.path for axis in request.axes), title))
        put(f"{output}: {desk.state(job).rows} rows")
    return counts


def _write_failure(message: str) -> NoReturn:
    typer.echo(message, err=True)
    raise typer.Exit(1)


def _counts(desk: "OwnerJobs", job: "Job", schema: "pa.Schema") -> dict[str, int]:
    from collections import Counter

    import pyarrow as pa

    counts: Counter[str] = Counter()
    for batch in desk.rows(job, pa.schema([schema.field("status")])).batches:
        for entry in batch.column("status").value_counts().to_pylist():
            counts[entry["values"]] += entry["counts"]
    return dict(counts)


def _best(desk: "OwnerJobs", job: "Job", request: "SweepRequest") -> "tuple[pa.Table, str]":
    import pyarrow as pa

    from optimizer.studies.sweep.reduce import Top
    from schemas.sweep.request import TopFilter

    schema = desk.schema(job)
    if job.selects:
        return pa.Table.from_batches(desk.selection(job, schema, 0, _FIRST_ROWS).batches, schema), "First rows"
    if "force_peak_N" not in schema.names:
        return schema.empty_table(), ""
    top = Top(TopFilter(by="force_peak_N", count=_FIRST_ROWS), schema)
    for batch in desk.rows(job, schema).batches:
        top.add(pa.Table.from_batches([batch]))
    return top.table(), "Smallest peak force"
