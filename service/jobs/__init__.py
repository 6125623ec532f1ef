"""Durable jobs: what takes longer than a request.

A request becomes a job of chunks in a database (:mod:`~service.jobs.store`), a coordinator
(:mod:`~service.jobs.coordinator`) leases chunks and has an engine (:mod:`~service.jobs.engines`) run them, each chunk
becomes one file that is complete or absent (:mod:`~service.jobs.files`), and the rows are read back from those files
(:mod:`~service.jobs.results`).
"""
