"""The kernel's work in the test's own process: a process of its own loads OpenCascade anew for each build."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Sequence
from types import TracebackType
from typing import Any, Self

from wrapit.pipeline.worker import Job


class KernelHere:
    """Stands in for `Worker`, with what crosses over to that pickled likewise.

    It neither survives a crash nor ends what takes too long: tests of that take the real one.
    """

    def __init__(self, preload: Sequence[str] = ()) -> None:
        pass

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        pass

    def start(self, where: str, limit_s: float, function: Callable[..., Any], *arguments: Any) -> Job:
        """Calls the function at once."""
        function, arguments = pickle.loads(pickle.dumps((function, arguments)))
        try:
            answer = (True, pickle.loads(pickle.dumps(function(*arguments))))
        except Exception as error:  # noqa: BLE001  `result` raises it
            answer = (False, error)
        return Job(where, limit_s, 0.0, answer)

    def is_free(self) -> bool:
        """Never: nothing is gained by doing half of a work here and the other half here."""
        return False

    def result(self, job: Job) -> Any:
        assert job.answer is not None
        succeeded, value = job.answer
        if not succeeded:
            raise value
        return value
