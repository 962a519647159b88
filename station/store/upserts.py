"""Rows that are put in whether or not they are there, in the dialects of both databases."""

from collections.abc import Mapping, Sequence
from typing import Any

from sqlalchemy import Connection, Table
from sqlalchemy.dialects import postgresql, sqlite

from station.store.database import is_postgres


def put(connection: Connection, table: Table, rows: Sequence[Mapping[str, Any]], keys: Sequence[str]) -> None:
    """Put rows in, all with values for the same columns; rows with the same `keys` that are there get these values."""
    if rows:
        statement = _insert(connection, table)
        others = {name: statement.excluded[name] for name in rows[0] if name not in keys}
        connection.execute(statement.on_conflict_do_update(index_elements=list(keys), set_=others), list(rows))


def put_if_new(connection: Connection, table: Table, rows: Sequence[Mapping[str, Any]], keys: Sequence[str]) -> None:
    """Put rows in unless rows with these `keys` are there."""
    if rows:
        connection.execute(_insert(connection, table).on_conflict_do_nothing(index_elements=list(keys)), list(rows))


def _insert(connection: Connection, table: Table) -> Any:  # noqa: ANN401 - two dialects' statements of one shape
    return (postgresql if is_postgres(connection) else sqlite).insert(table)
