"""Parts without a partner: when they come and go, and which of them fade."""
