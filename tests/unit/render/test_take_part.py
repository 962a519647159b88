"""The fragment of HTML by a parser of its own: what it carries, and that nothing said in it becomes HTML or script."""

import base64
import json
from html.parser import HTMLParser
from importlib.resources import files

import pytest

from station.render.report.take.shown_take import ShownPass, ShownStroke, ShownTake, ShownView
from station.render.report.take.take_part import script_json, take_part

HOSTILE = "</script><script>alert(1)</script><!--\u2028\u2029&amp;\"'"
TAKE = ShownTake(
    model=b"glTF and more",
    sound=bytes(range(256)),
    length_s=12.34567,
    passes=(ShownPass(((1.0, 0.0), (2.0, 960.0)), ((0, 1.00012, "match"), (1, 1.5, "early"))),),
    strokes=(ShownStroke(1.00012, HOSTILE, 99, "match"),),
    views=(
        ShownView(HOSTILE, (0.0, 1.0, 2.0), (0.0, 0.5, 0.0), 40.0, 1.5),
        ShownView("Top", (0, 3, 0), (0, 0, 0), 40.0, 1.5),
    ),
    remark=HOSTILE,
)


class Fragment(HTMLParser):
    """Every element with its attributes, and the text in it."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.found: list[tuple[str, dict[str, str | None], list[str]]] = []
        self.feed(html)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found.append((tag, dict(attrs), []))

    def handle_data(self, data: str) -> None:
        if self.found:
            self.found[-1][2].append(data)

    def one(self, tag: str, **attributes: str) -> tuple[dict[str, str | None], str]:
        """The only such element: its attributes and its text."""
        ((has, text),) = [
            (a, "".join(text)) for t, a, text in self.found if t == tag and attributes.items() <= a.items()
        ]
        return has, text


@pytest.fixture(scope="module")
def fragment() -> Fragment:
    return Fragment(take_part(TAKE))


def test_it_carries_the_sound_the_model_and_the_times(fragment: Fragment) -> None:
    kind, _, sound = str(fragment.one("audio")[0]["src"]).partition(",")
    assert kind == 'data:audio/ogg; codecs="opus";base64'
    assert base64.b64decode(sound) == TAKE.sound
    assert base64.b64decode(fragment.one("script", **{"class": "take-model"})[1]) == TAKE.model
    times = json.loads(fragment.one("script", **{"class": "take-times"})[1])
    assert times["length_s"] == 12.3457
    assert times["passes"] == [{"ticks": [[1.0, 0], [2.0, 960]], "notes": [[0, 1.0001, "match"], [1, 1.5, "early"]]}]
    assert times["strokes"] == [[1.0001, HOSTILE, 99, "match"]]
    assert times["views"][1] == {"name": "Top", "eye": [0, 3, 0], "target": [0, 0, 0], "fov": 40.0, "narrow": 1.5}


def test_what_is_said_stays_text(fragment: Fragment) -> None:
    assert [tag for tag, _, _ in fragment.found].count("script") == 4
    buttons = ["".join(text) for tag, _, text in fragment.found if tag == "button"]
    assert HOSTILE in buttons[0]
    assert fragment.one("p", **{"class": "take-remark"})[1].strip().endswith(HOSTILE)


def test_nothing_is_asked_of_a_network(fragment: Fragment) -> None:
    for _, attributes, _ in fragment.found:
        for name in ("src", "href", "srcset", "action", "poster"):
            assert str(attributes.get(name) or "data:").startswith("data:")


def test_it_can_be_used_without_a_mouse_and_without_eyes(fragment: Fragment) -> None:
    assert fragment.one("audio")[0]["aria-label"]
    assert fragment.one("canvas")[0]["aria-label"]
    assert fragment.one("canvas")[0]["tabindex"] == "0"
    assert {a["aria-pressed"] for tag, a, _ in fragment.found if tag == "button"} == {"true", "false"}


def test_json_in_a_script_ends_neither_it_nor_a_line() -> None:
    text = script_json({"it": HOSTILE})
    assert not set("<>&\u2028\u2029") & set(text)
    assert json.loads(text) == {"it": HOSTILE}


@pytest.mark.parametrize("name", ["three.js", "take.js", "take.css"])
def test_our_files_end_no_element(name: str) -> None:
    text = (files("station.render.report.take") / "viewer" / name).read_text(encoding="utf-8").lower()
    for end in ("</script", "<script", "</style", "<!--"):
        assert end not in text


def test_the_library_is_small_and_its_licence_is_beside_it() -> None:
    viewer = files("station.render.report.take") / "viewer"
    assert len((viewer / "three.js").read_bytes()) <= 800_000
    assert "Permission is hereby granted, free of charge" in (viewer / "three.LICENSE").read_text(encoding="utf-8")
    assert (viewer / "three.js").read_text(encoding="utf-8").startswith("// three.js 0.187.0, MIT")
