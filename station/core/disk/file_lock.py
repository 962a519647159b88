"""A lock on an open file that ends with whoever holds it: a program that is killed holds none."""

import os
import sys
from pathlib import Path

if sys.platform == "win32":
    import msvcrt

    _FAR = 2**62
    """A byte that no file has: Windows keeps others from reading what is locked (its documentation of `LockFile`)."""

    def lock(descriptor: int) -> bool:
        """Lock the open file for this program until it is closed; False where another one holds it."""
        place = os.lseek(descriptor, 0, os.SEEK_CUR)
        try:
            os.lseek(descriptor, _FAR, os.SEEK_SET)
            msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
        except OSError:
            return False
        finally:
            os.lseek(descriptor, place, os.SEEK_SET)
        return True

else:
    import fcntl

    def lock(descriptor: int) -> bool:
        """Lock the open file for this program until it is closed; False where another one holds it."""
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            return False
        return True


def is_locked(path: Path) -> bool:
    """Whether somebody holds a lock on that file right now; nobody where it cannot be opened."""
    try:
        descriptor = os.open(path, os.O_RDWR)
    except (OSError, ValueError):
        return False
    try:
        return not lock(descriptor)
    finally:
        os.close(descriptor)
