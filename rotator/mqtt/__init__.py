"""The box on a broker of messages: its status, and the methods of the page, for Home Assistant and the like."""
