import copy
import pickle

import pytest

from tumble.messages import Language, Message, read_back, translatable, translate, with_wording


def test_a_message_is_its_english_text():
    assert Message("{rows} rows are too few", rows=3) == "3 rows are too few"


def test_a_message_keeps_template_and_fields():
    message = Message("{rows} rows are too few", rows=3)
    assert (message.template, dict(message.fields)) == ("{rows} rows are too few", {"rows": 3})


def test_a_field_that_is_not_given_is_a_fault():
    with pytest.raises(KeyError, match="rows"):
        Message("{rows} rows are too few")


def test_a_known_template_is_put_into_a_language_with_its_fields():
    message = Message("The run is over: {message}.", message="x")
    assert message.in_language(Language.GERMAN) == "Der Lauf ist beendet: x."
    assert message.in_language(Language.UKRAINIAN) == "Прогін завершено: x."


def test_a_field_that_is_a_message_goes_with_it():
    message = Message("The run is over: {message}.", message=Message("the programme was carried out"))
    assert message == "The run is over: the programme was carried out."
    assert message.in_language(Language.GERMAN) == "Der Lauf ist beendet: das Programm wurde ausgeführt."


def test_the_text_of_an_exception_is_still_the_message():
    assert str(ValueError(Message("Stop: {reason}", reason="door"))).in_language(Language.GERMAN).endswith("door")


def test_an_exception_as_a_field_goes_with_it(monkeypatch):
    monkeypatch.setattr("tumble.messages._looked_up", lambda template, _: template.upper().replace("ERROR", "error"))
    inner = ValueError(Message("no rows"))
    assert Message("file: {error}", error=inner).in_language(Language.GERMAN) == "FILE: NO ROWS"


def test_messages_in_a_row_are_each_put_into_the_language():
    message = Message.joined("; ", [Message("does not answer"), "port 3"])
    assert message == "does not answer; port 3"
    assert message.in_language(Language.GERMAN) == "antwortet nicht; port 3"


@pytest.mark.parametrize("language", Language)
def test_what_no_catalogue_holds_stays_english(language):
    assert Message("{n} frobnicators", n=2).in_language(language) == "2 frobnicators"
    assert translate("the frobnicator is bent", language) == "the frobnicator is bent"


@pytest.mark.parametrize("language", Language)
def test_an_empty_text_stays_empty(language):
    assert translate("", language) == ""
    assert Message("").in_language(language) == ""


@pytest.mark.parametrize(("count", "text"), [(0, "0 gnomes"), (1, "1 gnome"), (2, "2 gnomes")])
def test_number_chooses_the_wording(count, text):
    message = Message.counted("{count} gnome", "{count} gnomes", count=count)
    assert message == text
    assert message.in_language(Language.GERMAN) == text


def test_three_wordings_for_number_in_ukrainian(ukrainian_rows):
    said = [Message.counted("{count} row", "{count} rows", count=n).in_language(Language.UKRAINIAN) for n in (1, 2, 5)]
    assert said == ["1 рядок", "2 рядки", "5 рядків"]


def test_a_number_is_written_as_the_template_asks():
    assert Message("{now:.3f} V", now=1.0).in_language(Language.GERMAN) == "1.000 V"


def test_text_is_put_into_a_language_as_a_message_or_as_a_key():
    assert translate("does not answer", Language.GERMAN) == "antwortet nicht"
    assert translate(Message("The run is over: {message}.", message=1), Language.GERMAN) == "Der Lauf ist beendet: 1."


@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, lambda message: pickle.loads(pickle.dumps(message))])
def test_a_copy_can_still_be_put_into_a_language(again):
    message = again(Message.counted("{count} row {{}} {why}", "{count} rows {{}} {why}", count=2, why=Message("none")))
    assert message == "2 rows {} none"
    assert message.in_language(Language.GERMAN) == "2 rows {} keine"


@pytest.fixture
def scale_drift():
    return Message.named("scale_drift", "scale factor drift")


def test_a_name_of_a_document_stays_itself_in_english_and_is_worded_in_another_language(scale_drift):
    said = Message("none of {names}", names=scale_drift)
    assert said == said.in_language(Language.ENGLISH) == "none of scale_drift"
    assert scale_drift.in_language(Language.GERMAN) == "Drift des Skalenfaktors"
    assert scale_drift.worded(Language.ENGLISH) == "scale factor drift"
    assert said.worded(Language.ENGLISH) == "none of scale factor drift"


def test_a_name_that_lost_its_wording_finds_it_again(scale_drift):
    assert translate(with_wording("scale_" + "drift"), Language.GERMAN) == "Drift des Skalenfaktors"
    assert with_wording("magnet") == translate(with_wording("magnet"), Language.GERMAN) == "magnet"


def test_a_template_is_only_marked():
    assert translatable("{} rows") == "{} rows"


def test_a_language_is_called_what_it_calls_itself():
    assert [language.endonym for language in Language] == ["English", "Українська", "Deutsch"]


@pytest.fixture
def ukrainian_rows(tmp_path, monkeypatch):
    from babel.messages.catalog import Catalog
    from babel.messages.mofile import write_mo

    from tumble import messages

    catalogue = Catalog(locale="uk")
    catalogue.add(("{count} row", "{count} rows"), ("{count} рядок", "{count} рядки", "{count} рядків"))
    folder = tmp_path / "uk" / "LC_MESSAGES"
    folder.mkdir(parents=True)
    with (folder / "tumble.mo").open("wb") as compiled:
        write_mo(compiled, catalogue)
    monkeypatch.setattr(messages, "_LOCALES", tmp_path)
    messages._catalogue.cache_clear()
    yield
    messages._catalogue.cache_clear()


@pytest.mark.parametrize(
    ("kept", "german"),
    [
        (
            "the rows do not separate it from the other parameters",
            "die Zeilen trennen ihn nicht von den anderen Parametern",
        ),
        (
            "its 95% interval is unbounded: no row has gravity along Ox and Oy at once",
            "das 95-%-Intervall ist unbeschränkt: in keiner Zeile wirkt die Schwerkraft zugleich längs Ox und Oy",
        ),
        ("its certificate is older: see there", "its certificate is older: see there"),
    ],
)
def test_a_text_of_a_document_is_put_into_a_language_as_far_as_it_is_known(kept, german):
    assert read_back(kept) == kept
    assert read_back(kept).in_language(Language.ENGLISH) == kept
    assert read_back(kept).in_language(Language.GERMAN) == german
