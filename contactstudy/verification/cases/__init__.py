"""The named cases, in the order of the verification document."""

from contactstudy.verification.case import Case


def _case(name: str, function: str, slow: bool = False, needs: tuple[str, ...] = ()) -> Case:
    return Case(name, f"{__name__}.{function}", slow, needs)


CASES: tuple[Case, ...] = (
    _case("hertz_line", "hertz_line:line"),
    _case("hertz_sphere", "hertz:sphere"),
    _case("hertz_ellipses", "hertz:ellipses", slow=True),
    _case("ssnv104", "hertz:ssnv104"),
    _case("reduction", "reduction:passage", slow=True),
    _case("subsurface_line", "subsurface:line_case"),
    _case("subsurface_sphere", "subsurface:sphere_case", slow=True),
    _case("subsurface_ellipse", "subsurface:ellipse_case"),
    _case("scanned_profiles", "scans:scanned_profiles"),
    _case("tamaas_codes", "halfspace_codes:tamaas_codes", needs=("package:tamaas",)),
    _case("manchester_published", "manchester_case:manchester_published"),
    _case("manchester", "manchester_case:manchester", slow=True),
    _case("s1002_solid", "s1002:solid_press", slow=True),
    _case("patch_filter", "patch_filter:patch_filter", slow=True),
    _case("convergence", "convergence:summary", slow=True),
    _case("convergence_mesh", "convergence:mesh", slow=True),
    _case("convergence_penalty", "convergence:penalty", slow=True),
    _case("convergence_modes", "convergence:modes", slow=True),
    _case("convergence_time_step", "convergence:time_step", slow=True),
    _case("wheel_disc", "wheel:disc"),
    _case("wheel_modes", "wheel:brute_force", slow=True),
    _case("wheel_statics", "wheel_statics:statics", slow=True),
    _case("calculix_coarse", "calculix:press_on_coarse_mesh", needs=("program:ccx",)),
    _case("calculix", "calculix:press_on_default_mesh", slow=True, needs=("program:ccx",)),
    _case(
        "calculix_whole",
        "calculix_whole:press_with_yaw",
        slow=True,
        needs=("program:ccx",),
    ),
    _case(
        "calculix_corner",
        "calculix_whole:press_on_gauge_corner",
        slow=True,
        needs=("program:ccx",),
    ),
)
"""To add one: a function in a module of this folder, and a line here."""
