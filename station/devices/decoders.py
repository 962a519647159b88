"""All the kits that are heard, each with its own decoder, by the device's name: for live bytes and captures alike."""

from station.core.events import DeviceEvent, DeviceFound, DeviceLost
from station.devices.midi_decoder import MidiDecoder
from station.devices.presets import KitPreset, preset_for


class DecoderBank:
    """Decoders by device; a device that nobody announced gets the preset that its name suggests."""

    def __init__(self) -> None:
        self._decoders: dict[str, MidiDecoder] = {}

    def add(self, device: str, preset: KitPreset) -> None:
        """Understand `device` by `preset` from now on; what its decoder knew is forgotten."""
        self._decoders[device] = MidiDecoder(preset, device)

    def preset_of(self, device: str) -> KitPreset:
        """The preset by which `device` is understood."""
        return self._decoder(device).preset

    def feed(self, device: str, data: bytes, at_ns: int) -> list[DeviceEvent]:
        """The events that `data` from `device`, come at `at_ns`, completes."""
        return self._decoder(device).feed(data, at_ns)

    def bequeath(self, device: str) -> bytes:
        """Bytes that tell a later decoder of `device` how the kit stands now; see `MidiDecoder.bequeath`."""
        return self._decoder(device).bequeath()

    def lost(self, device: str, at_ns: int) -> DeviceLost:
        """`device` is gone: half a message and the pedal's position mean nothing any more."""
        self._decoder(device).reset()
        return DeviceLost(at_ns, device)

    def found(self, device: str, at_ns: int) -> DeviceFound:
        """`device` is there, or there again."""
        self._decoder(device).reset()
        return DeviceFound(at_ns, device)

    def _decoder(self, device: str) -> MidiDecoder:
        decoder = self._decoders.get(device)
        if decoder is None:
            decoder = self._decoders[device] = MidiDecoder(preset_for(device), device)
        return decoder
