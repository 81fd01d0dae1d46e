"""What switches the motors off when the program hangs or dies: guard, sentinel, heartbeat."""
