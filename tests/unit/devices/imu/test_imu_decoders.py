"""Each protocol against the bytes of its own document, or packed by hand; numbers reckoned beside."""

import math
from collections.abc import Callable
from pathlib import Path

import pytest

from station.core.imu import Quaternion
from station.devices.imu.bno085_rvc import Bno085RvcDecoder
from station.devices.imu.imu_csv import ImuCsvDecoder
from station.devices.imu.imu_reading import Heard, Reading, Told, quaternion_of_angles
from station.devices.imu.witmotion import WitMotionBleDecoder, WitMotionDecoder
from station.devices.imu.x_imu3 import XImu3Decoder
from tests.fakes.imu_speech import (
    Measured,
    csv_line,
    rvc,
    wit_ble,
    wit_ble_reply,
    wit_serial,
    wit_time,
    wit_words,
    x_imu3_ascii,
    x_imu3_binary,
)

G = 9.80665
DEGREE = math.pi / 180


def only(heard: list[Heard]) -> Reading:
    (reading,) = heard
    assert isinstance(reading, Reading)
    return reading


# --- x-IMU3 -----------------------------------------------------------------------------------------------------------


def test_the_documented_x_imu3_bytes_are_one_g_upwards_after_one_second() -> None:
    data = bytes.fromhex("C9 40 42 0F 00 00 00 00 00") + bytes(20) + bytes.fromhex("00 00 80 3F 0A")
    reading = only(XImu3Decoder().feed(data, 7))
    assert reading == Reading(7, (0.0, 0.0, G), (0.0, 0.0, 0.0), None, 1_000_000)


def test_x_imu3_sends_the_gyroscope_before_the_accelerometer() -> None:
    reading = only(XImu3Decoder().feed(b"I,2000000,90.0,-180.0,0.5,0.25,-0.5,1.0\r\n", 0))
    assert reading.rate_rad_s == pytest.approx((math.pi / 2, -math.pi, DEGREE / 2))
    assert reading.acceleration_m_s2 == pytest.approx((G / 4, -G / 2, G))


def test_stuffed_bytes_are_what_they_were() -> None:
    stuffed = x_imu3_binary("I", 0x0ADB0A, [0.0, 0.0, 0.0, 0.0, 0.0, 1.0])
    assert stuffed.count(b"\n") == 1
    assert b"\xdb\xdc\xdb\xdd\xdb\xdc" in stuffed
    assert only(XImu3Decoder().feed(stuffed, 0)).ticks == 0x0ADB0A


def test_an_escape_that_means_nothing_is_damage() -> None:
    decoder = XImu3Decoder()
    assert decoder.feed(b"\xc9\xdb\x00" + bytes(30) + b"\n", 0) == []
    assert (decoder.good_bytes, decoder.bad_bytes) == (0, 34)


@pytest.mark.parametrize("speak", [x_imu3_binary, x_imu3_ascii])
def test_x_imu3_tells_of_itself(speak: Callable[..., bytes]) -> None:
    decoder = XImu3Decoder()
    said = speak("B", 5, [62.5, 3.7, 0.0]) + speak("T", 6, [31.25])
    said += speak("N", 7, text="hello, you") + speak("F", 8, text="no card")
    assert decoder.feed(said, 0) == [
        Told(battery=0.625),
        Told(temperature_c=31.25),
        Told(note="hello, you"),
        Told(note="error: no card"),
    ]
    assert decoder.bad_bytes == 0


def test_an_orientation_of_the_same_instant_goes_with_the_sample() -> None:
    decoder = XImu3Decoder()
    half = math.sqrt(0.5)
    heard = decoder.feed(
        x_imu3_binary("Q", 100, [half, 0.0, 0.0, half])
        + x_imu3_binary("I", 100, [0, 0, 0, 0, 0, 1])
        + x_imu3_binary("I", 200, [0, 0, 0, 0, 0, 1]),
        0,
    )
    turns = [each.orientation for each in heard if isinstance(each, Reading)]
    assert turns[0] == pytest.approx((half, 0, 0, half))
    assert turns[1] is None


def test_json_is_read_over_and_of_several_channels_the_first_is_heard() -> None:
    decoder = XImu3Decoder()
    one, two = (x_imu3_ascii("I", 1, [0, 0, 0, x, 0, 0]) for x in (1.0, 2.0))
    heard = decoder.feed(b'{"ping":{"interface":"USB"}}\r\n' + b"^A" + one + b"^B" + two + b"^A" + one, 0)
    assert [each.acceleration_m_s2[0] for each in heard if isinstance(each, Reading)] == pytest.approx([G, G])
    assert decoder.bad_bytes == 0


@pytest.mark.parametrize(
    "line",
    [
        b"A,1,inf,0,0\n",
        b"A,1,0,nan,0\n",
        b"Q,1,inf,0,0,0\n",
        b"T,1,nan\n",
        b"B,1,nan,4,0\n",
        x_imu3_binary("A", 1, [math.inf, 0, 0]),
    ],
)
def test_what_is_no_number_is_damage_in_every_message(line: bytes) -> None:
    decoder = XImu3Decoder()
    assert decoder.feed(line, 0) == []
    assert decoder.bad_bytes == len(line)


def test_a_clock_of_more_than_64_bits_is_damage() -> None:
    decoder = XImu3Decoder()
    assert decoder.feed(b"I,%d,0,0,0,0,0,1\n" % 2**64, 0) == []
    assert only(decoder.feed(b"I,%d,0,0,0,0,0,1\n" % (2**64 - 1), 0)).ticks == 2**64 - 1


@pytest.mark.parametrize("number", ["nan", "inf", "-inf", "1e30", "x", ""])
def test_a_number_that_nobody_measures_is_damage(number: str) -> None:
    decoder = XImu3Decoder()
    assert decoder.feed(f"I,1,0,0,0,0,0,{number}\n".encode(), 0) == []
    assert decoder.good_bytes == 0


# --- BNO085 -----------------------------------------------------------------------------------------------------------


def test_the_datasheet_s_frame() -> None:
    """BNO08X datasheet: index DE, yaw 0.01°, pitch −1.10°, roll 20.85°, accelerations −371, −20, 977 mg."""
    frame = bytes.fromhex("AA AA DE 01 00 92 FF 25 08 8D FE EC FF D1 03 00 00 00 E7")
    reading = only(Bno085RvcDecoder().feed(frame, 3))
    assert (reading.ticks, reading.rate_rad_s) == (0xDE, None)
    assert reading.acceleration_m_s2 == pytest.approx((-0.371 * G, -0.020 * G, 0.977 * G))
    assert reading.orientation == pytest.approx(quaternion_of_angles(20.85, -1.10, 0.01))


def test_a_frame_behind_its_own_header_is_found() -> None:
    frame = rvc(0xAA, (0.0, 0.0, 1.0))
    decoder = Bno085RvcDecoder()
    assert only(decoder.feed(b"\xaa" + frame, 0)).ticks == 0xAA
    assert decoder.bad_bytes == 1


@pytest.mark.parametrize(
    ("roll", "pitch", "yaw", "turned"),
    [(90.0, 0.0, 0.0, (0, 0, 1)), (0.0, 90.0, 0.0, (0, 1, 0)), (0.0, 0.0, 90.0, (-1, 0, 0))],
)
def test_angles_turn_the_y_axis_as_right_handed_axes_do(
    roll: float, pitch: float, yaw: float, turned: tuple[int, int, int]
) -> None:
    assert _turned(quaternion_of_angles(roll, pitch, yaw), (0.0, 1.0, 0.0)) == pytest.approx(turned, abs=1e-12)


def test_yaw_comes_first_and_roll_last() -> None:
    """Yaw 90° puts x to y; a roll of 90° about that new x then lifts what was z to the new y's opposite: −(−x) = x."""
    assert _turned(quaternion_of_angles(90.0, 0.0, 90.0), (0.0, 0.0, 1.0)) == pytest.approx((1, 0, 0), abs=1e-12)


def _turned(q: Quaternion, v: tuple[float, float, float]) -> tuple[float, float, float]:
    """The vector as the rotation matrix of Shuster's survey (1993, eq. 117, transposed) turns it."""
    w, x, y, z = q
    rows = (
        (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    )
    a, b, c = (sum(m * n for m, n in zip(row, v, strict=True)) for row in rows)
    return a, b, c


# --- CSV --------------------------------------------------------------------------------------------------------------


def test_a_line_of_csv() -> None:
    reading = only(ImuCsvDecoder().feed(b"1500,0.5,-1,2.0,180,0,-90\n", 0))
    assert reading.acceleration_m_s2 == pytest.approx((G / 2, -G, 2 * G))
    assert reading.rate_rad_s == pytest.approx((math.pi, 0, -math.pi / 2))
    assert (reading.ticks, reading.orientation) == (1500, None)


def test_a_checked_line_by_a_sum_of_another_hand() -> None:
    """The exclusive or of `IMU,0,0,0,1,0,0,0` is by hand: a one, three letters, seven commas."""
    letters, digits, commas = ord("I") ^ ord("M") ^ ord("U"), ord("1"), ord(",")
    assert letters ^ digits ^ commas == 0x4C  # noughts come six times and cancel, commas seven times
    decoder = ImuCsvDecoder()
    assert only(decoder.feed(b"$IMU,0,0,0,1,0,0,0*4C\r\n", 0)).acceleration_m_s2 == pytest.approx((0, 0, G))
    assert decoder.feed(b"$IMU,0,0,0,2,0,0,0*4C\n", 0) == []
    assert decoder.feed(b"0,0,0,1,0,0,0\n", 0) == []  # lines are checked here
    assert decoder.bad_bytes == 22 + 14


def test_comments_and_headings_are_no_damage() -> None:
    decoder = ImuCsvDecoder()
    text = b"# made by hand\nt_us,ax,ay,az,gx,gy,gz\n" + csv_line(Measured(1.0, (0, 0, 1), turn=(1, 0, 0, 0)))
    assert only(decoder.feed(text, 0)).orientation == (1, 0, 0, 0)
    assert decoder.bad_bytes == 0


@pytest.mark.parametrize("line", [b"1,2,3", b"1,1,1,1,1,1,1,1", b"x,0,0,1,0,0,0", b"1,0,0,1,0,0,nan", b"1,-,0,1,0,0,0"])
def test_a_line_of_another_make_is_damage(line: bytes) -> None:
    decoder = ImuCsvDecoder()
    assert decoder.feed(line + b"\n", 0) == []
    assert decoder.bad_bytes == len(line) + 1


# --- WitMotion --------------------------------------------------------------------------------------------------------


def test_witmotion_s_units() -> None:
    """16 bits: 16 g, 2000 °/s, 180° at 32768; the second measurement shows where the first ends."""
    decoder = WitMotionDecoder()
    group = (
        wit_words(0x51, 2048, -4096, 32767, 0) + wit_words(0x52, 16384, -32768, 0, 0) + wit_words(0x53, 0, 0, 16384, 0)
    )
    assert decoder.feed(group, 1) == []
    first, second = decoder.feed(group, 2)
    assert isinstance(first, Reading)
    assert first.acceleration_m_s2 == pytest.approx((G, -2 * G, 16 * G), rel=1e-4)
    assert first.rate_rad_s == pytest.approx((1000 * DEGREE, -2000 * DEGREE, 0))
    assert first.orientation == pytest.approx((math.sqrt(0.5), 0, 0, math.sqrt(0.5)))
    assert (first.at_ns, second[0]) == (1, 2)


def test_from_the_second_on_a_measurement_ends_with_its_last_frame() -> None:
    decoder, packet = WitMotionDecoder(), wit_serial(Measured(0, (0, 0, 1)))
    decoder.feed(packet * 2, 0)
    assert decoder.feed(packet[:11], 5) == []
    assert only(decoder.feed(packet[11:], 6)).at_ns == 6


def test_a_measurement_whose_rate_was_damaged_is_lost_whole() -> None:
    decoder = WitMotionDecoder()
    good = wit_serial(Measured(0, (0, 0, 1)), with_time=True)
    damaged = good[:24] + bytes([good[24] ^ 1]) + good[25:]
    heard = decoder.feed(good * 3 + damaged + good * 3, 0)
    assert len(heard) == 6
    assert all(isinstance(each, Reading) and each.rate_rad_s is not None for each in heard)
    assert decoder.bad_bytes == 11


def test_a_setting_without_angular_rates_is_believed() -> None:
    decoder, group = WitMotionDecoder(), wit_words(0x51, 0, 0, 2048, 0)
    decoder.feed(wit_serial(Measured(0, (0, 0, 1))) * 3, 0)
    assert len(decoder.feed(group * 10, 0)) >= 7


def test_witmotion_s_clock_is_in_milliseconds() -> None:
    decoder = WitMotionDecoder()
    times = (59.998, 60.003, 3600.5)
    heard = decoder.feed(b"".join(wit_serial(Measured(t, (0, 0, 1)), with_time=True) for t in times) + wit_time(0), 0)
    ticks = [each.ticks for each in heard if isinstance(each, Reading) and each.ticks is not None]
    assert [later - ticks[0] for later in ticks] == [0, 5, 3_540_502]


def test_a_bluetooth_packet_and_answers() -> None:
    decoder = WitMotionBleDecoder()
    packet = wit_ble(Measured(0, (0.5, 0, -1), (500, 0, 0)), (90.0, 0, 0))
    battery, temperature = wit_ble_reply(0x64, 382), wit_ble_reply(0x40, 2241)
    reading, *told = decoder.feed(packet + battery + temperature, 9)
    assert isinstance(reading, Reading)
    assert reading.acceleration_m_s2 == pytest.approx((G / 2, 0, -G))
    assert reading.rate_rad_s == pytest.approx((500 * DEGREE, 0, 0))
    assert reading.orientation == pytest.approx((math.sqrt(0.5), math.sqrt(0.5), 0, 0))
    assert told == [Told(battery=0.6), Told(temperature_c=22.41)]


def test_the_lines_of_the_manual_are_understood() -> None:
    manual = Path(__file__).parents[4] / "docs" / "sensors.md"
    lines = [line.strip() for line in manual.read_text(encoding="utf-8").splitlines() if "1000000," in line]
    assert len(lines) == 2
    for line in lines:
        reading = only(ImuCsvDecoder().feed(line.encode() + b"\n", 0))
        assert reading.ticks == 1_000_000
        assert reading.acceleration_m_s2 == pytest.approx((0.012 * G, -0.034 * G, 0.998 * G))
