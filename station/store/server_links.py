"""Connections to a PostgreSQL server for which nobody waits too long, whatever becomes of it and of the network."""

import time
from collections.abc import Generator
from typing import TYPE_CHECKING, Any, TypeVar

from station.store.patience import ANSWER_S, CONNECT_S, PATIENCE_S, left_of, waiting

if TYPE_CHECKING:
    from psycopg import Connection as Link

_LEAST_S = 2
"""No connection is given up sooner by libpq."""
_NO_PASSWORD = (
    "no password supplied: it belongs in the file ~/.pgpass, which its owner alone may read (chmod 600), else it is"
    " left aside"
)
_T = TypeVar("_T")


def connect_args() -> dict[str, Any]:
    """What connections are made with: the server itself ends what takes too long, and lets go of who fell silent."""
    limits = {
        "lock_timeout": PATIENCE_S,
        "statement_timeout": ANSWER_S,
        "idle_in_transaction_session_timeout": ANSWER_S,
    }
    options = " ".join(f"-c {name}={round(1000 * value_s)}" for name, value_s in limits.items())
    return {"connect_timeout": CONNECT_S, "options": options}


def connected(_dialect: object, _record: object, words: tuple[Any, ...], arguments: dict[str, Any]) -> "Link[Any]":
    """A connection that gives up itself where the server neither answers nor goes away.

    Whoever is in a hurry (`patience`) waits no longer than that for connection and answers in all.
    """
    import psycopg  # noqa: PLC0415 - who keeps their history in a file need not have it

    class Impatient(psycopg.Connection[Any]):
        def wait(self, gen: Generator[Any, Any, _T], *args: Any, **others: Any) -> _T:  # noqa: ANN401 - as there
            # SQLAlchemy asks outside transactions whether the server is there, and nothing else
            within_s = left_of(CONNECT_S if self.autocommit else ANSWER_S + CONNECT_S)
            try:
                with waiting():
                    return super().wait(_answered(gen, within_s), *args, **others)
            except TimeoutError:
                self.close()
                raise psycopg.OperationalError(f"the server has not answered for {within_s:.0f} s") from None

    within_s = left_of(arguments["connect_timeout"])
    if within_s <= 0:
        raise psycopg.OperationalError("the server has not answered, and nobody waits longer")
    try:
        with waiting():
            return Impatient.connect(*words, **{**arguments, "connect_timeout": max(round(within_s), _LEAST_S)})
    except psycopg.OperationalError as fault:
        if "no password supplied" in str(fault):  # libpq's words, after a function of its own
            raise psycopg.OperationalError(_NO_PASSWORD) from fault
        raise


def _answered(gen: Generator[Any, Any, _T], within_s: float) -> Generator[Any, Any, _T]:
    """What `gen` comes to; `TimeoutError` where its server gives it nothing to do for so long.

    psycopg runs it whenever something has come, and ten times a second where nothing has.
    """
    until = time.monotonic() + within_s
    try:
        ready = yield next(gen)
        while ready or time.monotonic() < until:
            ready = yield gen.send(ready)
    except StopIteration as end:
        return end.value  # type: ignore[no-any-return]
    raise TimeoutError
