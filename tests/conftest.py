"""Settings for all tests."""

import gc
import os
import signal
from collections.abc import Iterator
from itertools import count
from pathlib import Path

import pytest
from hypothesis import settings
from xdist.remote import Producer
from xdist.scheduler import LoadGroupScheduling

from tests.fakes.browser import Browser, chromium
from tests.fakes.postgres_server import PostgresServer, postgres_server

gc.disable()  # 17,500 tests are found: looked through again and again for garbage, they took a fifth of that time


def pytest_collection_finish() -> None:
    """From here on garbage is looked for among what the tests make, and no longer in the tests themselves."""
    gc.collect()
    gc.freeze()
    gc.enable()


# On a shared machine a stall of any length may fall into any example: time belongs in benchmarks, not in properties.
# The same examples in every run, so that a red test means a change; `SEARCH=1` looks for new ones.
settings.register_profile("station", deadline=None, derandomize=not os.environ.get("SEARCH"))
settings.load_profile("station")


if hasattr(signal, "SIGHUP"):
    signal.signal(signal.SIGHUP, signal.SIG_DFL)  # as where the tests were begun by hand, also under `nohup`


@pytest.fixture(scope="session", autouse=True)
def _nobodys_settings(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """No test reads or writes the settings and kits of whoever runs it (where XDG says where they are)."""
    with pytest.MonkeyPatch.context() as patch:
        for kind in ("CONFIG", "DATA"):
            patch.setenv(f"XDG_{kind}_HOME", str(tmp_path_factory.mktemp(kind.lower())))
        yield


@pytest.fixture(scope="session")
def _documents(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """Folders that are not there yet, another one each time."""
    base = tmp_path_factory.mktemp("documents")
    return (base / f"{number}" for number in count())


@pytest.fixture(autouse=True)
def _nobodys_sessions(_documents: Iterator[Path], monkeypatch: pytest.MonkeyPatch) -> None:
    """Every test begins without any session or history, and keeps none where whoever runs it has theirs."""
    documents = next(_documents)
    monkeypatch.setenv("XDG_DOCUMENTS_DIR", str(documents))
    monkeypatch.setenv("XDG_DATA_HOME", str(documents.with_name(f"data-{documents.name}")))


@pytest.fixture(scope="session")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    """One Chromium for all tests that open pages: none is begun before the first of them."""
    with chromium(tmp_path_factory.mktemp("chromium")) as begun:
        yield begun


@pytest.fixture(scope="session")
def postgres() -> Iterator[PostgresServer]:
    """One server for all tests of a process: none is begun before the first that needs one."""
    with postgres_server() as server:
        yield server


LONGEST = ("tests/e2e", "tests/gui", "tests/render", "tests/unit/motion")
"""Their modules take longest: begun first, in this order, they leave no worker alone at the end.

Those with a JACK server wait more than they compute: they come while types are checked beside the tests (`make check`).
"""


def _place(item: pytest.Item) -> int:
    folder = item.path.relative_to(item.config.rootpath).as_posix()
    return next((place for place, long in enumerate(LONGEST) if folder.startswith(f"{long}/")), len(LONGEST))


@pytest.hookimpl(tryfirst=True)  # xdist reads the groups in the same hook
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Tests with a JACK server go to one worker: libjack keeps one state a process and one registry a user.

    So do tests with a browser, which takes seconds to begin.
    """
    for item in items:
        if item.get_closest_marker("jack"):
            item.add_marker(pytest.mark.xdist_group("jack"))
        if "browser" in getattr(item, "fixturenames", ()):
            item.add_marker(pytest.mark.xdist_group("browser"))
    items.sort(key=_place)  # the rest stays in random order


class _ByModule(LoadGroupScheduling):  # type: ignore[misc]  # xdist is not typed
    """A module's tests go to one worker, so that what they share is made once; groups stay together as ever."""

    def _split_scope(self, nodeid: str) -> str:
        return str(super()._split_scope(nodeid)).partition("::")[0]


def pytest_xdist_make_scheduler(config: pytest.Config, log: Producer) -> LoadGroupScheduling | None:
    """How `--dist loadgroup` deals out the tests here: xdist asks its projects by this hook."""
    return _ByModule(config, log) if config.getoption("dist") == "loadgroup" else None


def pytest_make_parametrize_id(val: object) -> str | None:
    """Bytes have no name: a packed file holds the second it was made in, and two workers would name it differently."""
    return "bytes" if isinstance(val, bytes) else None
