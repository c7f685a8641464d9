"""One BLAS thread in the benchmarks, as in the program's workers: set before NumPy is loaded."""

import os

from contactstudy.process import ONE_THREAD

os.environ.update(ONE_THREAD)
