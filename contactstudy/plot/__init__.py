"""What all figures share: the style, how they are saved, texts and numbers, curves as data."""
