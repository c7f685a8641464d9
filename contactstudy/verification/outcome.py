"""What became of a case, as data that is kept on disk."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Literal

from contactstudy.files import write_file
from contactstudy.plot.curves import Curve, Plot
from contactstudy.verification.check import CaseResult, Check, ResultTable

JSON_FILE = "verification.json"
CaseStatus = Literal["passed", "failed", "broke down", "not run"]


@dataclass(frozen=True)
class CaseOutcome:
    """What became of one case.

    Attributes
    ----------
    name : str
    status : {"passed", "failed", "broke down", "not run"}
        "failed": a check leaves its band.
    reason : str
        Why a case broke down or was not run.
    result : CaseResult or None
        None when there is none.
    """

    name: str
    status: CaseStatus
    reason: str = ""
    result: CaseResult | None = None

    @property
    def good(self) -> bool:
        """Nothing is wrong, as far as it was run."""
        return self.status in ("passed", "not run")


def judged(result: CaseResult) -> CaseOutcome:
    """CaseOutcome of a case that was computed."""
    return CaseOutcome(result.name, "failed" if result.failed else "passed", result=result)


def to_data(result: CaseResult) -> dict[str, Any]:
    """Plain data for JSON; what is not finite becomes None."""
    data: dict[str, Any] = _clean(asdict(result))
    for check, entry in zip(result.checks, data["checks"], strict=True):
        entry |= {"error": _clean(check.error), "passed": check.passed}
    return data


def from_data(data: dict[str, Any]) -> CaseResult:
    """Inverse of `to_data`."""
    checks = tuple(
        Check(**{k: _number(k, v) for k, v in entry.items() if k not in ("error", "passed")})
        for entry in data["checks"]
    )
    tables = tuple(
        ResultTable(t["caption"], tuple(t["header"]), tuple(tuple(row) for row in t["rows"]))
        for t in data["tables"]
    )
    figures = tuple(
        Plot(**(p | {"curves": tuple(_curve(c) for c in p["curves"])})) for p in data["figures"]
    )
    return CaseResult(data["name"], data["title"], data["method"], checks, tables, figures)


def write_json(outcomes: Sequence[CaseOutcome], about: dict[str, Any], out_dir: Path) -> Path:
    """Write all numbers and the provenance into out_dir/verification.json."""
    cases = [
        {"name": o.name, "status": o.status, "reason": o.reason}
        | ({} if o.result is None else to_data(o.result))
        for o in outcomes
    ]
    path = out_dir / JSON_FILE
    text = json.dumps(about | {"cases": cases}, indent=1, ensure_ascii=False, allow_nan=False)
    write_file(path, text + "\n")
    return path


def _number(key: str, value: Any) -> Any:
    return math.nan if value is None and key in ("computed", "reference") else value


def _curve(data: dict[str, Any]) -> Curve:
    x, y = (tuple(math.nan if v is None else v for v in data[key]) for key in ("x", "y"))
    return Curve(data["label"], x, y, data["style"])


def _clean(value: Any) -> Any:
    if isinstance(value, dict):
        return {k: _clean(v) for k, v in value.items()}
    if isinstance(value, list | tuple):
        return [_clean(v) for v in value]
    if hasattr(value, "item"):  # a NumPy scalar
        value = value.item()
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
