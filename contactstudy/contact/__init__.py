"""Contact of wheel and rail: at a point, over a patch, pressed at rest."""
