"""Plays scenarios in one window and writes what they saw to a JSON file (`play_scenarios.py` is what is run).

A window takes seconds to open: scenarios that leave nothing behind share one, which the first of them sizes and staffs.
With a picture's name (`FILE.png`) the window's last frame is kept there.

A process of its own, because imgui and OpenGL keep state for as long as a process lives.
"""

import json
from pathlib import Path

import numpy as np
from imgui_bundle import hello_imgui

from station.render.files.png_file import write_png
from tests.gui.battle_scenario import battle
from tests.gui.choice_scenarios import choices
from tests.gui.device_scenarios import calibration, devices, habits, sticks
from tests.gui.drive import NEWCOMER, PICTURE_EVERY, SIZE, Drive, Scenario
from tests.gui.editor_scenarios import (
    by_keyboard,
    by_kit,
    by_mouse,
    by_steps,
    changes_what_plays,
    closes_by_escape,
    edits_until_killed,
    finds_draft,
)
from tests.gui.exam_scenario import exam
from tests.gui.figure import figure
from tests.gui.friend_scenario import friend
from tests.gui.history_scenario import history
from tests.gui.interruption_scenarios import closes, lost, unplugged
from tests.gui.lesson_list_scenarios import imports, search, whose
from tests.gui.newcomer_scenario import first_minute, newcomer
from tests.gui.planned_day import planned_day
from tests.gui.player_scenarios import graph, phase, player
from tests.gui.practice_scenarios import drill, fault, highway, just_play, keys, practise
from tests.gui.song_scenario import song
from tests.gui.sound_scenario import sound
from tests.gui.staff_scenarios import clicks, words
from tests.gui.teacher_scenario import there_and_back
from tests.gui.view_scenarios import legible, look, resized, score, viewpoints, worn

SCENARIOS: dict[str, Scenario] = {
    "practise": practise,
    "choices": choices,
    "keys": keys,
    "just_play": just_play,
    "highway": highway,
    "drill": drill,
    "fault": fault,
    "closes": closes,
    "unplugged": unplugged,
    "lost": lost,
    "newcomer": newcomer,
    "first_minute": first_minute,
    "search": search,
    "whose": whose,
    "whose_in_a_large_window": whose,
    "imports": imports,
    "look": look,
    "viewpoints": viewpoints,
    "score": score,
    "worn": worn,
    "resized": resized,
    "legible": legible,
    "devices": devices,
    "calibration": calibration,
    "sticks": sticks,
    "habits": habits,
    "player": player,
    "graph": graph,
    "phase": phase,
    "figure": figure,
    "song": song,
    "sound": sound,
    "planned_day": planned_day,
    "history": history,
    "battle": battle,
    "friend": friend,
    "exam": exam,
    "exam_in_a_small_window": exam,
    "there_and_back": there_and_back,
    "by_mouse": by_mouse,
    "by_keyboard": by_keyboard,
    "by_kit": by_kit,
    "by_steps": by_steps,
    "edits_until_killed": edits_until_killed,
    "finds_draft": finds_draft,
    "changes_what_plays": changes_what_plays,
    "closes_by_escape": closes_by_escape,
    "clicks": clicks,
    "words": words,
}
SIZES = {
    "planned_day": (1280, 900),
    "whose_in_a_large_window": (1280, 720),
    "exam": (1280, 720),
    "battle": (1280, 720),
    "friend": (1280, 720),
    "choices": (1280, 720),
    "player": (1280, 560),
    "phase": (1280, 720),
    "song": (1280, 800),
    "sound": (1280, 1100),
    "there_and_back": (1280, 900),
    "legible": (1280, 720),
    "by_mouse": (1280, 720),
    "by_kit": (1280, 720),
    "finds_draft": (1280, 720),
    "clicks": (1280, 720),
    "words": (1280, 1300),
}
"""Of windows, in pixels; the words' is so high that two dozen fields are seen: the test engine finds no others."""
STUDENTS = {
    "newcomer": NEWCOMER,
    "first_minute": f"{NEWCOMER},seed=2,sd_ms=30,bias_ms=95",
    "drill": "beginner,seed=3",
    "practise": "pro,seed=4",
    "choices": "pro,seed=4",
    "exam": "seed=1,sd_ms=4",
    "exam_in_a_small_window": "seed=1,sd_ms=4",
    "there_and_back": "intermediate,seed=2",
    "highway": "intermediate,seed=2,velocity_sd=30",
}


def main(names: str, sessions: str, out: str, picture: str | None = None) -> None:
    """Play the scenarios `names`, joined by `+`."""
    scenarios = names.split("+")
    every, size = PICTURE_EVERY if picture is None else 1, SIZES.get(scenarios[0], SIZE)
    drive = Drive(Path(sessions), STUDENTS.get(scenarios[0]), every, size)
    try:
        drive.run([SCENARIOS[name] for name in scenarios])
    finally:
        kept = drive.station.close()
    if picture is not None:
        write_png(np.ascontiguousarray(hello_imgui.final_app_window_screenshot()), Path(picture))
    assert kept is None, kept
    Path(out).write_text(json.dumps(dict(zip(scenarios, drive.all_seen, strict=False))))
