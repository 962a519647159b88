"""What lies about its time, in words: a mean with its side, a spread, and the interval of each."""

from station.render.report.page.session_page import Interval, TimingFigures


def side(ms: float, spec: str = ".1f") -> str:
    """A time with its side: "6.3 ms early"."""
    text = f"{abs(ms):{spec}}"
    return "0 ms" if not float(text) else f"{text} ms {'early' if ms < 0 else 'late'}"


def interval_words(ci: Interval | None) -> str:
    """The interval of a mean, its sides said; what is said where the data bear none."""
    if ci is None:
        return "too few strokes for an interval"
    return f"95 %: {side(ci[0])} to {side(ci[1])}"


def mean_words(timing: TimingFigures) -> str:
    """The mean and its interval."""
    if timing.mean_ms is None:
        return "nothing to measure"
    return f"{side(timing.mean_ms)} on average ({interval_words(timing.mean_ci)})"


def spread_words(timing: TimingFigures) -> str:
    """The spread and its interval; empty where there is none."""
    if timing.sd_ms is None:
        return ""
    ci = timing.sd_ci
    bears = f" (95 %: {ci[0]:.1f} to {ci[1]:.1f} ms)" if ci is not None else f" ({_UNTOLD})"
    return f"spread (SD) {timing.sd_ms:.1f} ms{bears}"


_UNTOLD = "its interval cannot be told: too few strokes, or they hang together"


def mean_figures(timing: TimingFigures) -> str:
    """The mean and its interval in a table of ms, negative is early."""
    return "" if timing.mean_ms is None else signed(timing.mean_ms, ".1f") + _ends(timing.mean_ci, "+.1f")


def spread_figures(timing: TimingFigures) -> str:
    """The spread and its interval in a table of ms."""
    return "" if timing.sd_ms is None else f"{timing.sd_ms:.1f}" + _ends(timing.sd_ci, ".1f")


def signed(value: float, spec: str = ".0f") -> str:
    """A number with its sign, none before what rounds to nothing."""
    text = f"{value:+{spec}}"
    return text[1:] if not float(text) else text.replace("-", _MINUS)


def _ends(ci: Interval | None, spec: str) -> str:
    if ci is None:
        return ""
    low, high = (f"{end:{spec}}".replace("-", _MINUS) for end in ci)
    return f" ({low} to {high})"


_MINUS = "\N{MINUS SIGN}"


def timing_words(timing: TimingFigures, has_own_clock: bool = False) -> str:
    """Mean and spread with their intervals."""
    mean = "about your own tempo, so that early and late cannot be told" if has_own_clock else mean_words(timing)
    spread = spread_words(timing)
    return f"{mean}; {spread}" if spread else mean
