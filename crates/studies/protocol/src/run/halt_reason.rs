//! Reasons why the supervisor halts the robot.

use std::fmt;

use taceva_core::Limit;

/// Reasons why the supervisor halts the robot.
///
/// # Units
/// mm, N, N/s and s.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Trip {
    /// The depth exceeds its limit.
    Depth {
        /// Depth below the depth zero of the press.
        depth_mm: f64,
        /// Greatest allowed depth.
        limit_mm: f64,
    },
    /// The normal force exceeds its limit, whether the tip presses or pulls.
    NormalForce {
        /// Normal force.
        force_n: f64,
        /// Greatest allowed normal force.
        limit_n: f64,
    },
    /// The shear force exceeds its limit.
    ShearForce {
        /// Magnitude of the shear force.
        force_n: f64,
        /// Greatest allowed shear force.
        limit_n: f64,
    },
    /// A force is measured while the tip is out of contact.
    UnexpectedContact {
        /// Force measured out of contact.
        force_n: f64,
        /// True if the force exceeds the threshold for motions through the air. False if it exceeds the limit of a retreat.
        is_in_air: bool,
    },
    /// The force increases faster than any gel allows.
    ForceRate {
        /// Rate of the force.
        rate_n_s: f64,
    },
    /// The transducer is saturated, so the true force is unknown.
    Saturated {
        /// Force of the saturated reading.
        force_n: f64,
    },
    /// A reading of force or pose is NaN or infinite.
    NotFinite,
    /// Force readings are bit-equal although the tip has moved.
    Frozen {
        /// Number of equal force readings in a row.
        readings: u32,
    },
    /// The last force is too old.
    StaleForce {
        /// Age of the force.
        age_s: f64,
    },
    /// The last pose is too old.
    StalePose {
        /// Age of the pose.
        age_s: f64,
    },
    /// The enabling switch is not held.
    Released,
    /// The enabling switch can no longer be read.
    SwitchLost,
    /// The tip is not at its target.
    Diverged {
        /// Distance from the target.
        distance_mm: f64,
    },
}

impl Trip {
    /// Limit of the gel that the tip reached with healthy signals; `None` for other reasons. Such a limit ends the press, not the run.
    pub fn limit(self) -> Option<Limit> {
        match self {
            Trip::Depth { .. } => Some(Limit::Depth),
            Trip::NormalForce { .. } => Some(Limit::NormalForce),
            Trip::ShearForce { .. } => Some(Limit::ShearForce),
            _ => None,
        }
    }
}

impl fmt::Display for Trip {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Trip::Depth { depth_mm, limit_mm } => {
                write!(
                    f,
                    "the depth of {depth_mm:.3} mm exceeds the limit of {limit_mm} mm"
                )
            }
            Trip::NormalForce { force_n, limit_n } => {
                write!(
                    f,
                    "the normal force of {force_n:.3} N exceeds the limit of {limit_n} N"
                )
            }
            Trip::ShearForce { force_n, limit_n } => {
                write!(
                    f,
                    "the shear force of {force_n:.3} N exceeds the limit of {limit_n} N"
                )
            }
            Trip::UnexpectedContact {
                force_n,
                is_in_air: true,
            } => {
                write!(
                    f,
                    "a force of {force_n:.3} N where no contact is expected. If nothing touches the tip, write a greater `threshold_N` under [protocol.contact] of the scene, above 5 times the noise that `taceva rig check` prints, and start a new run"
                )
            }
            Trip::UnexpectedContact {
                force_n,
                is_in_air: false,
            } => {
                write!(
                    f,
                    "a force of {force_n:.3} N beyond the limit of the normal force, while the tip leaves the gel or before the force is zeroed"
                )
            }
            Trip::ForceRate { rate_n_s } => {
                write!(
                    f,
                    "the force changes by {rate_n_s:.0} N/s, faster than a gel can cause"
                )
            }
            Trip::Saturated { force_n } => {
                write!(f, "the force transducer is saturated at {force_n:.3} N: press with less force")
            }
            Trip::NotFinite => f.write_str("a force reading is not a finite number: check the transducer and its driver"),
            Trip::Frozen { readings } => {
                write!(
                    f,
                    "{readings} equal force readings while the tip moved: the signal is frozen; if the steps of the transducer are coarse, state them as `resolution_n` in its selector"
                )
            }
            Trip::StaleForce { age_s } => write!(
                f,
                "the last force reading is {:.0} ms old. On a busy machine, stop other programs, and run with `chrt -f 10 taceva run …` if you do not yet. A device with its own clock appears late on any machine",
                age_s * 1e3
            ),
            Trip::StalePose { age_s } => write!(
                f,
                "the last pose reading is {:.0} ms old. On a busy machine, stop other programs, and run with `chrt -f 10 taceva run …` if you do not yet. A device with its own clock appears late on any machine",
                age_s * 1e3
            ),
            Trip::Released => f.write_str("the enabling switch was released"),
            Trip::SwitchLost => f.write_str(
                "the enabling switch can no longer be read: plug it in, and continue with `--resume`",
            ),
            Trip::Diverged { distance_mm } => {
                write!(f, "the tip is {distance_mm:.3} mm from its commanded position")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reading_that_is_too_old_names_what_helps_on_a_busy_machine() {
        let age_s = 0.084;
        for (trip, signal) in [
            (Trip::StaleForce { age_s }, "force"),
            (Trip::StalePose { age_s }, "pose"),
        ] {
            let said = trip.to_string();
            let expected = format!(
                "the last {signal} reading is 84 ms old. On a busy machine, stop other programs, and run with `chrt -f 10 taceva run …` if you do not yet"
            );
            assert!(said.starts_with(&expected), "{said}");
        }
    }

    #[test]
    fn a_force_in_the_air_names_the_key_that_separates_it_from_noise() {
        let said = |force_n, is_in_air| Trip::UnexpectedContact { force_n, is_in_air }.to_string();
        let in_air = said(-0.023, true);
        assert!(
            in_air.starts_with("a force of -0.023 N where no contact"),
            "{in_air}"
        );
        assert!(
            in_air.contains("`threshold_N` under [protocol.contact]"),
            "{in_air}"
        );
        // The threshold does not limit a force on the way out of the gel.
        assert!(!said(2.1, false).contains("threshold_N"));
    }

    #[test]
    fn depth_and_both_forces_are_limits_of_the_gel_and_nothing_else_is() {
        let (limit_n, force_n, age_s) = (1.0, 2.0, 0.1);
        for (trip, limit) in [
            (
                Trip::Depth {
                    depth_mm: 2.0,
                    limit_mm: 1.0,
                },
                Some(Limit::Depth),
            ),
            (
                Trip::NormalForce { force_n, limit_n },
                Some(Limit::NormalForce),
            ),
            (
                Trip::ShearForce { force_n, limit_n },
                Some(Limit::ShearForce),
            ),
            (
                Trip::UnexpectedContact {
                    force_n,
                    is_in_air: true,
                },
                None,
            ),
            (Trip::ForceRate { rate_n_s: 300.0 }, None),
            (Trip::Saturated { force_n }, None),
            (Trip::NotFinite, None),
            (Trip::Frozen { readings: 8 }, None),
            (Trip::StaleForce { age_s }, None),
            (Trip::StalePose { age_s }, None),
            (Trip::Released, None),
            (Trip::SwitchLost, None),
            (Trip::Diverged { distance_mm: 1.0 }, None),
        ] {
            assert_eq!(trip.limit(), limit, "{trip}");
        }
    }
}
