//! Columns that do not contain a channel: counters, magnitudes, other quantities, commands.

use std::fmt;

/// Reason to exclude a column from every channel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Exclusion {
    /// The column contains whole numbers that count up by one.
    Counting,
    /// The name contains a word for another quantity.
    Word { word: String, said: &'static str },
    /// The name contains a unit of another quantity.
    Unit(String),
}

impl fmt::Display for Exclusion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Exclusion::Counting => f.write_str("counts up by one"),
            Exclusion::Word { word, said } => write!(f, "`{word}` means {said}"),
            Exclusion::Unit(unit) => write!(f, "another quantity by its unit `{unit}`"),
        }
    }
}

/// Words for quantities without a channel, with the quantity that they mean. The words are searched anywhere in a name.
const QUANTITIES: &[(&[&str], &str)] = &[
    (
        &[
            "acc",
            "accel",
            "acceleration",
            "accelerations",
            "accelerometer",
            "imu",
            "jerk",
        ],
        "an acceleration",
    ),
    (
        &["gyro", "gyroscope", "omega", "angular", "gyr"],
        "a rate of rotation",
    ),
    (
        &[
            "magnetic",
            "magnetometer",
            "magn",
            "field",
            "flux",
            "hall",
            "b",
            "bx",
            "by",
            "bz",
        ],
        "a magnetic field",
    ),
    (
        &[
            "vel",
            "velocity",
            "velocities",
            "speed",
            "twist",
            "v",
            "vx",
            "vy",
            "vz",
            "rate",
            "dot",
            "derivative",
        ],
        "a velocity or a rate",
    ),
    (
        &[
            "quat",
            "quaternion",
            "orientation",
            "rot",
            "rotation",
            "rpy",
            "euler",
            "roll",
            "pitch",
            "yaw",
            "angle",
            "angles",
        ],
        "an orientation",
    ),
    (
        &["joint", "joints", "motor", "servo", "encoder", "actuator"],
        "a joint or a motor",
    ),
    (
        &[
            "cmd",
            "command",
            "commanded",
            "target",
            "targets",
            "desired",
            "setpoint",
            "setpoints",
            "goal",
            "demand",
            "planned",
            "action",
            "sp",
        ],
        "commanded, not measured",
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
        "estimated, not measured",
    ),
    (
        &[
            "std",
            "stddev",
            "var",
            "variance",
            "cov",
            "covariance",
            "err",
            "error",
            "residual",
            "uncertainty",
            "sigma",
        ],
        "a deviation, not measured",
    ),
    (
        &["min", "max", "limit", "limits", "threshold", "thresh"],
        "the end of a range, not measured",
    ),
    (
        &["bias", "offset", "tare", "baseline", "gain", "stiffness"],
        "a setting, not measured",
    ),
    (
        &["valid", "ok", "flag", "status", "mask"],
        "a state, not measured",
    ),
    (
        &["magnitude", "norm", "abs", "mag"],
        "a magnitude without a direction",
    ),
    (
        &[
            "pixel", "pixels", "bbox", "screen", "cursor", "marker", "markers", "flow",
        ],
        "a place in a picture",
    ),
    (&["temp", "temperature", "voltage"], "another quantity"),
];

/// Words that exclude numbers whose name has no axis, with the quantity that they mean.
const WITHOUT_AXIS: &[(&[&str], &str)] = &[
    (
        &["total", "resultant", "sum", "rms"],
        "a magnitude without a direction",
    ),
    (
        &["shear", "tangential", "lateral", "friction", "radial"],
        "a force without an axis",
    ),
    (
        &[
            "frame", "frames", "counter", "cnt", "count", "counts", "idx", "index", "id", "seq",
            "sequence", "num", "number", "nr", "no", "step", "steps", "iter", "tick", "ticks",
            "image", "img", "row", "sample", "level",
        ],
        "a counter",
    ),
    (
        &[
            "time",
            "stamp",
            "timestamp",
            "duration",
            "freq",
            "frequency",
            "hz",
            "fps",
        ],
        "a time",
    ),
];

/// Finds the word that excludes a name from every channel.
pub(super) fn of_words(words: &[String], has_axis: bool) -> Option<Exclusion> {
    let tables = match has_axis {
        true => [QUANTITIES, &[]],
        false => [QUANTITIES, WITHOUT_AXIS],
    };
    words.iter().find_map(|word| {
        let mut known = tables.iter().flat_map(|table| table.iter());
        let (_, said) = known.find(|(known, _)| known.contains(&word.as_str()))?;
        Some(Exclusion::Word {
            word: word.clone(),
            said,
        })
    })
}

/// True for at least `least` whole numbers, each larger than the previous by one.
pub(super) fn is_counting(numbers: &[f64], least: usize) -> bool {
    numbers.len() >= least
        && numbers[0].fract() == 0.0
        && numbers
            .windows(2)
            .all(|pair| (pair[1] - pair[0]).total_cmp(&1.0).is_eq())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draft::roles::words::words;

    #[test]
    fn counters_magnitudes_and_other_quantities_are_known_by_a_word() {
        let of =
            |name: &str, has_axis| of_words(&words(name), has_axis).map(|found| found.to_string());
        for (name, said) in [
            ("acc_x", "an acceleration"),
            ("mag_x", "a magnitude"),
            ("B_z", "a magnetic field"),
            ("vel_x", "a velocity"),
            ("fz_cmd", "commanded"),
            ("FzDesired", "commanded"),
            ("fx_std", "a deviation"),
            ("fy_pred", "estimated"),
            ("force.z.max", "the end of a range"),
            ("fz_valid", "a state"),
            ("orientation.x", "an orientation"),
        ] {
            assert!(of(name, true).unwrap_or_default().contains(said), "{name}");
        }
        for name in ["force_frame", "force_count", "total_force", "force_index"] {
            assert!(of(name, false).is_some(), "{name}");
            assert!(of(name, true).is_none(), "{name}");
        }
        for name in ["fz_meas", "Fz", "force_z", "wrench.force.x", "contact_x"] {
            assert_eq!(of(name, true), None, "{name}");
        }
        assert!(is_counting(&[7.0, 8.0, 9.0, 10.0], 4));
        assert!(!is_counting(&[7.0, 8.0, 9.0], 4));
        assert!(!is_counting(&[7.0, 8.0, 10.0, 11.0], 4));
        assert!(!is_counting(&[0.5, 1.5, 2.5, 3.5], 4));
    }
}
