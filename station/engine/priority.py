"""The engine's place in the queue for the processor: before the window and everything else that can wait.

On a busy desktop a process waits several milliseconds for its turn. Bytes that a kit sends meanwhile are stamped late
where no driver stamps them, and a block of sound is missed. So the engine asks the system for less niceness and, once
its long preparations are over, for a place among the real-time threads. Both are granted only to those whom the system
lets; without them the engine works all the same.
"""

import os
import sys
from contextlib import suppress
from pathlib import Path

NICENESS = -11
"""What desktop sound servers run at."""
REAL_TIME = 5
"""The lowest of what sound programs ask for: JACK gives its clients 5, itself 10 (jackd's manual, option -P)."""


def be_less_nice() -> None:
    """Come before ordinary programs, if we may."""
    if sys.platform != "win32":
        with suppress(OSError):
            os.nice(NICENESS)


def be_real_time() -> None:
    """Have every thread of this process run as soon as it can, and all that they start, if we may (Linux).

    Threads that a sound library has made real-time already keep their place. The kernel leaves others a twentieth of
    the time whatever happens (`sched_rt_runtime_us`).
    """
    if sys.platform != "linux":
        return
    for thread in Path("/proc/self/task").iterdir():
        with suppress(OSError):
            if os.sched_getscheduler(int(thread.name)) == os.SCHED_OTHER:
                os.sched_setscheduler(int(thread.name), os.SCHED_RR, os.sched_param(REAL_TIME))


def real_time_is_granted() -> bool | None:
    """Whether this user's programs may run in real time; None where the system is not asked."""
    if sys.platform != "linux":
        return None
    import resource  # noqa: PLC0415 - not everywhere

    return os.geteuid() == 0 or resource.getrlimit(resource.RLIMIT_RTPRIO)[0] >= REAL_TIME
