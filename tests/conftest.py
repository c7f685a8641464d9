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


OF_THE_SITE = ("test_site.py", "test_explorer.py", "test_documentation.py")


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    """With pytest -n 2 the tests of the site go to one worker, which builds it once."""
    from xdist.scheduler import LoadScopeScheduling

    class SiteOnce(LoadScopeScheduling):
        def _split_scope(self, nodeid):
            return "site" if nodeid.partition("::")[0].endswith(OF_THE_SITE) else nodeid

    return SiteOnce(config, log)


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
