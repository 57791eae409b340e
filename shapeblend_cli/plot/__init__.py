"""Pictures of a correspondence, in the form of the paper's figures."""
