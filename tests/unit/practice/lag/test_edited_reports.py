"""Figures of a lag that somebody edited: no report of ours has them, and no session is lost by them."""

import json
from typing import Any

import pytest

from station.practice.lag.lag_document import runs_in

MEAN = {"moments": 20, "mean_ms": 80.0, "error_ms": 3.0}
BEYOND_A_FLOAT = pytest.param("1" + "0" * 400, id="1 and 400 noughts")


def runs_with(pads: dict[str, Any], **edited: object) -> Any:  # noqa: ANN401 - as a file that anybody may edit says it
    return {"runs": [{"tempo_bpm": 100.0, **MEAN, "pads": pads, **edited}]}


@pytest.mark.parametrize("key", ["tempo_bpm", "moments", "mean_ms", "error_ms"])
@pytest.mark.parametrize("written", ["Infinity", "-Infinity", "NaN", "1e400", BEYOND_A_FLOAT, "1e200", "true", '"20"'])
def test_a_figure_that_no_session_has_is_no_figure(key: str, written: str) -> None:
    """Each is JSON to Python's own reader; 1e200 moments divided by nothing farther on, 1e200 ms squared beyond all."""
    figure = json.loads(written)
    assert len(runs_in(runs_with({"snare": MEAN}), "now")) == 1
    with pytest.raises(ValueError, match="beyond every session"):
        runs_in(runs_with({}, **{key: figure}), "now")
    if key in MEAN:
        with pytest.raises(ValueError, match="beyond every session"):
            runs_in(runs_with({"snare": {**MEAN, key: figure}}), "now")
