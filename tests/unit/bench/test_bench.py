"""The frame of `station bench`: every benchmark is a row, whatever becomes of it."""

import io
import json
import time

import pytest

from station.bench import rows
from station.bench.harness.benchmark import Benchmark, Measurement, median_s
from station.bench.harness.registry import entries
from station.bench.harness.run import BUDGET_S, Result, document, main, run, write_table
from station.bench.rows.midi_rows import drum_file
from station.music.formats.smf.standard_midi import parse_midi, performance_from_midi
from tests.fakes import benches

FAKES = {entry.benchmark.name: entry for entry in entries(benches)}


def one(name: str, budget_s: float = 60) -> Measurement:
    [result] = run([FAKES[name]], budget_s)
    return result.measured


def test_every_table_of_a_package_is_found_and_helpers_are_not() -> None:
    assert next(iter(FAKES)) == "broken"
    assert FAKES["noisy"].module == "tests.fakes.benches.rows"
    assert "midi_read_100k_notes" in {e.benchmark.name for e in entries(rows)}


def test_names_are_told_apart() -> None:
    names = [e.benchmark.name for e in entries(rows)]
    assert len(set(names)) == len(names)


def test_a_result_comes_through_whatever_the_work_prints() -> None:
    assert one("noisy") == Measurement(12.5, 50.0, "all well")


@pytest.mark.parametrize(
    ("name", "note"),
    [
        ("broken", "cannot be imported: ImportError: no such card"),
        ("no_device", "no sound card"),
        ("fails", "ValueError: two lines"),
        ("leaves", "ended with status 3: I quit"),
        ("crashes", "ended with status -11: the driver gives up"),
        ("not_a_number", "measured nan, peer None: not a number"),
    ],
)
def test_what_goes_wrong_is_a_row_that_says_so(name: str, note: str) -> None:
    assert one(name) == Measurement(None, None, note)


def test_those_of_a_group_share_a_process_and_its_fate() -> None:
    names = ("first_together", "second_together", "alone", "falls_with_it", "falls")
    results = {result.benchmark.name: result.measured for result in run([FAKES[name] for name in names])}
    first, second, alone = (results[name].value for name in names[:3])
    assert first == second != alone
    assert results["falls_with_it"] == results["falls"] == Measurement(None, None, "ended with status 3: I quit")


def test_what_hangs_is_ended_with_all_that_it_started() -> None:
    start = time.monotonic()
    assert one("hangs") == Measurement(None, None, "was ended after 2 s")
    assert time.monotonic() - start < 55, "its child sleeps for a minute and holds the pipes"


def test_what_finds_no_time_left_says_so() -> None:
    assert one("noisy", budget_s=0) == Measurement(None, None, "no time was left of 0 s")


def test_the_long_ones_come_last_and_have_their_own_time() -> None:
    results = list(run([FAKES["long"], FAKES["noisy"]], budget_s=0))
    assert [r.benchmark.name for r in results] == ["noisy", "long"]
    assert [r.measured.value for r in results] == [None, 12.5]


# --- what is printed --------------------------------------------------------------------------------------------------

GOOD = Result(FAKES["noisy"].benchmark, Measurement(12.5, 50.0))
FAILED = Result(FAKES["fails"].benchmark, Measurement(None, note="why"))


def test_the_document_has_the_designs_keys() -> None:
    printed = json.loads(json.dumps(document([GOOD, FAILED])))
    assert printed["schema"] == "drum-station/bench/1"
    assert printed["results"] == [
        {
            "name": "noisy",
            "value": 12.5,
            "unit": "ms",
            "target": 20,
            "better": "lower",
            "peer": "rival",
            "peer_value": 50.0,
        },
        {
            "name": "fails",
            "value": None,
            "unit": "fps",
            "target": 60,
            "better": "higher",
            "peer": None,
            "peer_value": None,
            "note": "why",
        },
    ]


def test_the_table_has_a_line_for_each() -> None:
    out = io.StringIO()
    write_table([GOOD, FAILED], [GOOD.benchmark, FAILED.benchmark], lambda line: out.write(f"{line}\n"))
    header, good, failed = out.getvalue().splitlines()
    assert header.split() == ["benchmark", "value", "target", "peer"]
    assert good.split() == ["noisy", "12.5", "ms", "≤", "20", "ok", "rival", "50"]
    assert failed.split() == ["fails", "–", "≥", "60", "why"]


@pytest.mark.parametrize(
    ("better", "value", "reached"),
    [("lower", 20, True), ("lower", 20.1, False), ("higher", 20, True), ("higher", 19.9, False), ("lower", None, None)],
)
def test_a_target_is_reached_from_its_side(better: str, value: float | None, reached: bool | None) -> None:
    row = Benchmark("x", "s", 20, "lower" if better == "lower" else "higher", None, lambda: Measurement(value))
    assert row.reaches(value) is reached


def test_without_a_target_nothing_is_reached_or_missed() -> None:
    assert Benchmark("x", "s", None, "lower", None, lambda: Measurement(1)).reaches(1) is None


def test_the_whole_run_prints_one_document_with_every_row() -> None:
    out = io.StringIO()
    assert main(benches, out.write, as_json=True, soak=True) == 0
    rows = json.loads(out.getvalue())["results"]
    assert {row["name"] for row in rows} == set(FAKES)
    measured = ["noisy", "first_together", "second_together", "alone", "long"]
    assert [row["name"] for row in rows if row["value"] is not None] == measured
    assert all(row["note"] for row in rows if row["value"] is None)


def test_the_long_ones_run_only_when_they_are_asked_for() -> None:
    out = io.StringIO()
    main(benches, out.write, as_json=True)
    assert {row["name"] for row in json.loads(out.getvalue())["results"]} == set(FAKES) - {"long"}


def test_five_minutes_are_the_promise() -> None:
    assert BUDGET_S <= 300


# --- measuring --------------------------------------------------------------------------------------------------------


def test_the_first_call_is_not_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    """A clock that moves as the work says: 100 s at first, then 1, 5 and 2."""
    now = 0.0
    steps = iter([100.0, 1.0, 5.0, 2.0])

    def work() -> None:
        nonlocal now
        now += next(steps)

    monkeypatch.setattr("station.bench.harness.benchmark.time.perf_counter", lambda: now)
    assert median_s(work, 3) == 2.0


def test_the_file_that_is_timed_is_a_drum_file_of_its_size() -> None:
    midi = parse_midi(drum_file(1000), "groove.mid")
    assert 1000 <= len(performance_from_midi(midi)) <= 1006
    assert midi.oddities == ()
    assert len(midi.tracks[0].controllers) > 500
