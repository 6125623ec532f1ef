"""The jobs of a service: the parts of :mod:`service.jobs` put together, from its start to its end."""

from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from threading import Event

from service.common.private import close, close_unless_shared
from service.jobs import worker
from service.jobs.coordinator import Coordinator
from service.jobs.database import Database, DatabaseUnavailable
from service.jobs.engines import engine, reads_files
from service.jobs.files import JobFiles
from service.jobs.housekeeping import Housekeeping
from service.jobs.leases import Leases
from service.jobs.owner_jobs import OwnerJobs, Parts
from service.jobs.pace import Pace
from service.jobs.piece import Run
from service.jobs.retention import Retention
from service.jobs.rows import Limits
from service.jobs.schema import WrongSchema
from service.jobs.store import Store
from service.settings import Settings

_DAY_S = 86_400.0
_RESULTS = "results"


class JobService:
    """The jobs of a service.

    Parameters
    ----------
    run : computes a chunk; importable by workers.

    Raises
    ------
    ValueError
        if the settings name an engine or a database that there is not, or a database of another schema.
    """

    def __init__(self, settings: Settings, pace: Pace | None = None, run: Run = worker.run) -> None:
        where: str | Path = settings.database_url or settings.data_dir / "jobs.sqlite"
        # no file is made before its first use; another service may make it
        self._begun: Callable[[], bool] = lambda: not isinstance(where, Path) or where.exists()
        # of an earlier version, or made by hand: what is in it is nobody else's
        close(settings.data_dir / _RESULTS)
        close_unless_shared(settings.data_dir, {_RESULTS})
        self._database = Database(where, settings.database_busy_s)
        limits = _limits(settings)
        store, leases = Store(self._database, limits), Leases(self._database, limits)
        retention, files = Retention(self._database), JobFiles(settings.data_dir / _RESULTS)
        coordinator = Coordinator(
            store,
            leases,
            files,
            Housekeeping(store, retention, files),
            engine(settings.engine, settings.sweep_workers, settings.sweep_niceness),
            selector=None if reads_files(settings.engine) else engine("processes", 1, settings.sweep_niceness),
            pace=pace or Pace(lease_s=settings.lease_s),
            run=run,
            begun=self._begun,
        )
        self._parts = Parts(store, leases, retention, files, coordinator, Event())
        self._require_schema()

    def _require_schema(self) -> None:
        if self._begun():
            try:
                self._database.check()
            except WrongSchema as error:
                self._database.close()
                raise ValueError(str(error)) from error
            except DatabaseUnavailable:
                # it may come later; jobs wait for it
                pass

    def of(self, owner: str | None = None, sees_all: bool = True) -> OwnerJobs:
        """The jobs as an owner sees them."""
        return OwnerJobs(self._parts, owner, sees_all)

    def open(self) -> None:
        """Go on with what was begun before."""
        self._parts.coordinator.start()

    @property
    def closing(self) -> Event:
        """Streams of events end themselves when this is set."""
        return self._parts.closing

    def close(self) -> None:
        """Park what runs; it goes on at the next start."""
        self.closing.set()
        self._parts.coordinator.stop()
        self._database.close()

    def counts(self) -> Mapping[str, tuple[int, int, int, int]] | None:
        """By state: number of jobs, their finished, failed and invalid rows; None if nobody can say."""
        if not self._begun():
            return {}
        with suppress(DatabaseUnavailable, WrongSchema):
            return self._parts.store.counts()
        return None

    def faults(self) -> int:
        """How often a bound contradicted an answer, in chunks that this service took in since it started."""
        return self._parts.coordinator.faults


def _limits(settings: Settings) -> Limits:
    return Limits(
        keep_s=settings.results_keep_days * _DAY_S or None,
        active=settings.max_jobs,
        active_per_owner=settings.max_jobs_each,
        quota_bytes=round(settings.disk_quota_mb * 1e6) or None,
    )
