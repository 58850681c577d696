"""The languages of the window. English is in the source; others are compiled from `translations/*.ts`."""

from enum import StrEnum
from pathlib import Path
from typing import Final

from PySide6.QtCore import QCoreApplication, QLibraryInfo, QLocale, QTranslator

_FOLDER: Final = Path(__file__).resolve().parents[1] / "translations"
_OWN: Final = "tumble"


class Language(StrEnum):
    """The languages that the window speaks."""

    ENGLISH = "en"
    UKRAINIAN = "uk"

    @property
    def endonym(self) -> str:
        """What it calls itself."""
        return {"en": "English", "uk": "Українська"}[self]


def preferred() -> Language:
    """The language of the desktop, if the window speaks it; else English."""
    return Language.UKRAINIAN if QLocale.system().language() == QLocale.Language.Ukrainian else Language.ENGLISH


def speak(language: Language) -> None:
    """Have everything that is made from now on in a language."""
    application = QCoreApplication.instance()
    assert application is not None, "there are no texts without an application"
    for translator in application.findChildren(QTranslator):
        application.removeTranslator(translator)
        translator.deleteLater()
    QLocale.setDefault(_locale(language))
    places = {_OWN: _FOLDER, "qtbase": Path(QLibraryInfo.path(QLibraryInfo.LibraryPath.TranslationsPath))}
    for name, folder in places.items():
        translator = QTranslator(application)
        if translator.load(str(folder / f"{name}_{language}.qm")):
            application.installTranslator(translator)


def _locale(language: Language) -> QLocale:
    """English numbers have a point wherever the desktop is; Ukrainian ones a comma."""
    if language is Language.UKRAINIAN:
        return QLocale(QLocale.Language.Ukrainian, QLocale.Country.Ukraine)
    locale = QLocale(QLocale.Language.English, QLocale.Country.UnitedKingdom)
    locale.setNumberOptions(QLocale.NumberOption.OmitGroupSeparator)
    return locale
