"""What a database's URL says: which kind, where; and how it is named to a reader, without its password."""

from pathlib import Path
from urllib.parse import quote, unquote

from sqlalchemy.engine import URL, make_url
from sqlalchemy.exc import ArgumentError

from station.core.errors import BadInput

DRIVERS = {"sqlite": "sqlite+pysqlite", "postgresql": "postgresql+psycopg", "postgres": "postgresql+psycopg"}
"""What each kind of database that a URL may name is reached by."""
_EXAMPLES = "postgresql://user@host/name or sqlite:////folder/history.sqlite3"


def parsed(url: str) -> URL:
    """The URL of a database of ours; raises `BadInput` for any other.

    `postgres://` is `postgresql://`. A SQLite file has its whole path, percent-encoded where a URL asks for it.
    """
    scheme, mark, rest = url.strip().partition("://")
    kind = scheme.partition("+")[0].lower()
    if not mark:
        raise BadInput("history", "", f"is no URL of a database, such as {_EXAMPLES}")
    if kind not in DRIVERS:
        raise BadInput("history", "", f"{kind!r} is none of {', '.join(sorted(DRIVERS))}")
    return _file(rest) if kind == "sqlite" else _server(kind, rest)


def sqlite_url(path: Path) -> str:
    """The URL of a SQLite file, whatever letters its path has."""
    return f"sqlite:///{quote(path.absolute().as_posix(), safe='/:', errors='surrogateescape')}"


def file_of(url: URL) -> Path | None:
    """The file of a SQLite database; None for a server."""
    return Path(url.database or "") if url.drivername == DRIVERS["sqlite"] else None


def name_of(url: URL) -> str:
    """The file, or the server and its database: no password, whichever way it was given."""
    path = file_of(url)
    if path is not None:
        return str(path)
    where = {key: value for key, value in url.query.items() if key in ("host", "port")}
    told = URL.create("postgresql", url.username, None, url.host, url.port, url.database, where)
    return told.render_as_string()


def _file(rest: str) -> URL:
    host, _, path = rest.partition("/")
    path, _, options = path.partition("?")
    path = unquote(path, errors="surrogateescape")
    if host or not path or path == ":memory:" or "\0" in path:
        raise BadInput("history", "", "a SQLite URL needs a file: sqlite:////folder/history.sqlite3")
    if options:
        raise BadInput("history", "", "a SQLite URL takes no options; a ? in the name of a file is written %3F")
    if not Path(path).is_absolute():
        raise BadInput("history", "", f"the file {path} has no folder: sqlite:////folder/{path}")
    return URL.create(DRIVERS["sqlite"], database=path)


def _server(kind: str, rest: str) -> URL:
    try:
        return make_url(f"{kind}://{rest}").set(drivername=DRIVERS[kind])
    except (ArgumentError, ValueError):
        raise BadInput("history", "", f"is no URL of a database, such as {_EXAMPLES}") from None
