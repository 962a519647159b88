"""A folder deleted with all that is in it, as far as the system lets us; links are deleted, never followed."""

import os
import stat
from pathlib import Path


def delete_tree(folder: Path) -> list[OSError]:
    """Delete `folder`, or the link that is there instead; why each thing that is left could not be."""
    try:
        mode = folder.lstat().st_mode
    except FileNotFoundError:
        return []
    except OSError as fault:
        return [fault]
    return _delete(str(folder), stat.S_ISDIR(mode))


def _delete(path: str, is_folder: bool) -> list[OSError]:
    faults: list[OSError] = []
    try:
        if is_folder:
            with os.scandir(path) as entries:
                inside = [(entry.path, entry.is_dir(follow_symlinks=False)) for entry in entries]
            for each in inside:
                faults += _delete(*each)
            if not faults:
                Path(path).rmdir()
        else:
            Path(path).unlink()
    except FileNotFoundError:
        pass  # somebody was quicker
    except OSError as fault:
        faults.append(fault)
    return faults
