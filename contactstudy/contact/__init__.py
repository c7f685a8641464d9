"""Contact: closed forms (hertz), a spring at a point (point), pressure over a patch (surface)."""
