"""Says in one line what the folder of oracles lacks."""

import pytest
from _pytest.terminal import TerminalReporter

from tests.oracles.folder import ORACLES, lacking


def pytest_terminal_summary(terminalreporter: TerminalReporter, config: pytest.Config) -> None:
    """This file is read by every run of the tests; only a run of the oracles misses them."""
    missing = lacking() if config.option.markexpr == "oracle" else []
    if missing:
        terminalreporter.write_line(f"{ORACLES} lacks, so that nothing was compared with it: {', '.join(missing)}")
