"""The history of a user's settings: opened once in a program, and shared from then on."""

from functools import lru_cache

from station.core.settings import Settings, data_folder
from station.store.database import Database
from station.store.database_url import sqlite_url
from station.store.history import History

FILE_NAME = "history.sqlite3"


def history_of(settings: Settings) -> History:
    """The history that `settings` name, else the file in the user's data folder.

    Raises `BadInput` for a URL that is none, for another program's database and for a newer station's, `DeviceError`
    where it cannot be reached.
    """
    return _opened(history_url(settings))


def history_url(settings: Settings) -> str:
    """Where the history is that `settings` name."""
    return settings.history or sqlite_url(data_folder() / FILE_NAME)


@lru_cache(maxsize=4)
def _opened(url: str) -> History:
    return History(Database(url))
