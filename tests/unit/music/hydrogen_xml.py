"""Small Hydrogen songs for tests, written as Hydrogen writes them."""

from collections.abc import Iterable, Mapping

NAMES = {0: ("Kick", 36), 1: ("Snare", 38), 2: ("Hat Closed", 42), 3: ("Crash", 49), 4: ("Mystery", 1)}


def note(position: int, instrument: int = 0, **fields: object) -> str:
    said = {"velocity": 0.8, "leadlag": 0, "probability": 1, "note_off": "false"} | fields
    body = "".join(f"<{name}>{value}</{name}>" for name, value in said.items())
    return f"<note><position>{position}</position><instrument>{instrument}</instrument>{body}</note>"


def pattern(name: str, *notes: str, size: int = 192, denominator: int = 4) -> str:
    head = f"<name>{name}</name><size>{size}</size><denominator>{denominator}</denominator>"
    return f"<pattern>{head}<noteList>{''.join(notes)}</noteList></pattern>"


def instrument(number: int, name: str, midi_note: int, more: str = "") -> str:
    return f"<instrument><id>{number}</id><name>{name}</name><midiOutNote>{midi_note}</midiOutNote>{more}</instrument>"


def song(
    patterns: Iterable[str],
    columns: Iterable[Iterable[str]],
    more: str = "",
    instruments: Mapping[int, tuple[str, int]] | str = NAMES,
) -> bytes:
    band = instruments
    if not isinstance(band, str):
        band = "".join(instrument(i, *one) for i, one in band.items())
    groups = "".join(f"<group>{''.join(f'<patternID>{n}</patternID>' for n in names)}</group>" for names in columns)
    return (
        f"<?xml version='1.0' encoding='UTF-8'?>\n<song><version>1.2.0</version><name>A song</name><bpm>100</bpm>{more}"
        f"<instrumentList>{band}</instrumentList>\n<patternList>{''.join(patterns)}</patternList>\n"
        f"<patternSequence>{groups}</patternSequence></song>"
    ).encode()
