"""The folder of a battle under the sessions of whoever plays first: capture, document and report.

`<sessions>/<student>/<date>_battle-<opponent>/` has `battle.capture`, `battle.json` and `battle.txt`. The capture is
written by the engine while it is played, so that one that was cut off lacks its report and nothing else.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from station.core.disk.files import write_whole
from station.core.errors import BadInput, DeviceError
from station.core.settings import Settings
from station.devices.capture.capture import read_capture
from station.practice.battle.battle_result import BattleResult
from station.practice.battle.records.battle_document import battle_document
from station.practice.battle.records.battle_report import battle_report
from station.practice.battle.records.judge_battle_again import judge_battle_again
from station.practice.history.begun_folder import BegunFolder
from station.practice.history.session_files import BATTLE_CAPTURE_NAME, BATTLE_NAME, write_document
from station.practice.history.session_intake import is_over
from station.practice.history.session_keeping import keep_session
from station.practice.history.student_history import StudentHistory
from station.scoring.matching.hit_windows import Level
from station.scoring.report.assessment_document import Json
from station.store.rows import SessionKind, SessionState

TEXT_NAME = "battle.txt"


@dataclass(frozen=True, slots=True)
class BattleFolder(BegunFolder):
    """One battle's folder."""

    @classmethod
    def make(cls, wanted: Path | None, settings: Settings, opponent: str) -> "BattleFolder":
        """One made before anybody plays; `wanted` is a folder that the user named, None for a new one of the student's.

        Raises `BadInput` or `DeviceError` where it cannot be made.
        """
        return cls.begin(wanted, settings, f"battle-{opponent}", SessionKind.BATTLE)

    @property
    def capture(self) -> Path:
        """Where the capture is kept."""
        return self.path / BATTLE_CAPTURE_NAME

    @property
    def report(self) -> Path:
        """Where the report in words is kept."""
        return self.path / TEXT_NAME

    def write(self, result: BattleResult) -> str | None:
        """Keep a battle that is over; None, or why the history does not have it. Raises `DeviceError`."""
        return self.keep(battle_document(result), battle_report(result))

    def keep(self, document: Mapping[str, Json], report: str) -> str | None:
        """Keep a battle that is over as a document and in words, and in the history; raises `DeviceError`.

        Returns None, or a line that says why the history does not have it.
        """
        write_document(self.path / BATTLE_NAME, document)
        write_whole(self.report, report.encode())
        return keep_session(self.whose, self.path)

    def discard(self) -> None:
        """Leave nothing of a battle that nobody played; raises `DeviceError`."""
        try:
            self.capture.unlink(missing_ok=True)
        except OSError as fault:
            raise DeviceError(f"{self.capture}: it stays: {fault.strerror or fault}") from fault
        self.let_go()


def kept_battle(path: Path, level: Level | None = None) -> BattleResult:
    """The battle that is kept in a folder, or in a capture, judged again; raises `BadInput` where there is none."""
    capture = path / BATTLE_CAPTURE_NAME if path.is_dir() else path
    return judge_battle_again(read_capture(capture), level)


def recovered_battle(folder: Path) -> BattleResult:
    """A battle that was cut off, judged as it would have been at its end; raises `BadInput` where none was."""
    if (folder / BATTLE_NAME).exists():
        raise BadInput(folder, "", "this battle has its report")
    if not (folder / BATTLE_CAPTURE_NAME).is_file():
        raise BadInput(folder, "", f"no battle was begun in this folder: it holds no {BATTLE_CAPTURE_NAME}")
    return kept_battle(folder)


def battles_cut_off(whose: StudentHistory) -> list[Path]:
    """The folders of a student's battles that lack their report, the newest first, wherever they lie."""
    rows = whose.ask(lambda history, student: history.sessions(student, state=SessionState.BEGUN)) or []
    folders = [Path(row.folder) for row in reversed(rows) if row.kind is SessionKind.BATTLE]
    return [path for path in folders if (path / BATTLE_CAPTURE_NAME).is_file() and not is_over(path)]
