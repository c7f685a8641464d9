"""Contact of wheel and rail: closed forms, laws at a point, and pressure over a meshed patch."""
