"""Cross-sections of rail and wheel, and what a beam needs to know of them."""

from contactstudy.profiles.curve import ProfileCurve
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.profiles.rail import RailProfile, rail_profile
from contactstudy.profiles.section import SectionProperties, polygon_properties, section_properties
from contactstudy.profiles.wheel import WheelProfile, wheel_profile
from contactstudy.profiles.worn import worn_curve

__all__ = [
    "ProfileCurve",
    "RailProfile",
    "SectionProperties",
    "WheelProfile",
    "polygon_properties",
    "rail_curve",
    "rail_profile",
    "section_properties",
    "wheel_curve",
    "wheel_profile",
    "worn_curve",
]
