"""The Arduino that this program replaces: the board, the display library, the sketch, and the station around it."""
