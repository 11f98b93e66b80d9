//! Arguments for the speed limit, stopping and repeatability of a robot. Its protocol does not report them.

use taceva_core::{ArgSpec, ArgValue, Args, Millimetre, RobotFacts, Speed, SpeedError};

use super::{fact, optional_number};

/// Argument for the speed limit of a robot, mm/s. `least` is its minimum, `usual` its default.
pub(crate) fn speed_limit(least: f64, usual: f64) -> ArgSpec {
    ArgSpec::number(SPEED_MAX, least, SPEED_LIMIT_MM_S)
        .default(ArgValue::Number(usual))
        .help("maximum speed of the tip, mm/s")
        .changes_facts()
}

/// Speed limit from an argument of [`speed_limit`].
///
/// # Errors
/// [`SpeedError`] for an invalid speed. The range of the argument excludes invalid speeds.
pub(crate) fn speed_max(args: &Args) -> Result<Speed, SpeedError> {
    Speed::try_new(args.number(SPEED_MAX))
}

/// Arguments for the stopping time, ms, and the repeatability, mm. No robot protocol reports them.
pub(crate) fn robot_facts() -> [ArgSpec; 2] {
    [
        fact(
            STOP,
            [0.0, 2_000.0],
            "time from receiving a halt to standstill, ms, as measured",
        ),
        fact(
            REPEATABILITY,
            [1e-4, 10.0],
            "repeatability of a pose, mm: one standard deviation per axis, from its data sheet or as measured",
        ),
    ]
}

/// Argument for the deceleration after a halt, mm/s², for robots whose driver cannot set the deceleration.
#[cfg(any(feature = "gcode", feature = "xarm"))]
pub(crate) fn deceleration() -> ArgSpec {
    fact(
        DECELERATION,
        [1.0, 100_000.0],
        "deceleration after a halt, mm/s², as measured",
    )
}

/// Robot facts from the arguments of [`speed_limit`], [`robot_facts`] and `deceleration_mm_s2`.
pub(crate) fn facts_of_robot(args: &Args) -> RobotFacts {
    // Every robot of a rig reports poses in its base frame.
    let mut facts = RobotFacts::default().with_base_frame(true);
    facts.speed_max = speed_max(args).ok();
    facts.deceleration_mm_s2 = optional_number(args, DECELERATION);
    facts.stop_ms = optional_number(args, STOP);
    facts.repeatability = optional_number(args, REPEATABILITY).map(Millimetre);
    facts
}

const SPEED_MAX: &str = "speed_max_mm_s";
/// Largest speed limit that the argument accepts, mm/s: the reduced speed of industrial arms near people.
const SPEED_LIMIT_MM_S: f64 = 250.0;
const DECELERATION: &str = "deceleration_mm_s2";
const STOP: &str = "stop_ms";
const REPEATABILITY: &str = "repeatability_mm";
