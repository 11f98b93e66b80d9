//! Degrees of freedom of an uncertainty: a number, infinity, or undefined with a reason.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Degrees of freedom, in JSON a number, `"infinite"`, or `"undefined: …"` with the reason.
///
/// ```
/// use taceva_metrology::budget::Freedom;
/// assert_eq!(Freedom::Finite(16.7519).to_string(), "16.7");
/// assert_eq!(Freedom::Infinite.to_string(), "infinite");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(into = "Record", try_from = "Record")]
#[non_exhaustive]
pub enum Freedom {
    /// A number above 0.
    Finite(f64),
    /// Infinite: the uncertainty is known exactly.
    Infinite,
    /// Undefined, with the reason.
    Undefined(Undefined),
}

/// Reason why a budget has no effective degrees of freedom.
///
/// ```
/// use taceva_metrology::budget::Undefined;
/// assert_eq!(Undefined::NoUncertainty.to_string(), "no source has an uncertainty");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Undefined {
    /// Sources with finite degrees of freedom are correlated, but not through common rows. The Welch–Satterthwaite formula does not apply.
    #[error("sources with finite degrees of freedom are correlated, but not through common rows")]
    CorrelatedFreedom,
    /// The combined uncertainty is 0.
    #[error("no source has an uncertainty")]
    NoUncertainty,
}

impl Freedom {
    /// Degrees of freedom, infinity included; `None` if undefined.
    pub fn number(self) -> Option<f64> {
        match self {
            Freedom::Finite(number) => Some(number),
            Freedom::Infinite => Some(f64::INFINITY),
            Freedom::Undefined(_) => None,
        }
    }

    /// Degrees of freedom of a standard uncertainty with relative accuracy q: ν = 1 / (2 q²), GUM G.4.2.
    pub fn of_reliability(relative: f64) -> Freedom {
        match relative > 0.0 {
            true => Freedom::Finite(0.5 / (relative * relative)),
            false => Freedom::Infinite,
        }
    }
}

impl fmt::Display for Freedom {
    /// Writes one decimal, rounded down, so that the text never overstates the degrees of freedom.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Freedom::Finite(number) => write!(f, "{:.1}", (number * 10.0).floor() / 10.0),
            Freedom::Infinite => f.write_str("infinite"),
            Freedom::Undefined(reason) => write!(f, "undefined: {reason}"),
        }
    }
}

/// JSON form of degrees of freedom.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Record {
    Number(f64),
    Words(String),
}

impl From<Freedom> for Record {
    fn from(freedom: Freedom) -> Record {
        match freedom {
            Freedom::Finite(number) => Record::Number(number),
            other => Record::Words(other.to_string()),
        }
    }
}

impl TryFrom<Record> for Freedom {
    type Error = String;

    fn try_from(record: Record) -> Result<Freedom, String> {
        let words = match record {
            Record::Number(number) => return Ok(Freedom::Finite(number)),
            Record::Words(words) => words,
        };
        let reasons = [Undefined::CorrelatedFreedom, Undefined::NoUncertainty];
        let [one, other] = reasons.map(Freedom::Undefined);
        let mut known = [Freedom::Infinite, one, other].into_iter();
        let found = known.find(|known| known.to_string() == words);
        found.ok_or_else(|| format!("`{words}` is not a number of degrees of freedom"))
    }
}
