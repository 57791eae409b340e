"""A local page in which a blend is corrected by hand: what is seen there is what the command writes."""
