"""Which passes of the followed targets the antenna flies, and when it sets off."""
