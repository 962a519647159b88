"""Motion sensors (IMUs) on the sticks: their bytes become samples in SI units, each with the time it was measured at.

In: chunks of bytes with the session time at which they came. Out: `SensorMounted`, `SensorSamples` and `SensorStatus`.
A decoder a protocol (`witmotion`, `x_imu3`, `bno085_rvc`, `imu_csv`), each pure over bytes; `detect_protocol` tells from
the bytes which of them it is; `sample_clock` finds each sample's time; `imu_sensor` puts them together.
Read `imu_reading`, then `imu_sensor`.
"""
