"""Signals read from files: small files written by hand, and every way in which they can be wrong."""

from pathlib import Path

import numpy as np
import pytest

from station.core.errors import BadInput
from station.sync.signals.asf import read_asf
from station.sync.signals.bvh_motion import read_bvh
from station.sync.signals.signal_files import read_signal

ASF = """# made by hand
:version 1.10
:name tiny
:units
  mass 1.0
  length 0.45
  angle deg
:documentation
   two bones
:root
   order TX TY TZ RX RY RZ
   axis XYZ
   position 0 0 0
   orientation 0 0 0
:bonedata
  begin
     id 2
     name foot
     direction 0 0 1
     length 2.0
     axis -90 0 20 XYZ
    dof rx rz
    limits (-45.0 90.0)
           (-70.0 20.0)
  end
  begin
     id 1
     name leg
     direction 0 -1 0
     length 7.5
     axis 0 0 20 XYZ
    dof rx
    limits (-10.0 170.0)
  end
:hierarchy
  begin
    root leg
    leg foot
  end
"""
AMC = """#!OML:ASF by hand
:FULLY-SPECIFIED
:DEGREES
10
root 1 2 3 4 5 6
leg 7
foot 8 -1.5e-015
11
root 1 2 3 4 5 6
foot 9 10
leg 11
"""
BVH = """HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation
  JOINT RightUpLeg
  {
    OFFSET 1.5 -2 0.5
    CHANNELS 3 Zrotation Yrotation Xrotation
    End Site
    {
      OFFSET 0 -7 0
    }
  }
}
MOTION
Frames: 3
Frame Time: .01
1.5 2.5 3.5 0 0 0 -21 0 0
1 2 3 4 5 6 7.5 8 9.5
1 2 3 4 5 6 7.5 8 9.25
"""
CSV = "time_s,left,right\n0,1,2\n0.5,3,4\n"


@pytest.fixture
def amc(tmp_path: Path) -> Path:
    (tmp_path / "07.asf").write_text(ASF)
    path = tmp_path / "07_01.amc"
    path.write_text(AMC)
    return path


def test_amc_in_the_order_of_its_skeleton(amc: Path) -> None:
    signal = read_signal(amc)
    assert signal.names[6:] == ("leg_rx", "foot_rx", "foot_rz")
    assert signal.values[:, 6:].tolist() == [[7, 8, -1.5e-15], [11, 9, 10]]
    assert signal.values[0, :6].tolist() == [1, 2, 3, 4, 5, 6]
    assert signal.time_s.tolist() == [0, 1 / 120]
    assert signal.rate_hz == pytest.approx(120)


def test_asf_bones_come_after_their_parents(amc: Path) -> None:
    skeleton = read_asf(amc.with_name("07.asf"))
    assert list(skeleton.bones) == ["root", "leg", "foot"]
    foot = skeleton.bones["foot"]
    assert (foot.parent, foot.length, foot.axis_deg, foot.freedoms) == ("leg", 2.0, (-90.0, 0.0, 20.0), ("rx", "rz"))
    assert skeleton.length_unit == 0.45


def test_bvh_leaves_its_rest_frame_out_and_names_bones_as_amc_does(tmp_path: Path) -> None:
    path = tmp_path / "09_01.bvh"
    path.write_text(BVH)
    motion = read_bvh(path)
    assert motion.signal.time_s.tolist() == [0, 0.01]
    assert motion.signal.only(["rfemur_rx", "Hips_ty"]).values.tolist() == [[9.5, 2], [9.25, 2]]
    assert [(joint.name, joint.parent, joint.offset) for joint in motion.joints] == [
        ("Hips", None, (0, 0, 0)),
        ("RightUpLeg", "Hips", (1.5, -2, 0.5)),
        ("RightUpLeg End Site", "RightUpLeg", (0, -7, 0)),
    ]


def test_bvh_keeps_a_first_frame_that_is_motion(tmp_path: Path) -> None:
    path = tmp_path / "a.bvh"
    path.write_text(BVH.replace("0 0 0 -21 0 0", "0 0 0 -21.5 0 0"))
    assert len(read_bvh(path).signal) == 3


def test_csv(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text(CSV.replace("time_s,left", " left, time_s "))
    signal = read_signal(path)
    assert signal.names == ("left", "right")
    assert signal.time_s.tolist() == [1, 3]
    assert signal.values.tolist() == [[0, 2], [0.5, 4]]


@pytest.mark.parametrize(
    ("old", "new", "fault"),
    [
        ("time_s", "when", "line 1: expected a column time_s, found when, left, right"),
        ("time_s,left,right", "time_s", "line 1: expected a column for each channel"),
        ("left", "right", "line 1: right is here twice"),
        ("left", "", "line 1: column 2 has no name"),
        ("3,4", "3,nan", "line 3: expected a number at place 3, found"),
        ("3,4", "3,1e300", "line 3: expected a number at place 3, found"),
        ("3,4", "3", "line 3: expected 3 numbers, found 2"),
        ("0.5", "1e-300", "line 3: time_s increases by less than a microsecond: 1e-300 after 0"),
        ("0.5", "5e9", "line 3: time_s is not within 4e.09 s: 5e.09"),
        ("0.5", "0", "line 3: time_s does not increase: 0 after 0"),
        (CSV, "", "line 1: expected a header"),
    ],
)
def test_csv_faults(tmp_path: Path, old: str, new: str, fault: str) -> None:
    path = tmp_path / "a.csv"
    path.write_text(CSV.replace(old, new))
    with pytest.raises(BadInput, match=fault):
        read_signal(path)


@pytest.mark.parametrize(
    ("old", "new", "fault"),
    [
        ("leg 7", "leg 7 8", "line 6: leg: expected 1 numbers, found 2"),
        ("leg 7", "leg x", "line 6: expected a number at place 1"),
        ("leg 7", "arm 7", "line 6: the skeleton has no bone that moves and is called arm"),
        ("leg 7\n", "", "line 4: this frame lacks leg"),
        ("leg 11\n", "", "line 8: this frame lacks leg"),
        ("leg 7", "foot 1 2", "line 7: foot is in this frame twice"),
        ("11\n", "12\n", "line 8: expected frame 11, found 12"),
        ("10\n", "", "line 4: expected the number of a frame, found root"),
        ("10\n", "9" * 5_000 + "\n", "line 4: expected the number of a frame"),
        (":DEGREES", ":RADIANS", "line 3: expected :FULLY-SPECIFIED or :DEGREES, found :RADIANS"),
        (AMC, ":DEGREES", "holds no frame"),
    ],
)
def test_amc_faults(amc: Path, old: str, new: str, fault: str) -> None:
    amc.write_text(AMC.replace(old, new, 1))
    with pytest.raises(BadInput, match=fault):
        read_signal(amc)


@pytest.mark.parametrize(
    ("old", "new", "fault"),
    [
        ("angle deg", "angle rad", "line 7: expected angle deg, found angle rad"),
        ("length 0.45", "length 0", "line 6: expected a length above 0, found 0"),
        (":bonedata", ":bones", "line 15: no such section: :bones"),
        ("name leg", "name foot", "line 26: foot is here twice"),
        ("dof rx rz", "dof rx rx", "line 22: expected some of"),
        ("root leg", "root arm", "line 37: no such bone: arm"),
        ("    leg foot\n", "", ":hierarchy: foot does not hang on the root"),
        ("direction 0 -1 0", "direction 0 -1", "line 29: expected 3 numbers, found 2"),
        ("id 1", "colour 1", "line 27: no such entry of a bone: colour 1"),
    ],
)
def test_asf_faults(amc: Path, old: str, new: str, fault: str) -> None:
    amc.with_name("07.asf").write_text(ASF.replace(old, new, 1))
    with pytest.raises(BadInput, match=fault):
        read_signal(amc)


@pytest.mark.timeout(20)
def test_a_chain_of_very_many_bones_takes_no_quadratic_time(amc: Path) -> None:
    count = 20_000
    bones = "".join(f"begin\nname b{at}\nend\n" for at in range(count))
    chain = "".join(f"b{at} b{at + 1}\n" for at in range(count - 1))
    asf = amc.with_name("07.asf")
    asf.write_text(f":root\norder RX\n:bonedata\n{bones}:hierarchy\nroot b0\n{chain}")
    assert len(read_asf(asf).bones) == count + 1


def test_amc_without_its_skeleton(amc: Path) -> None:
    amc.with_name("07.asf").unlink()
    with pytest.raises(BadInput, match=r"expected its skeleton beside it, such as 07\.asf"):
        read_signal(amc)


@pytest.mark.parametrize(
    ("old", "new", "fault"),
    [
        ("HIERARCHY", "MOTION", "line 1: expected HIERARCHY, found MOTION"),
        ("JOINT RightUpLeg", "BONE RightUpLeg", "line 6: expected JOINT and a name, found BONE"),
        ("RightUpLeg", "Hips", "line 6: Hips is here twice"),
        ("CHANNELS 3 Z", "CHANNELS 2 Z", "line 9: expected the number of channels"),
        ("CHANNELS 3 Zrotation", "CHANNELS 3 Wrotation", "line 9: no such channel: Wrotation"),
        ("OFFSET 1.5", "OFFSET", "line 8: expected 3 numbers, found 2"),
        ("Frames: 3", "Frames: 4", "4 frames announced, 3 found"),
        ("Frames: 3", "Frames: " + "9" * 5_000, "line 17: expected the number of frames"),
        ("Time: .01", "Time: 0", "line 18: expected Frame Time: and seconds from 1e-06 to 100"),
        ("Time: .01", "Time: 1e-300", "line 18: expected Frame Time: and seconds from 1e-06 to 100"),
        ("Time: .01", "Time: 1e9", "line 18: expected Frame Time: and seconds from 1e-06 to 100"),
        ("9.25", "", "line 21: expected 9 numbers, found 8"),
        ("9.5", "inf", "line 20: expected a number at place 9"),
        (BVH[BVH.index("MOTION") :], "", "the end: expected MOTION, found nothing"),
    ],
)
def test_bvh_faults(tmp_path: Path, old: str, new: str, fault: str) -> None:
    path = tmp_path / "a.bvh"
    path.write_text(BVH.replace(old, new, 1))
    with pytest.raises(BadInput, match=fault):
        read_signal(path)


def test_other_endings_and_channels_that_are_not_there(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match=r"expected a name that ends in \.csv, \.amc or \.bvh"):
        read_signal(tmp_path / "a.wav")
    path = tmp_path / "a.csv"
    path.write_text(CSV)
    with pytest.raises(BadInput, match="no such channel: lefft; did you mean left"):
        read_signal(path).only(["lefft"])
    assert np.array_equal(read_signal(path).only(["right", "left"]).values, [[2, 1], [4, 3]])
