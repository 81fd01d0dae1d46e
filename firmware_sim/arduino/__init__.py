"""The Arduino that the product replaces: the board, the display library, the sketch, the station around it."""
