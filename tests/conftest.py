"""What holds for all tests: one BLAS thread, and the same hypothesis examples in every run."""

import os

import pytest
from browser import chromium
from hypothesis import settings

from contactstudy.process import ONE_THREAD

# as in the program's workers; before NumPy is loaded
os.environ.update(ONE_THREAD)

# times of a shared machine are no property of the code, so there is no deadline
settings.register_profile("repeatable", derandomize=True, deadline=None)
settings.register_profile("random", derandomize=False, deadline=None, print_blob=True)
settings.load_profile("repeatable")  # pytest --hypothesis-profile loads another one after this


def pytest_configure(config):
    """With pytest -n 2 the tests marked as one xdist_group go to one worker."""
    if getattr(config.option, "dist", "no") == "load":
        config.option.dist = "loadgroup"


@pytest.fixture(scope="session")
def site(tmp_path_factory):
    """Folder of the built site, see `built_site.py`."""
    pytest.importorskip("sphinx")
    from built_site import build

    return build(tmp_path_factory.mktemp("site"))


@pytest.fixture(scope="session")
def session_browser():
    with chromium() as made:
        yield made


@pytest.fixture
def browser(session_browser):
    """A headless Chromium, see `browser.py`; light, and of a desktop's size."""
    session_browser.show()
    return session_browser
