"""Files written all or nothing, signals, processes, time, and memory of earlier runs."""
