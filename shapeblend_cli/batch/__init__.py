"""Many blends: their plan, records and cache, the processes and clusters that make them, and rankings."""
