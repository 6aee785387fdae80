"""Signals wait while files are being moved, whichever thread takes them."""

from __future__ import annotations

import os
import signal
import threading

import pytest

from wrapit.pipeline.output.guards import signals_held


class Ended(BaseException):
    pass


def _end(signum: int, frame: object) -> None:  # noqa: ARG001  the signature is Python's
    raise Ended


def _work_through(signum: signal.Signals, done: list[int]) -> None:
    with signals_held():
        for _ in range(3):
            os.kill(os.getpid(), signum)
            done.append(sum(range(100_000)))


@pytest.mark.parametrize("signum", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP], ids=lambda each: each.name)
@pytest.mark.parametrize("others", [0, 2], ids=["alone", "beside other threads"])
def test_signals_wait_for_the_end_of_the_block(signum: signal.Signals, others: int) -> None:
    done: list[int] = []
    stop = threading.Event()
    threads = [threading.Thread(target=stop.wait, daemon=True) for _ in range(others)]
    earlier = signal.signal(signum, _end)
    try:
        for thread in threads:
            thread.start()
        with pytest.raises(Ended):
            _work_through(signum, done)
        assert len(done) == 3
        assert signal.getsignal(signum) is _end
        assert signum not in signal.pthread_sigmask(signal.SIG_BLOCK, [])
    finally:
        stop.set()
        signal.signal(signum, earlier)


def test_what_is_ignored_stays_so() -> None:
    earlier = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with signals_held():
            os.kill(os.getpid(), signal.SIGHUP)
        os.kill(os.getpid(), signal.SIGHUP)
        assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGHUP, earlier)


def test_other_threads_have_nothing_to_hold() -> None:
    ran = []

    def run() -> None:
        with signals_held():
            ran.append(True)

    thread = threading.Thread(target=run)
    thread.start()
    thread.join()
    assert ran == [True]
