"""What the window tells in passing; expected lines are written out by hand."""

from station.app.toasts import SHOWN_NS, Toasts


def test_two_faults_of_one_frame_are_both_told() -> None:
    toasts = Toasts()
    for line in ("the kit is gone", "the engine has ended", "the disk is full"):
        toasts.notify(line)
    toasts.update(0)
    assert toasts.text == "the engine has ended\nthe disk is full"


def test_a_long_path_is_shortened_in_the_middle() -> None:
    toasts = Toasts()
    toasts.notify("kept in /home/ann/.config/drum-station/latency.toml")
    toasts.update(0)
    assert toasts.text == "kept in /home/…/drum-station/latency.toml"


def test_a_line_goes_by_itself_and_the_same_line_may_come_again() -> None:
    toasts = Toasts()
    seen = []
    for now_ns in (0, SHOWN_NS - 1, SHOWN_NS):
        if now_ns == 0:
            toasts.notify("no viewpoint 3 is kept yet")
        toasts.update(now_ns)
        seen.append(bool(toasts.text))
    toasts.notify("no viewpoint 3 is kept yet")
    toasts.update(SHOWN_NS + 1)
    assert [*seen, bool(toasts.text)] == [True, True, False, True]
