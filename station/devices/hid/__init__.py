"""Game drums and foot switches over HID: Rock Band and Guitar Hero kits for the PS3 and the Wii, PCsensor pedals.

In: reports with the time at which they were read. Out: packets, one a report; and what a report says, as the notes and
switches that the rest of the station knows. The only user of hidapi.
Read `hid_reports` first, then `hid_decoder`.
"""
