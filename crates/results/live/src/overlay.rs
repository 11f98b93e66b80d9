//! Predictions shown over a picture.

use std::fmt::Write as _;

use serde::Serialize;

/// Predictions of a frame, shown over its picture and marked as predictions.
///
/// ```
/// use taceva_live::{Overlay, PredictedValue};
///
/// let overlay = Overlay::new(12.5, vec![PredictedValue::new("Fz", 1.25, "N")]).with_distance(0.4, false);
/// assert_eq!(overlay.outside, Some(false));
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Overlay {
    /// Timestamp of the frame, s, on the clock of the frames.
    #[serde(rename = "t_s")]
    pub stamp_s: f64,
    /// Predicted value of each channel.
    pub values: Vec<PredictedValue>,
    /// Distance of the frame from the training data, where 1 is the limit of the model; `None` if the model computes no distance.
    pub distance: Option<f64>,
    /// True if the frame is outside the training data; `None` if the model computes no distance.
    pub outside: Option<bool>,
}

/// A predicted number with its unit.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct PredictedValue {
    /// Name of the channel, such as `Fz`.
    pub channel: String,
    /// Predicted value, in `unit`.
    pub value: f64,
    /// Symbol of the unit, such as `N`.
    pub unit: String,
}

impl PredictedValue {
    /// Creates the predicted value of `channel` in `unit`.
    pub fn new(channel: &str, value: f64, unit: &str) -> PredictedValue {
        PredictedValue {
            channel: channel.to_owned(),
            value,
            unit: unit.to_owned(),
        }
    }
}

impl Overlay {
    /// Creates the predictions of the frame with timestamp `stamp_s`, s, without a distance from the training data.
    pub fn new(stamp_s: f64, values: Vec<PredictedValue>) -> Overlay {
        Overlay {
            stamp_s,
            values,
            distance: None,
            outside: None,
        }
    }

    /// Sets the `distance` from the training data. `outside` is true for a frame outside the training data.
    #[must_use]
    pub fn with_distance(self, distance: f64, outside: bool) -> Overlay {
        Overlay {
            distance: Some(distance),
            outside: Some(outside),
            ..self
        }
    }

    /// Predictions as the value of an HTTP header: ASCII JSON, because browsers read headers as Latin-1.
    pub(crate) fn header(&self) -> String {
        let json = serde_json::to_string(self).unwrap_or_default();
        let mut header = String::with_capacity(json.len());
        for letter in json.chars() {
            match letter.is_ascii() {
                true => header.push(letter),
                false => {
                    let mut units = [0; 2];
                    for unit in letter.encode_utf16(&mut units) {
                        let _ = write!(header, "\\u{unit:04x}");
                    }
                }
            }
        }
        header
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_is_one_line_of_ascii_that_says_the_same_whatever_a_channel_is_called() {
        for name in [
            "Fz",
            "Kraft µ\u{1F600}",
            "a\r\nSet-Cookie: b",
            "\"}",
            "\u{7f}",
        ] {
            let values = vec![PredictedValue::new(name, -0.5, "N")];
            let header = Overlay::new(1.0, values).with_distance(1.5, true).header();
            assert!(
                header.bytes().all(|byte| (b' '..=0x7f).contains(&byte)),
                "{header}"
            );
            let read: serde_json::Value = serde_json::from_str(&header).expect("JSON");
            assert_eq!(read["values"][0]["channel"], name);
            assert_eq!(read["outside"], true);
        }
    }
}
