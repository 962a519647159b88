"""A URL says where a history is; nobody reads a password out of what is told about it."""

from pathlib import Path

import pytest

from station.core.errors import BadInput
from station.store.database import Database
from station.store.database_url import file_of, name_of, parsed, sqlite_url


@pytest.mark.parametrize("kind", ["postgres", "postgresql", "postgresql+psycopg", "PostgreSQL", "postgresql+psycopg2"])
def test_a_server_by_any_of_its_schemes(kind: str) -> None:
    url = parsed(f"{kind}://ann@school.example:5433/drums?sslmode=require")
    assert url.drivername == "postgresql+psycopg"
    assert (url.host, url.port, url.database, url.username) == ("school.example", 5433, "drums", "ann")
    assert file_of(url) is None
    assert name_of(url) == "postgresql://ann@school.example:5433/drums"


@pytest.mark.parametrize(
    "url",
    [
        "postgresql://ann:s3cret@school.example/drums",
        "postgres://ann:s3%63ret@school.example/drums?application_name=x",
        "postgresql://school.example/drums?user=ann&password=s3cret",
        "postgresql://school.example/drums?sslpassword=s3cret",
        "postgresql://ann:s3cret@/drums?host=/run/postgresql",
    ],
)
def test_a_password_is_in_no_name(url: str) -> None:
    database = Database(url)
    told = f"{database.name} {database.url!r}"
    assert "s3cret" not in database.name
    assert "s3%63ret" not in told
    assert "drums" in database.name


@pytest.mark.parametrize(
    ("url", "path"),
    [
        ("sqlite:////home/ann/history.sqlite3", "/home/ann/history.sqlite3"),
        ("sqlite+pysqlite:////home/ann/a b.sqlite3", "/home/ann/a b.sqlite3"),
        ("sqlite:////home/ann/what%3F%23%25.sqlite3", "/home/ann/what?#%.sqlite3"),
        ("sqlite:////home/%C3%A9mile/1#2.sqlite3", "/home/émile/1#2.sqlite3"),
        (" sqlite:////home/ann/history.sqlite3\n", "/home/ann/history.sqlite3"),
    ],
)
def test_a_file_by_its_path(url: str, path: str) -> None:
    assert file_of(parsed(url)) == Path(path)
    assert file_of(parsed(sqlite_url(Path(path)))) == Path(path)
    assert name_of(parsed(url)) == path


@pytest.mark.parametrize(
    ("url", "told"),
    [
        ("history.sqlite3", "is no URL of a database"),
        ("/home/ann/history.sqlite3", "is no URL of a database"),
        ("C:\\Users\\Ann\\history.sqlite3", "is no URL of a database"),
        ("mysql://ann@school.example/drums", "'mysql' is none of postgres, postgresql, sqlite"),
        ("sqlite://", "needs a file"),
        ("sqlite:///", "needs a file"),
        ("sqlite:///:memory:", "needs a file"),
        ("sqlite://school.example/history.sqlite3", "needs a file"),
        ("sqlite:////home/nul%00", "needs a file"),
        ("sqlite:////home/ann/history.sqlite3?mode=ro", "takes no options"),
        ("sqlite:///history.sqlite3", "has no folder"),
        ("postgresql://ann:s3cret@school.example:port/drums", "is no URL of a database"),
        ("://", "'' is none of"),
    ],
)
def test_what_is_no_url_of_ours_is_told_in_a_line(url: str, told: str) -> None:
    with pytest.raises(BadInput, match=told) as refused:
        parsed(url)
    assert "s3cret" not in str(refused.value)
