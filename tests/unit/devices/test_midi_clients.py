"""What of the MIDI ports needs no driver; all else is in the contract of the transports."""

from station.devices.midi.midi_clients import numbered


def test_two_devices_of_one_name_are_told_apart() -> None:
    """As CoreMIDI lists two alike modules; the first keeps the name that its kit was taught under."""
    assert numbered(["USB MIDI", "TD-17", "USB MIDI", "USB MIDI"]) == [
        "USB MIDI",
        "TD-17",
        "USB MIDI (2)",
        "USB MIDI (3)",
    ]
    assert numbered(["a (2)", "a", "a"]) == ["a (2)", "a", "a (3)"]
    assert numbered([]) == []
