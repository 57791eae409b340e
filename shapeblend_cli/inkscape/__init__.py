"""The extension for Inkscape: its files, and the functions behind them."""
