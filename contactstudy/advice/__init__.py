"""Which point scheme suffices for a study, shown on one sample against surface contact."""
