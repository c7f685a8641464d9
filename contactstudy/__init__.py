"""Comparative verification of wheel-rail contact models: point contact against surface contact.

The names that a notebook needs, listed in ``__init__.pyi``; each is imported when first used.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
