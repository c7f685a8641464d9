"""The results of a study with axes, from what was measured of its variants."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from contactstudy.study.axes.dataset import design_dataset
from contactstudy.study.axes.kept import kept_histories
from contactstudy.study.axes.refinement import with_convergence
from contactstudy.study.axes.swept import Swept, finest_points
from contactstudy.study.plan import Piece, Plan, Planned, made_results, refined_key
from contactstudy.study.results import StudyResults

if TYPE_CHECKING:
    from contactstudy.study.compute import Found


def collect_swept(plan: Plan, found: Found) -> StudyResults:
    """Results of a plan with axes: a group a design, no runs."""
    study = plan.study
    assert isinstance(study, Swept)
    measured = {
        name: found.measured[v.key].value
        for name, v in plan.variants.items()
        if v.key in found.measured
    }
    finest = dict(finest_points(study)) if plan.kind.refining else {}
    failures = {name: text for name, v in plan.variants.items() if (text := _failure(v, found))}
    missing = {**failures, **plan.left_out}
    groups = {}
    for design in study.designs:
        names = {index: name for (d, index), name, _ in study.named_points() if d is design}
        of_design = measured
        if design.refined and finest:
            of_design = {n: m | _against(plan, found, n, finest[n]) for n, m in measured.items()}
        groups[design.name] = design_dataset(design, names, of_design, missing)
        if design.refined:
            groups[design.name] = with_convergence(groups[design.name], plan.kind)
        if study.keep:
            groups[design.name] = kept_histories(plan, groups[design.name], names, study.keep)
    return made_results(plan, runs={}, metrics=_metrics(plan, found, failures), groups=groups)


def _against(plan: Plan, found: Found, name: str, finest: str) -> dict[str, Any]:
    """What was measured of a variant against the finest one, nothing where one failed."""
    if finest in plan.left_out:
        return {}
    key = refined_key(plan.kind, plan.variants[name], plan.variants[finest])
    kept = found.measured.get(key)
    return dict(kept.value) if kept is not None else {}


def _failure(variant: Planned, found: Found) -> str:
    reasons = [found.failures[p] for p in variant.pieces.values() if p in found.failures]
    reasons += [found.unmeasured[variant.key]] if variant.key in found.unmeasured else []
    return "; ".join(dict.fromkeys(reasons))


def _metrics(plan: Plan, found: Found, failures: Mapping[str, str]) -> dict[str, Any]:
    """Content of ``metrics.json``.

    ::

        variants.<name>:  title, failure where it failed, seconds of each run (set-up and steps;
                          those of a batch are its mean; equal runs of several variants are one)
        left_out.<reason>: how many points of the designs mean nothing and are left out
        reference:        as of a study without axes
    """
    variants = {}
    for name, v in plan.variants.items():
        seconds = {n: _seconds(p, found) for n, p in v.pieces.items() if p not in found.failures}
        failed = {"failure": failures[name]} if name in failures else {}
        variants[name] = {"title": v.title, **failed, "seconds": seconds}
    left_out = dict(Counter(plan.left_out.values()))
    told = {"variants": variants} | ({"left_out": left_out} if left_out else {})
    return {
        "runs": {},
        "variants": variants,
        **told,
        "reference": plan.study.reference,
        "comparisons": {},
    }


def _seconds(piece: Piece, found: Found) -> float:
    return float(sum(found.pieces[piece].about["seconds"].values()))
