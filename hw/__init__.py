"""The hardware layer: interfaces in `ports`, one small driver a device below them."""
