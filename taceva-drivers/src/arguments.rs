//! What arguments of several drivers have in common.

use taceva_core::{ArgSpec, ArgValue, Args};
#[cfg(any(feature = "hid", feature = "netft", feature = "sri"))]
use taceva_core::{ForceFacts, Newton};
#[cfg(any(feature = "gcode", feature = "ur", feature = "xarm"))]
use taceva_core::{Millimetre, RobotFacts, Speed, SpeedError};

/// A port of a network, `usual` where nobody says otherwise.
#[cfg(feature = "tcp")]
pub(crate) fn port(key: &str, usual: i64, help: &str) -> ArgSpec {
    ArgSpec::whole(key, 1, 65_535)
        .default(ArgValue::Whole(usual))
        .help(help)
}

/// The port that an argument of [`port`] gives.
#[cfg(feature = "tcp")]
pub(crate) fn port_of(args: &Args, key: &str) -> u16 {
    // Its range was checked.
    u16::try_from(args.whole(key)).unwrap_or(0)
}

/// The number that an optional argument gives, if it was given.
#[cfg(any(
    feature = "camera",
    feature = "hid",
    feature = "netft",
    feature = "sri"
))]
pub(crate) fn optional_number(args: &Args, key: &str) -> Option<f64> {
    args.get(key).and_then(ArgValue::as_number)
}

/// The greatest speed that may be asked of a robot, at least `least` and `usual` where nobody says otherwise, in mm/s.
#[cfg(any(feature = "gcode", feature = "ur", feature = "xarm"))]
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
#[cfg(any(feature = "gcode", feature = "ur", feature = "xarm"))]
pub(crate) fn speed_max(args: &Args) -> Result<Speed, SpeedError> {
    Speed::try_new(args.number(SPEED_MAX))
}

#[cfg(any(feature = "gcode", feature = "ur", feature = "xarm"))]
const SPEED_MAX: &str = "speed_max_mm_s";
/// No tip is moved faster: what people beside it are taken to bear of an arm at reduced speed.
#[cfg(any(feature = "gcode", feature = "ur", feature = "xarm"))]
const SPEED_LIMIT_MM_S: f64 = 250.0;

/// A fact of a device that no protocol tells: from a data sheet or a measurement, and unknown where nobody says it.
#[cfg(any(
    feature = "gcode",
    feature = "hid",
    feature = "netft",
    feature = "sri",
    feature = "ur",
    feature = "xarm"
))]
fn fact(key: &str, [least, most]: [f64; 2], help: &str) -> ArgSpec {
    ArgSpec::number(key, least, most)
        .optional()
        .help(help)
        .changes_facts()
}

/// Facts of a robot that its protocol does not tell.
#[cfg(any(feature = "gcode", feature = "ur", feature = "xarm"))]
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

/// How fast a robot slows down, where its driver does not tell it.
#[cfg(any(feature = "gcode", feature = "xarm"))]
pub(crate) fn deceleration() -> ArgSpec {
    fact(
        DECELERATION,
        [1.0, 100_000.0],
        "how fast it slows down when it is halted, in mm/s², as it was measured",
    )
}

/// The facts that arguments of [`robot_facts`], [`deceleration`] and [`speed_limit`] give.
#[cfg(any(feature = "gcode", feature = "ur", feature = "xarm"))]
pub(crate) fn facts_of_robot(args: &Args) -> RobotFacts {
    let mut facts = RobotFacts::default();
    facts.speed_max = speed_max(args).ok();
    facts.deceleration_mm_s2 = optional_number(args, DECELERATION);
    facts.stop_ms = optional_number(args, STOP);
    facts.repeatability = optional_number(args, REPEATABILITY).map(Millimetre);
    facts
}

/// Facts of a force transducer that its protocol does not tell.
#[cfg(any(feature = "hid", feature = "netft", feature = "sri"))]
pub(crate) fn force_facts() -> [ArgSpec; 3] {
    [
        fact(
            FORCE_MAX,
            [0.001, 100_000.0],
            "the least of the ranges of its forces, in N, from its certificate",
        ),
        fact(
            RESOLUTION,
            [1e-9, 1_000.0],
            "the step between two neighbouring readings of a force, in N",
        ),
        fact(
            NOISE,
            [1e-9, 1_000.0],
            "how far readings of a load that rests scatter, in N: one standard deviation, as it was measured",
        ),
    ]
}

/// The facts that arguments of [`force_facts`] give.
#[cfg(any(feature = "hid", feature = "netft", feature = "sri"))]
pub(crate) fn add_facts_of_force(args: &Args, facts: &mut ForceFacts) {
    let force = |key| optional_number(args, key).map(Newton);
    facts.force_max = force(FORCE_MAX);
    facts.resolution = force(RESOLUTION);
    facts.noise = force(NOISE);
}

#[cfg(any(feature = "gcode", feature = "ur", feature = "xarm"))]
const DECELERATION: &str = "deceleration_mm_s2";
#[cfg(any(feature = "gcode", feature = "ur", feature = "xarm"))]
const STOP: &str = "stop_ms";
#[cfg(any(feature = "gcode", feature = "ur", feature = "xarm"))]
const REPEATABILITY: &str = "repeatability_mm";
#[cfg(any(feature = "hid", feature = "netft", feature = "sri"))]
pub(crate) const FORCE_MAX: &str = "force_max_n";
#[cfg(any(feature = "hid", feature = "netft", feature = "sri"))]
const RESOLUTION: &str = "resolution_n";
#[cfg(any(feature = "hid", feature = "netft", feature = "sri"))]
const NOISE: &str = "noise_n";
