"""An executor that does nothing until it is told to."""

from collections.abc import Callable
from concurrent.futures import Executor, Future
from functools import partial


class WorkLater(Executor):
    """Keeps what is submitted; `work` does it, in order."""

    def __init__(self) -> None:
        self.tasks: list[tuple[Future[object], Callable[[], object]]] = []

    def submit(self, fn: Callable[..., object], /, *args: object, **kwargs: object) -> Future[object]:  # type: ignore[override]
        future: Future[object] = Future()
        self.tasks.append((future, partial(fn, *args, **kwargs)))
        return future

    def work(self) -> None:
        for future, task in self.tasks:
            if future.set_running_or_notify_cancel():
                try:
                    future.set_result(task())
                except Exception as fault:  # as an executor does
                    future.set_exception(fault)
        self.tasks = []
