"""What hypothesis draws."""

import numpy as np
from hypothesis import strategies as st

seeds = st.integers(0, 10**9)
rngs = st.builds(np.random.default_rng, seeds)
