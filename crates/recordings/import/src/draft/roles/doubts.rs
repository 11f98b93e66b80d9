//! Columns that by their names hold what was commanded, estimated or computed.

use super::{explained, words};

/// Words in the names of columns that hold no measured values, and what they say.
const DOUBTS: [(&[&str], &str); 4] = [
    (
        &[
            "cmd",
            "command",
            "commanded",
            "target",
            "desired",
            "setpoint",
            "goal",
        ],
        "what was commanded, not what was measured",
    ),
    (
        &[
            "pred",
            "predicted",
            "prediction",
            "est",
            "estimate",
            "estimated",
        ],
        "what was estimated, not what was measured",
    ),
    (
        &[
            "std", "stddev", "var", "variance", "err", "error", "residual",
        ],
        "a deviation, not what was measured",
    ),
    (&["min", "max"], "the end of a range, not what was measured"),
];

/// Why the column called `name` may not hold what was measured; `about` is what its file is called.
pub(crate) fn doubt(name: &str, about: &str) -> Option<String> {
    doubt_of(&words(explained(name, about)))
}

pub(super) fn doubt_of(words: &[String]) -> Option<String> {
    words.iter().find_map(|word| {
        let mut doubts = DOUBTS.iter();
        let (_, reason) = doubts.find(|(known, _)| known.contains(&word.as_str()))?;
        Some(format!("a guess: by `{word}` in its name it is {reason}"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draft::roles::{Role, of_named};

    #[test]
    fn names_of_commands_predictions_and_deviations_are_in_doubt() {
        for (name, word) in [
            ("fz_cmd", Some("`cmd`")),
            ("FzDesired", Some("`desired`")),
            ("fx_std", Some("`std`")),
            ("fy_pred", Some("`pred`")),
            ("z_target", Some("`target`")),
            ("force.z.max", Some("`max`")),
            ("fz_meas", None),
            ("Fz_N", None),
            ("force_z", None),
        ] {
            let doubt = doubt(name, "");
            assert_eq!(doubt.is_some(), word.is_some(), "{name}");
            let reason = doubt.unwrap_or_default();
            assert!(
                reason.contains(word.unwrap_or_default()),
                "{name}: {reason}"
            );
        }
        assert!(doubt("value", "force_cmd").is_some());
        let names = ["fz_cmd", "fz"].map(str::to_owned);
        let expected = vec![("Fz", "[1]".to_owned())];
        assert_eq!(
            of_named("observation.state", &names),
            Some(Role::Channels(expected))
        );
    }
}
