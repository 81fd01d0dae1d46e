"""Status to something a person can read. Pure: a status and the time in, text out."""
