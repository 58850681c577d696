"""The language of the window: one for texts, numbers and Qt's own dialogs."""

from typing import Final

from PySide6.QtCore import QCoreApplication, QLibraryInfo, QLocale, QTranslator

from tumble.messages import Language, Message

_LANGUAGES: Final = {
    QLocale.Language.Ukrainian: Language.UKRAINIAN,
    QLocale.Language.German: Language.GERMAN,
}
_LOCALES: Final = {
    Language.ENGLISH: (QLocale.Language.English, QLocale.Country.UnitedKingdom),
    Language.UKRAINIAN: (QLocale.Language.Ukrainian, QLocale.Country.Ukraine),
    Language.GERMAN: (QLocale.Language.German, QLocale.Country.Germany),
}


def preferred() -> Language:
    """The language of the desktop, if the window speaks it; else English."""
    return _LANGUAGES.get(QLocale.system().language(), Language.ENGLISH)


def spoken() -> Language:
    """The language of the window as it is now."""
    return _LANGUAGES.get(QLocale().language(), Language.ENGLISH)


def speak(language: Language) -> None:
    """Have everything that is made from now on in a language."""
    application = QCoreApplication.instance()
    assert application is not None, "there are no dialogs of Qt without an application"
    QLocale.setDefault(_locale(language))
    for translator in application.findChildren(QTranslator):
        application.removeTranslator(translator)
        translator.deleteLater()
    translator = QTranslator(application)
    if translator.load(f"qtbase_{language}", QLibraryInfo.path(QLibraryInfo.LibraryPath.TranslationsPath)):
        application.installTranslator(translator)


def tr(template: str, /, **fields: object) -> str:
    """A text of the window in its language: a template of the catalogue and what stands in its braces."""
    return Message(template, **fields).in_language(spoken())


def _locale(language: Language) -> QLocale:
    """Numbers are written as the language writes them wherever the desktop is; nothing stands between thousands."""
    locale = QLocale(*_LOCALES[language])
    if language is not Language.UKRAINIAN:
        locale.setNumberOptions(QLocale.NumberOption.OmitGroupSeparator)
    return locale
