"""Serial ports: raw MIDI of home-built modules, microcontrollers and DIN MIDI on a UART, and motion sensors.

In: a port's address. Out: packets with session times, like every transport's. The only user of pyserial.
Read `serial_ports` first.
"""
