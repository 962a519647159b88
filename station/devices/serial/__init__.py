"""Raw MIDI over serial ports: home-built modules, microcontrollers, DIN MIDI on a UART.

In: a port's address. Out: packets with session times, like every transport's. The only user of pyserial.
Read `serial_ports` first.
"""
