"""From a status to text that the operator reads. Pure: a status and the time in, text out."""
