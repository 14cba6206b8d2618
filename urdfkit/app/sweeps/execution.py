"""Execution of runs: in this process, in processes on this machine, or on a cluster of Dask."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from concurrent.futures import CancelledError
from contextlib import contextmanager
from itertools import islice
from typing import TYPE_CHECKING

from urdfkit.app.sweeps.scenario import RunOutcome, Scenario
from urdfkit.app.sweeps.variations import SweepRun
from urdfkit.errors import UrdfkitError, UsageError

if TYPE_CHECKING:
    from distributed import Client

WAITING = 8
"""Runs that are submitted for each worker, so that none waits for the next one."""


def execute(
    scenario: Scenario, runs: Sequence[SweepRun], *, workers: int, scheduler: str | None
) -> Iterator[RunOutcome]:
    """Simulate runs; yield each outcome as soon as it is known, in any order.

    Args:
        scenario: robots, worlds and options that the runs share.
        runs: the runs.
        workers: number of processes on this machine; with one, the runs are in this process.
        scheduler: address of a Dask scheduler, such as ``tcp://10.0.0.1:8786``; None for this machine.

    Raises:
        UsageError: the scheduler cannot be reached.
        UrdfkitError: a parameter or metric is invalid, or a process was killed.
    """
    if not runs:
        return
    if scheduler is None and min(workers, len(runs)) == 1:
        yield from map(scenario.simulate, runs)
        return
    from distributed import KilledWorker, as_completed

    with _client(min(workers, len(runs)), scheduler) as client:
        shared = client.scatter(scenario, hash=False)
        left = iter(runs)

        def submit(count: int) -> list[object]:
            return [client.submit(Scenario.simulate, shared, run, pure=False) for run in islice(left, count)]

        cores = sum(client.nthreads().values()) or workers
        finished = as_completed(submit(cores * WAITING))
        for future in finished:
            try:
                outcome = future.result()
            except (KilledWorker, CancelledError):  # cancelled: the scenario was in the killed process
                raise UrdfkitError(
                    f"a worker process of the sweep was killed, possibly for lack of memory; run the same command with "
                    f"fewer --workers than {workers}, which continues with the remaining runs"
                ) from None
            yield outcome
            for following in submit(1):
                finished.add(following)


@contextmanager
def _client(workers: int, scheduler: str | None) -> Iterator[Client]:
    """Connect to a scheduler, or start workers on this machine that only this process can connect to.

    Raises:
        UsageError: the scheduler cannot be reached.
    """
    import logging

    import dask
    from distributed import Client, LocalCluster, Security

    if scheduler is not None:
        try:
            client = Client(scheduler, timeout=10)
        except (OSError, ValueError) as error:
            raise UsageError(f"no Dask scheduler at {scheduler}: {error or type(error).__name__}") from None
        with client:
            yield client
        return
    # Dask executes what its sockets receive: certificates of this process keep other users of the machine out.
    # Workers that close log connections that are cut off as errors, with tracebacks. Failures of runs are raised by
    # their futures.
    quiet = {"distributed.nanny.pre-spawn-environ.DASK_LOGGING__DISTRIBUTED": "critical"}
    with (
        dask.config.set(quiet),
        LocalCluster(
            n_workers=workers,
            threads_per_worker=1,
            dashboard_address=None,
            memory_limit=None,
            security=Security.temporary(),
            silence_logs=logging.CRITICAL,
        ) as cluster,
        Client(cluster) as client,
    ):
        yield client
