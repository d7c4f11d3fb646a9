"""Plain words may narrow what a sentence gives: nothing is taken of more than it says, and the rest is read."""

from narrowed_papers import NARROWED, SIGNED, WHOLE
from test_false_papers import row_of, verdict


def verdicts(folder, texts):
    claimed = {text: row_of("notes", text)[0].role == "claim" for text in texts}
    return {text: verdict(folder / str(number), "notes", text) if claimed[text] else "words"
            for number, text in enumerate(texts)}


def test_what_holds_for_a_part_alone_is_not_proved_for_all(tmp_path):
    assert not {text for text, of in verdicts(tmp_path, NARROWED).items() if of == "proved"}


def test_what_holds_by_a_sign_that_words_say_is_not_refuted(tmp_path):
    assert not {text for text, of in verdicts(tmp_path, SIGNED).items() if of in ("refuted", "proved")}


def test_what_is_given_for_the_whole_motion_is_taken(tmp_path):
    assert {text: of for text, of in verdicts(tmp_path, WHOLE).items() if of != "proved"} == {}
