"""Irregularities of the running surface: spectra, sample profiles, measurements, estimates.

``r(X) > 0`` raises the running surface; X in m along the rail.
"""

from contactstudy.irregularity.bands import band_deviations
from contactstudy.irregularity.both_rails import both_rails
from contactstudy.irregularity.chosen import Irregularity
from contactstudy.irregularity.defective import DefectiveProfile, RollingDefect, even, with_defects
from contactstudy.irregularity.depth_map import DepthMap
from contactstudy.irregularity.estimate import (
    nominal_centre,
    spectral_estimate,
    third_octave_levels,
)
from contactstudy.irregularity.fade import faded
from contactstudy.irregularity.flats import Flat, RoundedFlat, TreadLines
from contactstudy.irregularity.measured import MeasuredProfile, measured_profile
from contactstudy.irregularity.profile import (
    HarmonicProfile,
    Profile,
    RepeatWarning,
    SmoothRail,
    check_repeat,
)
from contactstudy.irregularity.psd import Convention
from contactstudy.irregularity.rail_defects import Corrugation, DippedJoint, Step, Weld
from contactstudy.irregularity.rails import RailProfiles
from contactstudy.irregularity.sample import sample_profile
from contactstudy.irregularity.spectra import fra, german, paper_spectrum, spectrum, tbt3352
from contactstudy.irregularity.wheel_defects import OutOfRound

__all__ = [
    "Convention",
    "Corrugation",
    "DefectiveProfile",
    "DepthMap",
    "DippedJoint",
    "Flat",
    "HarmonicProfile",
    "Irregularity",
    "MeasuredProfile",
    "OutOfRound",
    "Profile",
    "RailProfiles",
    "RepeatWarning",
    "RollingDefect",
    "RoundedFlat",
    "SmoothRail",
    "Step",
    "TreadLines",
    "Weld",
    "band_deviations",
    "both_rails",
    "check_repeat",
    "even",
    "faded",
    "fra",
    "german",
    "measured_profile",
    "nominal_centre",
    "paper_spectrum",
    "sample_profile",
    "spectral_estimate",
    "spectrum",
    "tbt3352",
    "third_octave_levels",
    "with_defects",
]
