"""Films a screen in a process of its own: `screen_film.py DISPLAY WIDTHxHEIGHT FPS FILE.mp4`, until its input ends."""

import sys
import threading
from fractions import Fraction

import av

_QUALITY = {"preset": "veryfast", "crf": "34", "g": "200"}
"""Our choice: letters can be read, a minute of the window takes two megabytes."""


def film(display: str, size: str, fps: int, path: str, ended: threading.Event) -> None:
    """Write what the screen shows, at the times at which it was seen."""
    width, height = map(int, size.split("x"))
    asked = {"video_size": size, "framerate": str(fps), "draw_mouse": "0"}
    with av.open(display, format="x11grab", options=asked) as screen, av.open(path, "w") as out:
        stream = out.add_stream("libx264", rate=fps, options=_QUALITY)
        stream.width, stream.height, stream.pix_fmt = width, height, "yuv420p"
        stream.codec_context.time_base = Fraction(1, 1000)
        first, last = None, -1
        for frame in screen.decode(video=0):
            at = float(frame.pts * frame.time_base)
            first = at if first is None else first
            pts = round((at - first) * 1000)
            if pts <= last:
                continue
            last = pts
            shown = frame.reformat(format="yuv420p")
            shown.pts, shown.time_base = pts, Fraction(1, 1000)
            shown.pict_type = av.video.frame.PictureType.NONE  # that of a picture from the screen asks for a key frame
            out.mux(stream.encode(shown))
            if ended.is_set():
                break
        out.mux(stream.encode(None))


def main(display: str, size: str, fps: str, path: str) -> None:
    """Film until the input ends."""
    ended = threading.Event()
    threading.Thread(target=lambda: (sys.stdin.read(), ended.set()), daemon=True).start()
    film(display, size, int(fps), path, ended)


if __name__ == "__main__":
    main(*sys.argv[1:])
