//! Comparison of the transducer of a rig with a known weight, and its entry in the rig file.

use serde::{Deserialize, Serialize};
use taceva_core::Date;

use super::latency::insert_after;
use super::{Check, RigFile};
use crate::text::{SceneError, Setting};

/// Comparison of the change of Fz under a known mass m with its weight m·g, as stored in a rig file. It gets no further field.
///
/// ```
/// use taceva_protocol::{RigFile, Weighing};
/// let text = "rig_version = 1\n[force]\ndriver = \"lab/box\"\naxes = [\"x\", \"y\", \"z\"]\n";
/// let rig = RigFile::parse("lab.toml", text)?;
/// let on = "2026-11-29".parse().expect("a day");
/// let weighing = Weighing { mass_g: 100.0, expected_n: 0.9807, measured_n: 0.979, tolerance_n: 0.02, on };
/// let written = rig.with_weighing(&weighing).expect("a table that takes a line");
/// let force = RigFile::parse("lab.toml", &written)?.force.expect("a transducer");
/// assert_eq!(force.weighing.map(|kept| kept.value), Some(weighing));
/// # Ok::<(), taceva_protocol::SceneError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "a table with the result of a weighing"
)]
pub struct Weighing {
    /// Mass of the weight, in g.
    pub mass_g: f64,
    /// Weight m·g, in N.
    #[serde(rename = "expected_N")]
    pub expected_n: f64,
    /// Absolute change of Fz, in N.
    #[serde(rename = "measured_N")]
    pub measured_n: f64,
    /// Greatest accepted difference between expected and measured change, in N.
    #[serde(rename = "tolerance_N")]
    pub tolerance_n: f64,
    /// Day of the comparison, in UTC.
    pub on: Date,
}

impl Weighing {
    /// True if the measured change of Fz agrees with the weight within the tolerance.
    pub fn is_right(&self) -> bool {
        (self.measured_n - self.expected_n).abs() <= self.tolerance_n
    }

    /// Entry of the comparison as a line of a rig file.
    fn line(&self) -> String {
        let Weighing {
            mass_g,
            expected_n,
            measured_n,
            tolerance_n,
            on,
        } = self;
        format!(
            "weighing = {{ mass_g = {mass_g:?}, expected_N = {expected_n:?}, measured_N = {measured_n:?}, tolerance_N = {tolerance_n:?}, on = \"{on}\" }}"
        )
    }
}

impl Check<'_> {
    pub(super) fn weighing(
        &self,
        weighing: Option<Setting<Weighing>>,
    ) -> Result<Option<Setting<Weighing>>, SceneError> {
        match &weighing {
            Some(written) if !written.value.is_right() => self.refuse(
                written.at(),
                "`weighing`: `measured_N` differs from `expected_N` by more than `tolerance_N`: delete this line, then run `taceva rig check` with `--weight`"
                    .to_owned(),
            ),
            _ => Ok(weighing),
        }
    }
}

impl RigFile {
    /// Text of the file with `weighing` written into it. `None` if the file has no transducer, or if its table takes no line after `driver`.
    pub fn with_weighing(&self, weighing: &Weighing) -> Option<String> {
        let force = self.force.as_ref()?;
        let line = weighing.line();
        let mut text = self.text.whole().to_owned();
        match force.weighing.and_then(|before| before.at()) {
            Some(at) => {
                let table = text.get(at..)?.strip_prefix('{')?;
                let end = at + 1 + table.find('}')? + 1;
                let (_, value) = line.split_once("= ")?;
                text.replace_range(at..end, value);
            }
            None => insert_after(&mut text, force.driver.at()?, &line)?,
        }
        // An inline table or dotted keys cannot take a line after the driver.
        let read = RigFile::parse(self.name(), &text).ok()?;
        let mut expected = RigFile {
            text: read.text.clone(),
            ..self.clone()
        };
        if let Some(force) = &mut expected.force {
            force.weighing = Some(Setting::default_of(*weighing));
        }
        (read == expected).then_some(text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "rig_version = 1\n# Ours.\n[force]\ndriver = \"lab/box\" # on the table\naxes = [\"x\", \"y\", \"z\"]\n[limits]\nFz_max_N = 2.0\n";

    fn weighing(measured_n: f64) -> Weighing {
        Weighing {
            mass_g: 100.0,
            expected_n: 0.9807,
            measured_n,
            tolerance_n: 0.02,
            on: "2026-11-29".parse().expect("a day"),
        }
    }

    #[test]
    fn a_weighing_stands_in_the_table_of_the_transducer_and_replaces_an_earlier_one() {
        let rig = RigFile::parse("lab.toml", TEXT).expect("a rig");
        let once = rig.with_weighing(&weighing(0.979)).expect("written");
        let line = "weighing = { mass_g = 100.0, expected_N = 0.9807, measured_N = 0.979, tolerance_N = 0.02, on = \"2026-11-29\" }\n";
        let expected = TEXT.replace("# on the table\n", &format!("# on the table\n{line}"));
        assert_eq!(once, expected);
        let rig = RigFile::parse("lab.toml", &once).expect("a rig");
        let again = rig.with_weighing(&weighing(0.98)).expect("written");
        assert_eq!(
            again,
            expected.replace("measured_N = 0.979", "measured_N = 0.98")
        );
        let none = RigFile::parse("lab.toml", "rig_version = 1\n").expect("a rig");
        assert_eq!(none.with_weighing(&weighing(0.98)), None);
    }

    #[test]
    fn a_weighing_that_contradicts_itself_is_refused_with_its_line() {
        let line = weighing(4.36).line();
        let wrong = TEXT.replace("[limits]", &format!("{line}\n[limits]"));
        let error = RigFile::parse("lab.toml", &wrong).expect_err("a factor of 4.448");
        let message = error.to_string();
        assert!(
            message.starts_with("lab.toml, line 6: `weighing`: `measured_N` differs"),
            "{message}"
        );
    }
}
