//! Licences of bundles, as SPDX identifiers.

use taceva_core::nearest;

/// Longest licence, in bytes.
const MOST_LICENCE: usize = 64;

/// Identifiers of licences for data, documents, designs and software. Generated files link to the SPDX page of the licence.
const KNOWN: [&str; 60] = [
    "0BSD",
    "AGPL-3.0-only",
    "AGPL-3.0-or-later",
    "Apache-2.0",
    "Artistic-2.0",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "C-UDA-1.0",
    "CC-BY-2.0",
    "CC-BY-2.5",
    "CC-BY-3.0",
    "CC-BY-4.0",
    "CC-BY-NC-3.0",
    "CC-BY-NC-4.0",
    "CC-BY-NC-ND-3.0",
    "CC-BY-NC-ND-4.0",
    "CC-BY-NC-SA-3.0",
    "CC-BY-NC-SA-4.0",
    "CC-BY-ND-4.0",
    "CC-BY-SA-3.0",
    "CC-BY-SA-4.0",
    "CC-PDDC",
    "CC0-1.0",
    "CDLA-Permissive-1.0",
    "CDLA-Permissive-2.0",
    "CDLA-Sharing-1.0",
    "CECILL-2.1",
    "CERN-OHL-P-2.0",
    "CERN-OHL-S-2.0",
    "CERN-OHL-W-2.0",
    "DL-DE-BY-2.0",
    "DL-DE-ZERO-2.0",
    "ECL-2.0",
    "EPL-2.0",
    "EUPL-1.2",
    "GFDL-1.3-only",
    "GFDL-1.3-or-later",
    "GPL-2.0-only",
    "GPL-2.0-or-later",
    "GPL-3.0-only",
    "GPL-3.0-or-later",
    "ISC",
    "LGPL-2.1-only",
    "LGPL-2.1-or-later",
    "LGPL-3.0-only",
    "LGPL-3.0-or-later",
    "MIT",
    "MIT-0",
    "MPL-2.0",
    "NLOD-2.0",
    "O-UDA-1.0",
    "ODC-By-1.0",
    "ODbL-1.0",
    "OGL-Canada-2.0",
    "OGL-UK-3.0",
    "PDDL-1.0",
    "Unlicense",
    "Zlib",
    "etalab-2.0",
];

/// True for an SPDX identifier of a licence in use for data or software, with the upper and lower case of SPDX.
///
/// ```
/// use taceva_bundle::is_licence;
/// assert!(is_licence("CC-BY-4.0") && !is_licence("cc-by-4.0") && !is_licence("CC-BY-9.0"));
/// ```
pub fn is_licence(text: &str) -> bool {
    KNOWN.contains(&text)
}

/// Accepted licences, for the message on an invalid licence `text`. Names the identifier nearest to `text`.
///
/// ```
/// assert_eq!(
///     taceva_bundle::expected_licence("cc-by-4.0"),
///     "expected an SPDX identifier, such as CC-BY-4.0 or MIT; did you mean `CC-BY-4.0`?"
/// );
/// ```
pub fn expected_licence(text: &str) -> String {
    let hint = nearest(text, KNOWN).map(|known| format!("; did you mean `{known}`?"));
    format!(
        "expected an SPDX identifier, such as CC-BY-4.0 or MIT{}",
        hint.unwrap_or_default()
    )
}

/// True if `text` may be an identifier that another version knows: letters, digits, `.`, `-` and `+`. False for a `LicenseRef-…`, which has no page
/// at SPDX.
pub(crate) fn has_form(text: &str) -> bool {
    let is_part = |letter: char| letter.is_ascii_alphanumeric() || ".-+".contains(letter);
    let has_page = !text.starts_with("LicenseRef-");
    has_page && (1..=MOST_LICENCE).contains(&text.len()) && text.chars().all(is_part)
}

#[cfg(test)]
mod tests {
    use super::{KNOWN, has_form, is_licence};

    #[test]
    fn known_identifiers_stand_in_order_and_have_the_form() {
        assert!(KNOWN.is_sorted());
        assert!(KNOWN.iter().all(|known| has_form(known)));
        for wrong in ["CC-BY-4", "GPL", "Apache-2.0+", "LicenseRef-mine", ""] {
            assert!(!is_licence(wrong), "{wrong}");
        }
    }
}
