"""Like things are made by two processes, with the results of one."""

from __future__ import annotations

import os
import time

import pytest

from wrapit.errors import KernelError
from wrapit.pipeline.sharing import shared
from wrapit.pipeline.worker import OnCall, Worker


def _with_maker(number: int) -> tuple[int, int]:
    time.sleep(0.05)
    return 10 * number, os.getpid()


def _slow_elsewhere(number: int) -> int:
    if number:
        time.sleep(60)
    return number


def _fails(number: int) -> int:
    if number > 1:
        raise KernelError("it can't be made", f"thing {number}", "")
    return number


@pytest.mark.parametrize("count", [0, 1, 2, 9])
def test_results_are_in_the_order_of_the_things(count: int) -> None:
    with OnCall(Worker) as kernel:
        hired = kernel.worker()
        hired.result(hired.start("start", 60, os.getpid))  # it runs
        made = shared(kernel, "things", 60)(_with_maker, range(count))
    assert [value for value, _ in made] == [10 * number for number in range(count)]
    makers = {pid for _, pid in made}
    assert makers <= {os.getpid(), hired._process.pid}
    assert len(makers) == min(count, 2)


def test_a_busy_process_gets_nothing_more() -> None:
    with OnCall(Worker) as kernel:
        job = kernel.worker().start("long", 60, _with_maker, 7)
        while not kernel.is_free():
            pass
        long = kernel.worker().start("longer", 60, time.sleep, 1)
        made = shared(kernel, "things", 60)(_with_maker, range(4))
        assert {pid for _, pid in made} == {os.getpid()}
        assert kernel.worker().result(long) is None
        assert kernel.worker().result(job)[0] == 70  # answers are kept, in whatever order they are asked for


def test_nobody_is_hired_for_it() -> None:
    with OnCall(lambda: pytest.fail("hired")) as kernel:
        made = shared(kernel, "things", 60)(_with_maker, range(3))
    assert {pid for _, pid in made} == {os.getpid()}


def test_errors_and_time_limits_of_the_other_come_through() -> None:
    with OnCall(Worker) as kernel:
        hired = kernel.worker()
        hired.result(hired.start("start", 60, os.getpid))
        with pytest.raises(KernelError, match="it can't be made") as failed:
            shared(kernel, "things", 60)(_fails, range(3))
        assert failed.value.where == "thing 2"
        with pytest.raises(KernelError, match="within 1 s") as late:
            shared(kernel, "things", 1)(_slow_elsewhere, range(2))
        assert late.value.where == "things"
