import copy

from tumble.messages import Language, Message


def test_a_name_is_itself_and_its_words_to_a_reader():
    name = Message.named("head_scale", "scale of the head")
    assert (name, name in {"head_scale": 1}, f"{name}!") == ("head_scale", True, "head_scale!")
    assert Message("no programme tells {name}", name=name) == "no programme tells head_scale"
    assert name.in_language(Language.GERMAN) == "Skalenabweichung des Teilkopfs"


def test_a_name_with_a_number_in_it_keeps_it():
    name = Message.named("graduation 7", "graduation error, {order} per turn", order=7)
    assert copy.deepcopy(name) == "graduation 7"
    assert copy.deepcopy(name).in_language(Language.GERMAN) == "Teilungsabweichung, 7 je Umdrehung"


def test_a_capital_stands_at_the_beginning_in_every_language():
    message = Message.capitalised(Message("{name}, {order} per turn", name=Message("backlash"), order=3))
    assert message == "Backlash, 3 per turn"
    assert message.in_language(Language.UKRAINIAN) == "Люфт, 3 за оберт"
