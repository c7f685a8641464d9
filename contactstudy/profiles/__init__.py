"""Cross-sections of rail and wheel, and what a beam needs to know of them."""

from contactstudy.profiles.rail import RailProfile, rail_profile
from contactstudy.profiles.section import (
    SectionProperties,
    polygon_properties,
    section_properties,
)
from contactstudy.profiles.wheel import WheelProfile, wheel_profile

__all__ = [
    "RailProfile",
    "SectionProperties",
    "WheelProfile",
    "polygon_properties",
    "rail_profile",
    "section_properties",
    "wheel_profile",
]
