"""Work that is done when it is begun, in this process; what goes in and comes out is pickled, as between two."""

import pickle
from collections.abc import Callable
from typing import Any

from station.core.errors import StationError


class WorkAtOnce:
    """Stands in for `WorkerProcess`."""

    def __init__(self, do: Callable[..., Any], *words: object) -> None:
        self.was_ended = False
        do, words = pickle.loads(pickle.dumps((do, words)))
        try:
            found = do(*words)
        except StationError as fault:
            found = fault
        self._found = pickle.dumps(found)

    def result(self) -> Any:  # noqa: ANN401 - whatever the work gives
        found = pickle.loads(self._found)
        if isinstance(found, StationError):
            raise found
        return found

    def end(self) -> None:
        self.was_ended = True
