"""Who lacks what another process makes waits for it, and no longer than that."""

import threading

from workbench.files import turn
from workbench.files.turn import Turn


def taken_by_another(path):
    """Whether a second one gets its turn at once; it stands for another process, for locks are those of open files."""
    another = Turn(path)
    done = threading.Event()
    thread = threading.Thread(target=lambda: (another.take(), done.set(), another.end()))
    thread.start()
    return done, thread


def test_the_second_waits_for_the_first(tmp_path):
    first = Turn(tmp_path / "a.turn")
    first.take()
    first.take()  # it has it already
    done, thread = taken_by_another(tmp_path / "a.turn")
    assert not done.wait(0.05)
    first.end()
    assert done.wait(60)
    thread.join()
    first.end()  # of no effect


def test_who_waits_too_long_or_cannot_lock_goes_on_alone(tmp_path, monkeypatch):
    monkeypatch.setattr(turn, "PATIENCE_S", 0.01)
    first = Turn(tmp_path / "a.turn")
    first.take()
    late, nowhere = Turn(tmp_path / "a.turn"), Turn(tmp_path / "missing" / "a.turn")
    late.take()
    nowhere.take()
    (tmp_path / "link.turn").symlink_to(tmp_path / "elsewhere")
    Turn(tmp_path / "link.turn").take()
    assert not (tmp_path / "elsewhere").exists()
    late.end()
    third = Turn(tmp_path / "a.turn")
    third.take()
    assert third._handle < 0  # still the first one's
    first.end()
    third.take()
    assert third._handle >= 0
    third.end()
