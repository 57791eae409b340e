"""Runs that are killed, meet each other, or find disks full and streams closed: `make faults`."""
