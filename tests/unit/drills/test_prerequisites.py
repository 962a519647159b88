"""What should come before what: names that nobody knows, and circles."""

import pytest

from station.drills.prerequisites import OrderFault, order_faults


@pytest.mark.parametrize(
    ("named", "faults"),
    [
        ({"a": [], "b": ["a"], "c": ["a", "b"]}, []),
        ({"b": ["a", "rok-1"]}, [("b", 1, "no such lesson: rok-1; did you mean rock-1?")]),
        ({"a": ["a"]}, [("a", 0, "a circle: a needs a")]),
        ({"b": ["a"], "a": ["b"]}, [("a", 0, "a circle: a needs b needs a")]),
        ({"a": ["c"], "b": ["a"], "c": ["b"]}, [("a", 0, "a circle: a needs c needs b needs a")]),
        ({"a": ["b"], "b": ["c"], "c": ["b"]}, [("b", 0, "a circle: b needs c needs b")]),
        ({"a": ["b", "c"], "b": [], "c": ["a"]}, [("a", 1, "a circle: a needs c needs a")]),
        ({"a": ["b"], "b": ["c", "d"], "c": ["d"], "d": []}, []),
    ],
)
def test_each_fault_is_told_once(named: dict[str, list[str]], faults: list[tuple[str, int, str]]) -> None:
    known = {"a", "b", "c", "d", "rock-1"}
    assert order_faults(named, known, "lesson") == [OrderFault(*fault) for fault in faults]
