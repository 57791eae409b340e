"""How shapes move from one drawing to the next otherwise than on straight vertex paths."""
