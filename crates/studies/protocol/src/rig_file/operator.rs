//! Table `[operator]` of a rig file: the operator's name, and the enabling switch that the operator holds.

use serde::Deserialize;

use super::Check;
use crate::text::{SceneError, SceneProblem, Setting};

/// Default time to wait for a held enabling switch, in s.
const USUAL_PATIENCE_S: f64 = 60.0;
/// Greatest accepted time to wait for a held enabling switch, in s.
const GREATEST_PATIENCE_S: f64 = 86_400.0;

/// Enabling switch of a rig, which its operator holds.
#[derive(Clone, Debug, PartialEq)]
pub struct RigOperator {
    /// Selector of the driver of the enabling switch. Releasing the switch halts the robot.
    pub enable: Setting<String>,
    /// Longest time to wait until the operator holds the switch, in s.
    pub patience_s: f64,
}

#[derive(Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "a table with `enable`, `name` or both"
)]
pub(super) struct WrittenOperator {
    pub(super) name: Option<Setting<String>>,
    enable: Option<Setting<String>>,
    patience_s: Option<Setting<f64>>,
}

impl WrittenOperator {
    /// The enabling switch; `None` if the table only names the operator.
    pub(super) fn switch(
        self,
        check: &Check<'_>,
        is_named: bool,
    ) -> Result<Option<RigOperator>, SceneError> {
        let Some(enable) = self.enable else {
            let patience = self.patience_s;
            return match patience.is_none() && is_named {
                true => Ok(None),
                false => {
                    let at = patience.and_then(|patience| patience.at());
                    let problem = "[operator] has no `enable`, the switch that a person holds; without a switch it has only `name`";
                    check.refuse(at, problem.to_owned())
                }
            };
        };
        if let Some(patience) = &self.patience_s
            && !(patience.value > 0.0 && patience.value <= GREATEST_PATIENCE_S)
        {
            let problem = SceneProblem::Range {
                key: "patience_s",
                found: patience.value,
                above: 0.0,
                greatest: GREATEST_PATIENCE_S,
            };
            return Err(check.text.error(patience.at(), problem));
        }
        let patience_s = self.patience_s.map(|patience| patience.value);
        Ok(Some(RigOperator {
            enable,
            patience_s: patience_s.unwrap_or(USUAL_PATIENCE_S),
        }))
    }
}

#[cfg(test)]
mod tests {
    use crate::rig_file::RigFile;

    #[test]
    fn an_operator_may_have_a_name_without_a_switch_and_a_rig_a_laboratory() {
        let text =
            "rig_version = 1\nlaboratory = \"Soft Robotics\"\n[operator]\nname = \"A. Lovelace\"\n";
        let rig = RigFile::parse("lab.toml", text).expect("a rig");
        assert_eq!(rig.laboratory.as_deref(), Some("Soft Robotics"));
        assert_eq!(rig.operator_name.as_deref(), Some("A. Lovelace"));
        assert!(rig.operator.is_none());
        let with_switch = format!("{text}enable = \"hid/pedal\"\n");
        let rig = RigFile::parse("lab.toml", &with_switch).expect("a rig");
        assert!(rig.operator.is_some() && rig.operator_name.is_some());
    }

    #[test]
    fn an_operator_without_switch_and_name_and_an_empty_name_are_refused() {
        for (lines, expected) in [
            ("[operator]\n", "[operator] has no `enable`"),
            (
                "[operator]\nname = \"A\"\npatience_s = 9.0\n",
                "[operator] has no `enable`",
            ),
            (
                "[operator]\nname = \" \"\n",
                "`name` is empty, expected a name",
            ),
            (
                "laboratory = \"\"\n",
                "`laboratory` is empty, expected a name",
            ),
        ] {
            let text = format!("rig_version = 1\n{lines}");
            let error = RigFile::parse("lab.toml", &text).expect_err("refused");
            assert!(error.to_string().contains(expected), "{error}");
        }
    }
}
