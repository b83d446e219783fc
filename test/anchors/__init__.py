"""Published numbers beside ours: what the literature tests assert and the validation page lists."""
