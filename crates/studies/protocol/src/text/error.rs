//! Errors of a scene or rig file: the problem, its line, and the accepted values.

use std::fmt;

use taceva_core::FrameInfo;

use crate::frame_size::FrameSize;
use crate::reason::PlanReason;

/// Error for which a scene or a rig file is rejected.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneError {
    /// Name of the wrong text, such as its file.
    pub source_name: String,
    /// Number of the wrong line, counted from 1; `None` if no single line is wrong.
    pub line: Option<u64>,
    /// Problem that was found.
    pub problem: Box<SceneProblem>,
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.source_name)?;
        if let Some(line) = self.line {
            write!(f, ", line {line}")?;
        }
        write!(f, ": {}", self.problem)
    }
}

impl std::error::Error for SceneError {}

/// Problems of a scene or rig file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SceneProblem {
    /// Invalid TOML, or a value of the wrong type.
    #[error("{0}")]
    Syntax(String),
    /// The text is too large.
    #[error("the scene has {bytes} bytes, expected at most {greatest}")]
    Size {
        /// Size of the text, in bytes.
        bytes: usize,
        /// Greatest accepted size, in bytes.
        greatest: usize,
    },
    /// An unknown key.
    #[error("`{key}`: unknown key{}; known here: {known}", did_you_mean(.nearest))]
    UnknownKey {
        /// Key as written.
        key: String,
        /// Most similar known key, if any is similar.
        nearest: Option<String>,
        /// All known keys of the table.
        known: String,
    },
    /// A required key is missing.
    #[error("the key `{0}` is missing")]
    MissingKey(String),
    /// The scene has an unknown version.
    #[error("scene version {0} is not supported, expected 1")]
    Version(u32),
    /// The rig file has an unknown version.
    #[error("rig version {0} is not supported, expected 1")]
    RigVersion(u32),
    /// A name is not among the known names.
    #[error("`{name}`: unknown {what}{}; known: {known}{}", did_you_mean(.nearest), found_where(.what, .name))]
    UnknownName {
        /// Kind of item: `driver of a sensor`, `metric`, `report format`.
        what: &'static str,
        /// Name as written.
        name: String,
        /// Most similar known name, if any is similar.
        nearest: Option<String>,
        /// All known names.
        known: String,
    },
    /// A name occurs twice.
    #[error("`{name}` is the name of two {what}: give each its own name", name = taceva_core::shown(name))]
    Twice {
        /// Kind of the named item, such as `units`.
        what: &'static str,
        /// The name.
        name: String,
    },
    /// A count is out of range.
    #[error("`{key}` is {found}, expected a whole number from {least} to {greatest}")]
    Count {
        /// Key of the count.
        key: &'static str,
        /// Value as written.
        found: u64,
        /// Least accepted value.
        least: u64,
        /// Greatest accepted value.
        greatest: u64,
    },
    /// A number is out of range.
    #[error("`{key}` is {found}, expected a number above {above} and up to {greatest}")]
    Range {
        /// Key of the number.
        key: &'static str,
        /// Value as written.
        found: f64,
        /// Exclusive lower bound of accepted values.
        above: f64,
        /// Greatest accepted value.
        greatest: f64,
    },
    /// The size of frames is invalid.
    #[error(
        "`frames` is `{found}`, expected WIDTHxHEIGHT in pixels, each a whole number from 1 to {}, such as \"64x48\"",
        FrameSize::SIDE_MAX
    )]
    FrameSize {
        /// Value as written.
        found: String,
    },
    /// The requested frame size exceeds the frame size of the sensor.
    #[error(
        "`frames` is `{found}`, but the frames of study `{study}` are {frame}: expected at most `{}x{}`, since frames can only be reduced",
        frame.width,
        frame.height
    )]
    FramesEnlarged {
        /// Value as written.
        found: FrameSize,
        /// Name of the study.
        study: String,
        /// Size and format of the frames of the study's sensor.
        frame: FrameInfo,
    },
    /// Stored frames would have fewer pixels than the grid of a model.
    #[error(
        "`frames` is `{found}`, but {who} divides each frame into {least_width}×{least_height} cells: expected at least `{least_width}x{least_height}`"
    )]
    FramesTooSmall {
        /// Value as written.
        found: FrameSize,
        /// Name of the model.
        who: String,
        /// Number of cells along x of the grid into which the model divides a frame.
        least_width: u32,
        /// Number of cells along y of the grid into which the model divides a frame.
        least_height: u32,
    },
    /// A limit in a scene or rig file exceeds that of the device, or that of an outer file or table.
    #[error("`{key}` is {found}, but {who} allows at most {limit}: limits may only be tightened")]
    LimitLoosened {
        /// Key of the limit.
        key: &'static str,
        /// Value as written.
        found: f64,
        /// Device or file with the tighter limit.
        who: String,
        /// Value of the tighter limit.
        limit: f64,
    },
    /// A length or force of the protocol exceeds a limit.
    #[error("`{key}` is {found}, beyond the limit `{limit_key}` = {limit} ({who})")]
    BeyondLimit {
        /// Key of the length or force.
        key: &'static str,
        /// Value as written.
        found: f64,
        /// Key of the limit.
        limit_key: &'static str,
        /// Value of the limit.
        limit: f64,
        /// Device or file that states the limit.
        who: String,
    },
    /// A required limit is missing.
    #[error("the limit `{key}` is missing: write it under [limits]; no robot moves without it")]
    LimitAbsent {
        /// Key of the limit.
        key: &'static str,
    },
    /// A requested board is not in the catalogue of boards.
    #[error("gratings of {found} mm are not in the catalogue: {catalogue}")]
    Grating {
        /// Spacing as written, in mm.
        found: f64,
        /// Range of the catalogue.
        catalogue: &'static str,
    },
    /// Devices use different clocks.
    #[error(
        "`{simulated}` uses simulated time and `{real}` uses the clock of this machine, but a rig has one clock. Choose both devices simulated or both real. A real sensor may be used with a simulated robot, and its recording is then `simulated`"
    )]
    MixedClocks {
        /// Name of the simulated device.
        simulated: String,
        /// Name of the real device.
        real: String,
    },
    /// A robot moves in its base frame, whose pose relative to the sensor is unknown.
    #[error(
        "the robot `{robot}` moves in its base frame, whose pose relative to the gel is unknown. Write a rig file with `origin_mm` and `axes` under [robot] and name it by `rig = \"lab.toml\"` or --rig (docs/rig.md)"
    )]
    Unmapped {
        /// Name of the robot.
        robot: String,
    },
    /// The robot of a rig file found no contact in its descent to the gel.
    #[error(
        "no contact down to {search_mm} mm below the height of `origin_mm`: correct `origin_mm` or `axes` of [robot], or check with a finger that the force transducer responds"
    )]
    NothingTouched {
        /// Depth of the search, in mm.
        search_mm: f64,
    },
    /// The measured forces contradict the axes in a rig file.
    #[error("`axes` of [force]: {felt}{}", mended(.expected, *.may_be_robot))]
    AxesContradicted {
        /// Text with the directions of the motions and of the measured forces.
        felt: String,
        /// Axes that would agree; `None` if no rotation by right angles agrees.
        expected: Option<String>,
        /// True if the axes of the robot may be wrong instead of those of the transducer.
        may_be_robot: bool,
    },
    /// A robot takes too long to come to rest after an exceeded limit.
    #[error(
        "`{robot}` needs {stop_ms} ms to stop, so it stops {needed_ms:.0} ms after a limit is exceeded: expected at most {greatest_ms:.0} ms"
    )]
    SlowStop {
        /// Name of the robot.
        robot: String,
        /// Stop time that the robot states, in ms.
        stop_ms: f64,
        /// Stop time plus the times for one reading of the transducer and one message, in ms.
        needed_ms: f64,
        /// Greatest allowed time, in ms.
        greatest_ms: f64,
    },
    /// In contact, the tip would travel too far before a reading counts as stale.
    #[error(
        "`speed_mm_s` is {found}, but {who} times out only after {stale_ms:.0} ms without a reading: expected at most {greatest:.3}"
    )]
    Blind {
        /// Speed as written, in mm/s.
        found: f64,
        /// Name of the transducer.
        who: String,
        /// Greatest age of a reading of the transducer, in ms.
        stale_ms: f64,
        /// Greatest allowed speed, in mm/s.
        greatest: f64,
    },
    /// A frozen signal of the force transducer cannot be detected.
    #[error(
        "a frozen signal of {who} cannot be detected: steps of {resolution_n} N, noise of {noise_n} N, readings without numbers; expected numbered readings, or steps below the noise"
    )]
    FrozenUnseen {
        /// Name of the transducer.
        who: String,
        /// Resolution of the transducer, in N.
        resolution_n: f64,
        /// Noise of the transducer at rest: one standard deviation, in N.
        noise_n: f64,
    },
    /// Statements of a scene, a rig file or a device contradict each other.
    #[error("{0}")]
    Contradiction(String),
    /// The scene has nothing to measure.
    #[error("{0}")]
    Incomplete(String),
    /// A metric requested by name applies to no study of the scene.
    #[error("`{metric}` can never apply: {reason}", metric = taceva_core::shown(metric))]
    NeverApplies {
        /// Name of the metric.
        metric: String,
        /// Reason why the metric does not apply.
        reason: PlanReason,
    },
    /// The plan has too many presses.
    #[error("the plan has {found} presses, expected at most {greatest}")]
    TooManyPresses {
        /// Number of presses.
        found: u64,
        /// Greatest accepted number of presses.
        greatest: u64,
    },
}

fn mended(expected: &Option<String>, may_be_robot: bool) -> String {
    let force = expected.as_ref().map_or_else(
        || {
            "no rotation by right angles explains this: check how the transducer is mounted"
                .to_owned()
        },
        |expected| format!("write axes = {expected}"),
    );
    match may_be_robot {
        true => {
            format!("; if the tip moved as commanded, {force}; otherwise correct `axes` of [robot]")
        }
        false => format!("; {force}"),
    }
}

fn did_you_mean(nearest: &Option<String>) -> String {
    nearest.as_ref().map_or_else(String::new, |nearest| {
        format!(", did you mean `{nearest}`?")
    })
}

/// Hint for an unknown driver of a plugin, whose name `ID/KEY` has dots in the id; empty for other names.
fn found_where(what: &str, name: &str) -> &'static str {
    let is_of_plugin = name.split_once('/').is_some_and(|(id, _)| id.contains('.'));
    if what.starts_with("driver of") && is_of_plugin {
        "; plugins are loaded from the folder of `taceva plugin install` and from `--plugin-dir`"
    } else {
        ""
    }
}
