"""The named cases, in the order of the verification document."""

from contactstudy.verification.case import Case


def _case(name: str, function: str, slow: bool = False, needs: tuple[str, ...] = ()) -> Case:
    return Case(name, f"{__name__}.{function}", slow, needs)


_CCX = ("program:ccx",)
CASES: tuple[Case, ...] = (
    _case("hertz_line", "hertz_line:line"),
    _case("hertz_sphere", "hertz_ellipses:sphere"),
    _case("hertz_ellipses", "hertz_ellipses:ellipses", slow=True),
    _case("ssnv104", "hertz_ellipses:ssnv104"),
    _case("reduction", "reduction:passage", slow=True),
    _case("reduction_pads", "reduction_pads:passage_on_pads", slow=True),
    _case("subsurface_line", "stress_below:below_line"),
    _case("subsurface_sphere", "stress_below:below_sphere", slow=True),
    _case("subsurface_ellipse", "stress_below:below_ellipses"),
    _case("scanned_profiles", "scanned_profiles:scanned_profiles"),
    _case("tamaas_codes", "tamaas_codes:tamaas_codes", needs=("package:tamaas",)),
    _case("wheel_flat", "wheel_flat:wheel_flat", slow=True),
    _case("p1_p2", "p1_p2:p1_p2"),
    _case("manchester_published", "manchester_case:manchester_published"),
    _case("manchester", "manchester_case:manchester", slow=True),
    _case("s1002_solid", "s1002:solid_press", slow=True),
    _case("patch_filter", "patch_filter:patch_filter", slow=True),
    _case("short_waves", "short_waves:short_waves", slow=True),
    _case("convergence", "surface_convergence:defaults", slow=True),
    _case("convergence_mesh", "surface_convergence:mesh", slow=True),
    _case("convergence_penalty", "surface_convergence:penalty", slow=True),
    _case("convergence_modes", "surface_convergence:interface_modes", slow=True),
    _case("convergence_time_step", "surface_convergence:time_step", slow=True),
    _case("wheel_disc", "wheel_frequencies:disc"),
    _case("wheel_modes", "wheel_frequencies:brute_force", slow=True),
    _case("wheel_statics", "wheel_statics:statics", slow=True),
    _case("calculix_coarse", "calculix_half:press_on_coarse_mesh", needs=_CCX),
    _case("calculix", "calculix_half:press_on_default_mesh", slow=True, needs=_CCX),
    _case("calculix_whole", "calculix_whole:press_with_yaw", slow=True, needs=_CCX),
    _case("pad_stiffness", "pad_stiffness:pad_stiffness", slow=True, needs=_CCX),
    _case("calculix_corner", "calculix_corner:press_on_gauge_corner", slow=True, needs=_CCX),
)
"""To add one: a function in a module of this folder, and a line here."""
