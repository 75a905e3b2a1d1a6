"""The life of one page: a log of what was done, and the board after each of it.

Undo and redo go as far back as the log. The latest boards are kept, of older ones every so many, from which those between
are made again when somebody gets there.
"""

from __future__ import annotations

from studio.actions import Action, Strokes, done, dumps, loads
from studio.board import Board
from studio.limits import LIMITS, Refused

UNDO, REDO = "undo", "redo"
KEPT = 200
"""The latest boards are all kept: undo shows them at once."""
SPARSE = 50
"""Of older ones one in so many is."""


class History:
    """Mutable. `entry` values are what the log keeps: an action as JSON, `undo` or `redo`."""

    def __init__(self, strokes: Strokes) -> None:
        """strokes: the raw stroke of a name."""
        self._strokes = strokes
        self._boards: list[Board | None] = [Board()]
        self._now = Board()
        self._actions: list[str] = []
        self._undone: list[tuple[str, Board]] = []
        self.length = 0

    @property
    def board(self) -> Board:
        """The page as it is now."""
        return self._now

    @property
    def undoable(self) -> str | None:
        """The last action, as JSON; None where there is nothing to undo."""
        return self._actions[-1] if self._actions else None

    @property
    def redoable(self) -> str | None:
        """The action that redo would do again."""
        return self._undone[-1][0] if self._undone else None

    def foreseen(self, entry: str | Action) -> Board:
        """The board that an entry leads to, which is not made yet. Raises Refused where it leads nowhere."""
        if self.length >= LIMITS.actions:
            raise Refused(
                f"this page has been changed {LIMITS.actions} times, the most that is kept; save it as a file and open that"
            )
        match entry:
            case "undo":
                if not self._actions:
                    raise Refused("there is nothing to undo")
                return self._board(len(self._boards) - 2)
            case "redo":
                if not self._undone:
                    raise Refused("there is nothing to do again")
                return self._undone[-1][1]
            case str():
                return done(self.board, loads(entry), self._strokes)
            case _:
                return done(self.board, entry, self._strokes)

    def take(self, entry: str | Action, board: Board) -> None:
        """Makes an entry that was foreseen."""
        self.length += 1
        match entry:
            case "undo":
                self._undone.append((self._actions.pop(), self._now))
                self._boards.pop()
            case "redo":
                action, after = self._undone.pop()
                self._actions.append(action)
                self._boards.append(after)
            case _:
                self._actions.append(entry if isinstance(entry, str) else dumps(entry))
                self._boards.append(board)
                self._undone.clear()
        self._now = self._boards[-1] = board
        old = len(self._boards) - 1 - KEPT
        if old > 0 and old % SPARSE:
            self._boards[old] = None

    def _board(self, index: int) -> Board:
        """The board after so many actions, made again from the last one that was kept before it."""
        known = index
        while (board := self._boards[known]) is None:
            known -= 1
        for action in self._actions[known:index]:
            board = done(board, loads(action), self._strokes)
        return board


def remembered(entries: list[str], strokes: Strokes) -> History:
    """A page as its log tells it."""
    history = History(strokes)
    for entry in entries:
        history.take(entry, history.foreseen(entry))
    return history
