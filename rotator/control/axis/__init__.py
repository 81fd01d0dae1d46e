"""One axis: its goal, its motor, its sensor and the watches over them."""
