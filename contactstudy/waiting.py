"""What comes next when some wait for others."""

from __future__ import annotations

import heapq
from collections.abc import Collection, Mapping


class Waiting:
    """Names that have not been begun, in the order given; each waits for the end of others.

    `after` gives those of each; a name that is none of these is not waited for.
    """

    def __init__(self, after: Mapping[str, Collection[str]]) -> None:
        self._order = list(after)
        self._place = {name: place for place, name in enumerate(after)}
        self._before = {name: after.keys() & set(others) for name, others in after.items()}
        self._followers: dict[str, list[str]] = {}
        for name, others in self._before.items():
            for other in others:
                self._followers.setdefault(other, []).append(name)
        self._ready = [self._place[name] for name, others in self._before.items() if not others]

    def __len__(self) -> int:
        return len(self._before)

    @property
    def names(self) -> list[str]:
        """All that are left."""
        return list(self._before)

    def next(self) -> str | None:
        """The first that waits for nothing, which is then no longer here; None without one."""
        if not self._ready:
            return None
        name = self._order[heapq.heappop(self._ready)]
        del self._before[name]
        return name

    def ended(self, name: str) -> None:
        """Let go what waited for a name that has ended."""
        for follower in self._followers.pop(name, ()):
            self._before[follower].remove(name)
            if not self._before[follower]:
                heapq.heappush(self._ready, self._place[follower])
