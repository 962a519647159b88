"""Rows that are put in whether or not they are there, in the dialects of both databases."""

from collections.abc import Mapping, Sequence
from typing import Any

from sqlalchemy import Connection, Table
from sqlalchemy.dialects import postgresql, sqlite

from station.store.database import is_postgres


def put(connection: Connection, table: Table, values: Mapping[str, Any], keys: Sequence[str]) -> None:
    """Put a row in, or give the row with these `keys` its values."""
    insert: Any = (postgresql if is_postgres(connection) else sqlite).insert(table)
    others = {name: value for name, value in values.items() if name not in keys}
    statement = insert.values(**values)
    connection.execute(
        statement.on_conflict_do_update(index_elements=list(keys), set_=others)
        if others
        else statement.on_conflict_do_nothing(index_elements=list(keys))
    )


def put_if_new(connection: Connection, table: Table, values: Mapping[str, Any], keys: Sequence[str]) -> None:
    """Put a row in unless one with these `keys` is there."""
    insert: Any = (postgresql if is_postgres(connection) else sqlite).insert(table)
    connection.execute(insert.values(**values).on_conflict_do_nothing(index_elements=list(keys)))
