"""JavaScript that plays blends in web pages."""
