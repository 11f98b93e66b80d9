//! Errors of needs, with the known needs.

use super::words::{QUANTITIES, WORDS};

/// Error while parsing needs.
#[derive(Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NeedError {
    /// No need is given.
    #[error(
        "no need is given: expected words such as `shear` or numbers such as `rate >= 50 Hz`, separated by commas"
    )]
    Empty,
    /// Unknown word.
    #[error("`{0}`: unknown need, expected one of {known}", known = known())]
    Unknown(String),
    /// A number or its unit is invalid.
    #[error("`{words}`: expected a number above 0{units}, such as `{example}`")]
    Number {
        /// Need as the user wrote it.
        words: String,
        /// Expected units, as text.
        units: String,
        /// Example of the need with a valid number.
        example: String,
    },
    /// A strict sign, `<` or `>`, which would exclude the bound itself.
    #[error("`{words}`: a bound includes its number; write `{instead}`")]
    Strict {
        /// Need as the user wrote it.
        words: String,
        /// The same need with an accepted sign, `<=` or `>=`.
        instead: String,
    },
    /// A price without a bound, which cannot rank sensors.
    #[error(
        "`{0}`: prices are not ranked; bound the price of a ready sensor, such as `price <= 500 USD`"
    )]
    Price(String),
    /// Word for robustness to a fault, such as `dust`, instead of the accepted word `rugged`.
    #[error(
        "`{0}`: expected `rugged`, which ranks results by their errors under tested faults such as dust and wear (`taceva stress`)"
    )]
    Fault(String),
    /// Several needs are wrong.
    #[error("{}", all(.0))]
    Several(Vec<NeedError>),
    /// The file is not TOML of the form `needs = ["…", …]`.
    #[error("needs: {0}")]
    Toml(#[from] toml::de::Error),
}

/// Text of several errors, with one list of the known needs.
fn all(errors: &[NeedError]) -> String {
    let is_unknown = |error: &&NeedError| matches!(error, NeedError::Unknown(_));
    let others = errors.iter().filter(|error| !is_unknown(error));
    let mut sentences: Vec<String> = others.map(NeedError::to_string).collect();
    let unknown = errors.iter().filter_map(|error| match error {
        NeedError::Unknown(words) => Some(format!("`{words}`")),
        _ => None,
    });
    let unknown: Vec<String> = unknown.collect();
    if !unknown.is_empty() {
        let names = unknown.join(", ");
        sentences.push(format!(
            "{names}: unknown need, expected one of {}",
            known()
        ));
    }
    sentences.join("; ")
}

/// All needs with their synonyms: `shear (or accurate shear, shear force), no shear, …`.
fn known() -> String {
    let words = WORDS.iter().map(|word| match word.names {
        [name, synonyms @ ..] if !synonyms.is_empty() => {
            format!("{name} (or {})", synonyms.join(", "))
        }
        names => names.join(", "),
    });
    let quantities = QUANTITIES
        .iter()
        .map(|quantity| quantity.written("<number>"));
    words.chain(quantities).collect::<Vec<_>>().join(", ")
}
