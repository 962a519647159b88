"""Sound files, kits and archives made by hand, byte for byte, for readers that must not trust them."""

import io
import tarfile
import wave
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

RATE_HZ = 48_000


def wav(samples: NDArray[np.float64], rate_hz: int = RATE_HZ) -> bytes:
    """16-bit WAV of (n,) or (n, channels) within ±1, written by the standard library."""
    table = np.atleast_2d(samples.T).T
    out = io.BytesIO()
    with wave.open(out, "wb") as file:
        file.setnchannels(table.shape[1])
        file.setsampwidth(2)
        file.setframerate(rate_hz)
        file.writeframes(np.round(table * 32767).astype("<i2").tobytes())
    return out.getvalue()


def stroke(level: float = 0.5, length_s: float = 0.4, before_s: float = 0.0, freq_hz: float = 440.0) -> bytes:
    """A decaying cosine after some silence: it starts at its peak."""
    time_s = np.arange(round(length_s * RATE_HZ)) / RATE_HZ
    sound = level * np.cos(2 * np.pi * freq_hz * time_s) * np.exp(-time_s / 0.1)
    return wav(np.concatenate([np.zeros(round(before_s * RATE_HZ)), sound]))


def steady(level: float, length_s: float = 0.5) -> bytes:
    """A constant, so that gains can be read off."""
    return wav(np.full(round(length_s * RATE_HZ), level))


def tar(files: Mapping[str, bytes], *, mode: str = "w:gz", extra: Sequence[tarfile.TarInfo] = ()) -> bytes:
    """An archive of `files`, and of members without content such as links."""
    out = io.BytesIO()
    with tarfile.open(fileobj=out, mode=mode) as archive:  # type: ignore[call-overload]
        for name, data in files.items():
            member = tarfile.TarInfo(name)
            member.size = len(data)
            archive.addfile(member, io.BytesIO(data))
        for member in extra:
            archive.addfile(member)
    return out.getvalue()


NAMESPACE = ' xmlns="http://www.hydrogen-music.org/drumkit"'


def kit_xml(*instruments: str, namespace: str = NAMESPACE, name: str = "Tiny") -> bytes:
    """A `drumkit.xml` of these instruments."""
    inside = "".join(instruments)
    return (
        f'<?xml version="1.0"?><drumkit_info{namespace}><name>{name}</name>'
        f"<instrumentList>{inside}</instrumentList></drumkit_info>"
    ).encode()


def instrument(name: str, body: str = "", layers: str = "", *, component: bool = True, algorithm: str = "") -> str:
    """One instrument: its layers in a component, or directly in it as old kits have them."""
    chosen = f"<sampleSelectionAlgo>{algorithm}</sampleSelectionAlgo>" if algorithm else ""
    inside = f"<instrumentComponent><gain>1</gain>{chosen}{layers}</instrumentComponent>" if component else layers
    return f"<instrument><name>{name}</name>{body}{inside}</instrument>"


def layer(filename: str, low: float = 0.0, high: float = 1.0, gain: float = 1.0, pitch: float = 0.0) -> str:
    return (
        f"<layer><filename>{filename}</filename><min>{low}</min><max>{high}</max>"
        f"<gain>{gain}</gain><pitch>{pitch}</pitch></layer>"
    )
