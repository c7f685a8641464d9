"""What of a study may be wrong, and what must be once its profiles are known."""

from __future__ import annotations

from contactstudy.exceptions import InputError
from contactstudy.study.kinds.passage import contact
from contactstudy.study.kinds.passage.on_bridge import vehicle_on
from contactstudy.study.kinds.passage.relations import Finding, Related, meshed_patch
from contactstudy.study.kinds.passage.runs import PointRun, SurfaceRun
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.validation import multiple, raise_if
from contactstudy.validation.base import Parameters


def remarks(study: Study) -> tuple[str, ...]:
    """Warnings of unusual values, and of what tables are to each other.

    Raises
    ------
    InputError
        If the mesh cannot hold the patch.
    """
    if not study.runs:
        return ()
    tables = [study.track, study.vehicle, study.journey, study.irregularity, *study.runs.values()]
    unusual = [text for t in tables if isinstance(t, Parameters) for text in t.unusual()]
    try:
        hertz = contact.hertz(study)
    except InputError:  # conformal profiles have none
        hertz = None
    stiffness, patch = dict[str, float](), list[Finding]()
    for name, run in study.runs.items():
        if hertz is not None and isinstance(run, PointRun):
            named = isinstance(run.k_r, str) and run.k_r != "rigid"
            factor = multiple(str(run.k_r))[0] if run.law == "linear" and named else 1.0
            if run.law != "linear" or named:
                # that of the press is near it
                stiffness[name] = factor * hertz.tangent_stiffness
    meshed = any(isinstance(r, SurfaceRun) or study.presses(n) for n, r in study.runs.items())
    if hertz is not None and meshed:
        solid = study.solid
        axes = hertz.semi_axis_x, hertz.semi_axis_y
        zone = solid.contact_half_length, solid.contact_half_width
        patch = meshed_patch(axes, zone, solid.mesh_size, solid.half)
    vehicle, radius = vehicle_on(study.track, study.vehicle), study.vehicle.wheel_radius
    related = Related(
        study.journey, study.track, vehicle, radius, study.irregularity, study.runs, stiffness
    )
    found = related.findings() + patch
    raise_if(finding.text for finding in found if finding.wrong)
    return (*unusual, *(finding.text for finding in found))
