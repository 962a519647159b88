"""Writing whole or not at all, on a real disk, a full one, and on what is no file."""

import os
import stat
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

from station.core.disk.files import write_whole
from station.core.errors import DeviceError


def test_a_new_file_holds_the_bytes_and_nothing_else_is_left(tmp_path: Path) -> None:
    write_whole(tmp_path / "new" / "report.json", b"{}")
    assert (tmp_path / "new" / "report.json").read_bytes() == b"{}"
    assert [p.name for p in (tmp_path / "new").iterdir()] == ["report.json"]


def test_an_old_file_is_replaced(tmp_path: Path) -> None:
    path = tmp_path / "report.json"
    path.write_bytes(b"a much longer old report")
    write_whole(path, b"new")
    assert path.read_bytes() == b"new"


@pytest.mark.skipif(os.name != "posix", reason="file modes are POSIX's")
def test_a_new_file_has_the_mode_of_any_other_new_file(tmp_path: Path) -> None:
    (tmp_path / "ordinary").touch()
    write_whole(tmp_path / "ours", b"")
    assert (tmp_path / "ours").stat().st_mode == (tmp_path / "ordinary").stat().st_mode


@pytest.mark.skipif(os.name != "posix", reason="file modes are POSIX's")
def test_an_old_file_keeps_its_mode(tmp_path: Path) -> None:
    path = tmp_path / "shared"
    path.touch()
    path.chmod(0o664)
    write_whole(path, b"new")
    assert stat.S_IMODE(path.stat().st_mode) == 0o664


def test_a_link_is_followed_and_stays_a_link(tmp_path: Path) -> None:
    (tmp_path / "target").write_bytes(b"old")
    (tmp_path / "link").symlink_to(tmp_path / "target")
    write_whole(tmp_path / "link", b"new")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "target").read_bytes() == b"new"


def test_a_very_long_name_that_the_disk_allows_is_written(tmp_path: Path) -> None:
    path = tmp_path / ("n" * 250)
    write_whole(path, b"x")
    assert path.read_bytes() == b"x"


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")
def test_a_device_is_written_to_and_not_replaced(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    try:
        write_whole(pipe, b"through")
        assert os.read(reader, 100) == b"through"
    finally:
        os.close(reader)
    assert stat.S_ISFIFO(pipe.stat().st_mode)


def full_device(tmp_path: Path) -> Path:
    """A device that is always full: root gets one of its own, others cannot harm the system's by a fault of ours."""
    if hasattr(os, "geteuid") and os.geteuid() == 0:
        path = tmp_path / "full"
        try:
            os.mknod(path, stat.S_IFCHR | 0o666, os.makedev(1, 7))
            path.open("wb").close()
        except OSError as fault:
            pytest.skip(f"no device can be made here: {fault}")
        return path
    if not Path("/dev/full").exists():
        pytest.skip("no /dev/full here")
    return Path("/dev/full")


def test_a_full_device_is_one_clear_line(tmp_path: Path) -> None:
    path = full_device(tmp_path)
    with pytest.raises(DeviceError) as raised:
        write_whole(path, b"x")
    assert str(raised.value) == f"{path}: cannot be written: No space left on device"
    assert stat.S_ISCHR(path.stat().st_mode)


def test_a_folder_in_the_way_is_one_clear_line(tmp_path: Path) -> None:
    (tmp_path / "folder").mkdir()
    with pytest.raises(DeviceError, match="folder: cannot be written"):
        write_whole(tmp_path / "folder", b"x")
    assert [p.name for p in tmp_path.iterdir()] == ["folder"]


def test_a_file_in_place_of_a_folder_is_one_clear_line(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(DeviceError, match="cannot be written"):
        write_whole(tmp_path / "file" / "report.json", b"x")


@pytest.mark.skipif(os.name != "posix", reason="no limit of file sizes here")
def test_a_disk_that_fills_up_leaves_the_old_file_whole(tmp_path: Path) -> None:
    """A child process may write 4 KiB a file, as if the disk filled up in the middle of writing."""
    path = tmp_path / "report.json"
    path.write_bytes(b"old")
    script = textwrap.dedent(
        """
        import resource, signal, sys
        from pathlib import Path
        from station.core.errors import DeviceError
        from station.core.disk.files import write_whole
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
        try:
            write_whole(Path(sys.argv[1]), b"n" * 100_000)
        except DeviceError as fault:
            print(fault)
        """
    )
    child = subprocess.run([sys.executable, "-c", script, str(path)], capture_output=True, text=True, check=True)
    assert child.stdout == f"{path}: cannot be written: File too large\n"
    assert path.read_bytes() == b"old"
    assert [p.name for p in tmp_path.iterdir()] == ["report.json"]


def test_a_link_that_leads_back_to_itself_cannot_be_written(tmp_path: Path) -> None:
    link = tmp_path / "loop.mid"
    link.symlink_to(link)
    with pytest.raises(DeviceError, match="symbolic link"):
        write_whole(link, b"")
