"""What nobody needs any more: jobs whose time is over, and what crashes leave behind."""

import logging
from contextlib import suppress

from service.jobs.files import JobFiles
from service.jobs.job import Record
from service.jobs.retention import Retention
from service.jobs.rows import UnknownJob
from service.jobs.spool import remove_leftovers
from service.jobs.store import Store

_LOG = logging.getLogger(__name__)
#: folders of ended jobs that are looked through at a time
_AT_A_TIME = 20


class Housekeeping:
    """Removes files; never those of a job that runs, of another database, or of a service that lives."""

    def __init__(self, store: Store, retention: Retention, files: JobFiles) -> None:
        self._store, self._retention, self._files = store, retention, files
        #: version that a job had when its folder was tidy
        self._tidy_jobs: dict[str, int] = {}

    def tidy(self) -> None:
        """Remove what can be removed now; called again and again.

        Raises
        ------
        DatabaseUnavailable
        """
        self._retention.mark_expired()
        for job in self._retention.removed():
            with suppress(OSError):
                self._files.remove(job)
                self._retention.forget(job)
        self._remove_unknown()
        self._tidy_ended()
        gone = remove_leftovers()
        if gone:
            _LOG.warning("removed the messages of %d services that were killed", gone)

    def _remove_unknown(self) -> None:
        # listed before the jobs are: a job is in the database before it has a folder
        folders = self._files.folders()
        if not folders:
            return
        if not self._files.belongs_to(self._retention.identity()):
            _LOG.warning("the folder of the results belongs to another database; nothing is removed from it")
            return
        gone = self._files.remove_unknown(folders, self._retention.job_ids())
        if gone:
            _LOG.warning("removed %d folders of jobs that there are not", gone)

    def _tidy_ended(self) -> None:
        ended = self._retention.ended()
        self._tidy_jobs = {job: version for job, version in self._tidy_jobs.items() if ended.get(job) == version}
        for job in [job for job in ended if job not in self._tidy_jobs][:_AT_A_TIME]:
            with suppress(UnknownJob):
                # listed before the records are: a record is in the database before a job ends
                names, entry = self._files.names(job), self._store.get(job)
                if not entry.active:
                    self._files.tidy(job, names, self._records(job))
                    self._tidy_jobs[job] = entry.version

    def remove(self, job: str, record: Record) -> None:
        """Remove a file unless the database knows it. Others are left alone: another service may be about to tell it
        of one."""
        self._files.tidy(job, [self._files.piece(job, record).name], self._records(job))

    def _records(self, job: str) -> list[Record]:
        selection = self._store.selection(job)
        return [*self._store.pieces(job), *([] if selection is None else [selection])]
