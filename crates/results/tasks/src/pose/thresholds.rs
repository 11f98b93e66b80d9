//! Bins of translations and rotations between decimal thresholds.

use serde::{Deserialize, Serialize};

use super::error::PoseError;

/// Greatest number of digits before and after the point of a threshold.
const DIGITS: usize = 6;
/// Number of picometres in a millimetre, and of nanodegrees in a degree.
const FINE: f64 = 1e9;

/// Thresholds of a classified change of pose, as decimals in mm and in degrees.
///
/// n thresholds, each with both signs, divide an axis into 2 n + 1 bins. A bin includes its lower end. Values and thresholds are compared in whole
/// picometres or nanodegrees. A value of −0.1 mm therefore equals the threshold 0.1, although binary numbers represent neither exactly.
///
/// ```
/// use taceva_tasks::pose::Thresholds;
/// let bench = Thresholds::new(&["0.1", "0.5", "1", "2", "5"], &["0.03", "0.2", "0.5", "1", "2"])?;
/// assert_eq!([-6.0, -0.1, 0.0999999, 5.0].map(|mm| bench.bin_of_mm(mm)), [0, 5, 5, 10]);
/// # Ok::<(), taceva_tasks::pose::PoseError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(into = "Decimals", try_from = "Decimals")]
pub struct Thresholds {
    /// Ascending thresholds of translations, nm.
    translation: Vec<u64>,
    /// Ascending thresholds of rotations, µdeg.
    rotation: Vec<u64>,
}

impl Thresholds {
    /// Thresholds of translations in mm and of rotations in degrees, ascending.
    ///
    /// # Errors
    /// [`PoseError::Threshold`] for a text that is not a decimal above 0 with at most six places; [`PoseError::Order`] unless the
    /// thresholds ascend; [`PoseError::NoThreshold`] for an empty list.
    pub fn new(translation: &[&str], rotation: &[&str]) -> Result<Thresholds, PoseError> {
        Ok(Thresholds {
            translation: millionths("translation", translation)?,
            rotation: millionths("rotation", rotation)?,
        })
    }

    /// Number of bins of a translation and of a rotation.
    #[must_use]
    pub fn bins(&self) -> [usize; 2] {
        [&self.translation, &self.rotation].map(|cuts| 2 * cuts.len() + 1)
    }

    /// Bin of a translation along an axis, from 0.
    #[must_use]
    pub fn bin_of_mm(&self, mm: f64) -> usize {
        bin(&self.translation, mm)
    }

    /// Bin of a rotation about an axis, from 0.
    #[must_use]
    pub fn bin_of_degrees(&self, degrees: f64) -> usize {
        bin(&self.rotation, degrees)
    }

    /// Texts of both lists for a definition: `t 0.1 0.5 mm, r 0.03 0.2 deg`.
    pub(super) fn words(&self) -> String {
        let Decimals {
            translation,
            rotation,
        } = Decimals::from(self.clone());
        let [translation, rotation] = [translation, rotation].map(|texts| texts.join(" "));
        format!("t {translation} mm, r {rotation} deg")
    }
}

/// Thresholds as written: decimals in mm and in degrees.
#[derive(Serialize, Deserialize)]
struct Decimals {
    translation: Vec<String>,
    rotation: Vec<String>,
}

impl From<Thresholds> for Decimals {
    fn from(thresholds: Thresholds) -> Decimals {
        let texts = |cuts: Vec<u64>| -> Vec<String> { cuts.into_iter().map(decimal).collect() };
        Decimals {
            translation: texts(thresholds.translation),
            rotation: texts(thresholds.rotation),
        }
    }
}

impl TryFrom<Decimals> for Thresholds {
    type Error = PoseError;
    fn try_from(decimals: Decimals) -> Result<Thresholds, PoseError> {
        let list = |texts: &[String], axis| {
            let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
            millionths(axis, &texts)
        };
        Ok(Thresholds {
            translation: list(&decimals.translation, "translation")?,
            rotation: list(&decimals.rotation, "rotation")?,
        })
    }
}

/// Number of thresholds, including negative thresholds, that do not exceed `value`.
fn bin(cuts: &[u64], value: f64) -> usize {
    let fine = (value * FINE).round();
    let bounds = cuts.iter().map(|cut| (cut * 1000) as f64);
    let below = bounds.clone().filter(|bound| -bound <= fine).count();
    below + bounds.filter(|bound| *bound <= fine).count()
}

/// Ascending decimals as whole millionths.
fn millionths(axis: &'static str, texts: &[&str]) -> Result<Vec<u64>, PoseError> {
    let mut found: Vec<u64> = Vec::new();
    for text in texts {
        let text = text.trim();
        let cut = millionth(text).ok_or_else(|| PoseError::Threshold {
            text: text.to_owned(),
        })?;
        if found.last().is_some_and(|last| *last >= cut) {
            return Err(PoseError::Order {
                text: text.to_owned(),
            });
        }
        found.push(cut);
    }
    match found.is_empty() {
        true => Err(PoseError::NoThreshold { axis }),
        false => Ok(found),
    }
}

/// A decimal above 0 as whole millionths; `None` for another text.
fn millionth(text: &str) -> Option<u64> {
    let (whole, places) = text.split_once('.').unwrap_or((text, ""));
    let are_digits = [whole, places]
        .iter()
        .all(|part| part.len() <= DIGITS && part.bytes().all(|byte| byte.is_ascii_digit()));
    if !are_digits || whole.is_empty() {
        return None;
    }
    let digits = format!("{whole}{places:0<DIGITS$}");
    digits.parse::<u64>().ok().filter(|cut| *cut > 0)
}

/// Shortest decimal of whole millionths.
fn decimal(cut: u64) -> String {
    let text = format!("{}.{:06}", cut / 1_000_000, cut % 1_000_000);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
