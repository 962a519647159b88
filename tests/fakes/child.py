"""A child process of a test that talks by lines: it says a word a line, and is told one a line."""

import subprocess
import sys
from collections.abc import Mapping, Sequence
from types import TracebackType
from typing import Self

ATTEMPTS = 3


def say(line: str) -> None:
    """What a child says to its test."""
    sys.stdout.write(line + "\n")
    sys.stdout.flush()


class Child:
    """`python -m MODULE ARGUMENTS` that has said `ready`; ended at the latest when its `with` block is left.

    One that ends before it is ready is started anew: JACK gives a client seconds to join, and a machine that stands
    still meanwhile takes them away.
    """

    def __init__(self, module: str, arguments: Sequence[str], env: Mapping[str, str]) -> None:
        self._command, self._env = [sys.executable, "-m", module, *arguments], dict(env)
        for attempt in range(ATTEMPTS):
            self._process = self._started()
            try:
                self.expect("ready")
            except AssertionError:
                self.stop()
                if attempt == ATTEMPTS - 1:
                    raise
            except BaseException:
                self.stop()
                raise
            else:
                return

    def _started(self) -> "subprocess.Popen[str]":
        return subprocess.Popen(
            self._command, env=self._env, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1
        )

    @property
    def pid(self) -> int:
        """Its process id."""
        return self._process.pid

    def expect(self, word: str) -> None:
        """Wait for the next line and check it; the test's own timeout bounds the wait."""
        assert self._process.stdout is not None
        line = self._process.stdout.readline().strip()
        assert line == word, f"the child said {line!r} instead of {word!r}"

    def tell(self, line: str) -> None:
        """Say one line to the child."""
        assert self._process.stdin is not None
        self._process.stdin.write(line + "\n")
        self._process.stdin.flush()

    def stop(self) -> None:
        """Let the child end by itself, by force where it does not."""
        if self._process.stdin is not None:
            self._process.stdin.close()
        try:
            self._process.wait(5)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        if self._process.stdout is not None:
            self._process.stdout.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, fault: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.stop()
