"""Version of the program as it is installed."""

from importlib.metadata import PackageNotFoundError, version

try:
    __version__ = version("contactstudy")
except PackageNotFoundError:  # run from a source tree that was never installed
    __version__ = "0+unknown"
