"""Many blends in one run: which they are, which of them are to be done, and the processes that do them."""
