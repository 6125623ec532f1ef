"""Durable jobs: what takes longer than a request.

A request becomes a job of chunks in a database (:mod:`~service.jobs.store`). A coordinator
(:mod:`~service.jobs.coordinator`) leases chunks and has an engine (:mod:`~service.jobs.engines`) run them. Each chunk
becomes one file that is complete or absent (:mod:`~service.jobs.files`). The rows are read back from those files
(:mod:`~service.jobs.results`).
"""
