"""Countries by the words of radio amateurs, and where their middles are: capitals and landmarks of an atlas."""

from __future__ import annotations

import pytest

from rotator.orbits.countries import Ambiguous, countries, country
from rotator.orbits.earth import Site, direction
from tests.tables import every_row


@every_row(
    ("words", "name"),
    [
        ("JA", "Japan"),
        ("japan", "Japan"),
        ("VK", "Australia"),
        ("New Zealand", "New Zealand"),
        ("falkland", "Falkland Islands"),
        ("K", "United States"),
        ("USA", "United States"),
        ("Réunion", "Reunion"),
        ("Saint Lucia", "St. Lucia"),
        ("trinidad & tobago", "Trinidad and Tobago"),
        ("Côte d'Ivoire", "Ivory Coast"),
        ("Guinea", "Guinea"),
        ("Ireland", "Ireland"),
        # A whole callsign is its longest prefix's.
        ("JA1ABC", "Japan"),
        ("JD1BMH", "Ogasawara"),
        ("DL1ABC", "Germany"),
        ("W1AW", "United States"),
        ("KH6XX", "Hawaii"),
        ("KG4AA", "Guantanamo Bay"),
        ("KG4ABC", "United States"),
        ("UA9CDC", "Asiatic Russia"),
        ("RA3AA", "European Russia"),
        ("UA2FZ", "Kaliningrad"),
        ("EA8ABC", "Canary Islands"),
        ("EA5ABC", "Spain"),
        ("2E0ABC", "England"),
        ("GM3XYZ", "Scotland"),
        ("HB0ABC", "Liechtenstein"),
        ("3DA0AB", "Eswatini"),
        ("OH0ABC", "Aland Islands"),
        ("9M8ABC", "East Malaysia"),
        ("PY0FAA", "Fernando de Noronha"),
        ("4U1ITU", "ITU Headquarters"),
        ("ZL7ABC", "Chatham Islands"),
        # Where the station is.
        ("DL/F1EFW", "Germany"),
        ("F1EFW/P", "France"),
        ("K1ABC/VE3", None),
        ("G3XYZ/MM", None),
        ("VP9/G3XYZ", "Bermuda"),
        # Satellites, and what is nobody's.
        ("AO7", None),
        ("RS44", None),
        ("XW2A", None),
        ("ISS", None),
        ("VK9AB", None),
        ("", None),
        ("Atlantis", None),
    ],
)
def test_who_is_meant(words: str, name: str | None) -> None:
    found = country(words)
    assert (found and found.name) == name


@every_row(
    ("words", "candidates"),
    [
        ("Korea", {"North Korea", "South Korea"}),
        ("Congo", {"Republic of the Congo", "Democratic Republic of the Congo"}),
        ("Virgin Islands", {"US Virgin Islands", "British Virgin Islands"}),
        ("US", {"United States", "Ukraine"}),
        ("Russia", {"European Russia", "Asiatic Russia"}),
        ("3Y0ABC", {"Bouvet Island", "Peter I Island"}),
        ("Islands", {"Spratly Islands", "Faroe Islands"}),
    ],
)
def test_what_may_mean_several_is_refused_with_their_names(words: str, candidates: set[str]) -> None:
    with pytest.raises(Ambiguous, match=r"may be .*: name one") as told:
        country(words)
    named = str(told.value).split(" may be ")[1].removesuffix(": name one").removesuffix(" …").split(", ")
    assert candidates & set(named)
    assert words == "Islands" or set(named) == candidates


@every_row(
    ("name", "landmark"),
    [
        ("Japan", Site(35.7, 139.7)),  # Tokyo
        ("Germany", Site(50.9, 10.4)),
        ("New Zealand", Site(-41.3, 174.8)),  # Wellington
        ("Australia", Site(-23.7, 133.9)),  # Alice Springs
        ("United States", Site(39.1, -94.6)),  # Kansas City
        ("Brazil", Site(-15.8, -47.9)),  # Brasilia
        ("South Africa", Site(-29.1, 26.2)),  # Bloemfontein
        ("Fiji", Site(-18.1, 178.4)),
        ("Tonga", Site(-21.1, -175.2)),
        ("Falkland Islands", Site(-51.7, -57.9)),  # Stanley
        ("Easter Island", Site(-27.1, -109.4)),
        ("Svalbard", Site(78.2, 15.6)),  # Longyearbyen
        ("Reunion", Site(-20.9, 55.5)),
        ("Hawaii", Site(21.3, -157.9)),  # Honolulu
        ("Iceland", Site(64.1, -21.9)),  # Reykjavik
        ("Bahrain", Site(26.2, 50.6)),
        ("Chagos Islands", Site(-7.3, 72.4)),  # Diego Garcia
    ],
)
def test_middles_beside_landmarks(name: str, landmark: Site) -> None:
    (found,) = [each for each in countries() if each.name == name]
    assert found.latitude_deg == pytest.approx(landmark.latitude_deg, abs=5.0)
    assert found.longitude_deg == pytest.approx(landmark.longitude_deg, abs=6.5)
    assert direction(Site(0.0, 0.0), Site(found.latitude_deg, found.longitude_deg)) is not None


def test_every_country_is_on_the_earth_and_is_found_by_each_of_its_names() -> None:
    assert len(countries()) == 340
    for each in countries():
        assert abs(each.latitude_deg) <= 90
        assert abs(each.longitude_deg) <= 180
        for name in each.names:
            if name != ("us",):  # a prefix of Ukraine, too
                assert country(" ".join(name)) is each
