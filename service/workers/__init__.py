"""Processes that compute answers.

A computation runs in a process of its own (:mod:`~service.workers.worker`): it can be ended when its client is gone or
its time is over, its memory has a limit, and it never holds up the event loop. The pool
(:mod:`~service.workers.pool`) lends processes to requests, in turns (:mod:`~service.fairness.queue`) by what each owner
has had, altogether (:mod:`~service.fairness.accounts`) and lately (:mod:`~service.fairness.loads`). They are forked
(:mod:`~service.workers.process`) from one that has loaded and compiled everything (:mod:`~service.workers.preload`), so
a process that was ended is replaced in hundredths of a second.
"""
