//! Arguments for how fast a robot may move, how it stops and how well it repeats, which its protocol does not state.

use taceva_core::{ArgSpec, ArgValue, Args, Millimetre, RobotFacts, Speed, SpeedError};

use super::{fact, optional_number};

/// The greatest speed that may be asked of a robot, at least `least` and `usual` where nobody says otherwise, in mm/s.
pub(crate) fn speed_limit(least: f64, usual: f64) -> ArgSpec {
    ArgSpec::number(SPEED_MAX, least, SPEED_LIMIT_MM_S)
        .default(ArgValue::Number(usual))
        .help("the greatest speed of the tip, in mm/s")
        .changes_facts()
}

/// The speed that an argument of [`speed_limit`] gives.
///
/// # Errors
/// [`SpeedError`] where it is none, which its range rules out.
pub(crate) fn speed_max(args: &Args) -> Result<Speed, SpeedError> {
    Speed::try_new(args.number(SPEED_MAX))
}

/// Facts that no protocol of a robot tells.
pub(crate) fn robot_facts() -> [ArgSpec; 2] {
    [
        fact(
            STOP,
            [0.0, 2_000.0],
            "how long it moves on after a halt has reached it, in ms, as it was measured",
        ),
        fact(
            REPEATABILITY,
            [1e-4, 10.0],
            "how well it comes back to a pose, in mm: one standard deviation an axis, from its data sheet or measured",
        ),
    ]
}

/// How fast a robot slows down, where its driver does not ask it for that.
#[cfg(any(feature = "gcode", feature = "xarm"))]
pub(crate) fn deceleration() -> ArgSpec {
    fact(
        DECELERATION,
        [1.0, 100_000.0],
        "how fast it slows down when it is halted, in mm/s², as it was measured",
    )
}

/// The facts that arguments of [`speed_limit`], [`robot_facts`] and `deceleration_mm_s2` give.
pub(crate) fn facts_of_robot(args: &Args) -> RobotFacts {
    // No robot of a rig moves in the frame of a sensor.
    let mut facts = RobotFacts::default().with_base_frame(true);
    facts.speed_max = speed_max(args).ok();
    facts.deceleration_mm_s2 = optional_number(args, DECELERATION);
    facts.stop_ms = optional_number(args, STOP);
    facts.repeatability = optional_number(args, REPEATABILITY).map(Millimetre);
    facts
}

const SPEED_MAX: &str = "speed_max_mm_s";
/// The greatest speed that a robot may be asked for, in mm/s: that of industrial arms at reduced speed beside people.
const SPEED_LIMIT_MM_S: f64 = 250.0;
const DECELERATION: &str = "deceleration_mm_s2";
const STOP: &str = "stop_ms";
const REPEATABILITY: &str = "repeatability_mm";
