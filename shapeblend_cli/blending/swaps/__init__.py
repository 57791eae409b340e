"""One drawing takes the place of another one with which it has too little in common: when, and how."""
