"""Contact of wheel and rail.

Closed forms (hertz), laws at a point (laws, point), pressure over a patch (points, search, surface,
residual, coupling), static press (press), first touch of two bodies (touch).
"""
