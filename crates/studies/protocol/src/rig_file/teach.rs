//! Registration of a robot, computed from three places to which an operator jogs it.

use taceva_core::{Point, Pose};

use super::{Carried, RigFile, SignedAxes};

/// Least distance of a jog that defines a direction, in mm. A jog is a motion of the robot by hand controls.
const SHORTEST_MM: f64 = 5.0;
/// Greatest distance between the end of a jog and the axis of the base that it follows, in mm.
const RESIDUAL_MM: f64 = 0.5;
/// Greatest rotation of the tool between two places, in degrees.
const TURN_DEG: f64 = 0.5;

/// Poses of a robot in its base frame with the tip at three places of the gel.
///
/// ```
/// use taceva_core::{Millimetre, Pose};
/// use taceva_protocol::{Carried, Jogged};
/// let at = |x: f64, y: f64| {
///     let mut pose = Pose::default();
///     (pose.position.x, pose.position.y) = (Millimetre(x), Millimetre(y));
///     pose
/// };
/// let jogged = Jogged { middle: at(300.0, 0.0), along_x: at(310.0, 0.1), along_y: at(300.0, -8.0) };
/// let taught = jogged.taught(Carried::Indenter)?;
/// assert_eq!(taught.axes.to_string(), r#"["x", "-y", "-z"]"#);
/// # Ok::<(), taceva_protocol::TeachError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jogged {
    /// Pose while the tip just touches the middle of the gel.
    pub middle: Pose,
    /// Pose after a jog from the middle along x of the sensor.
    pub along_x: Pose,
    /// Pose after a jog from the middle along y of the sensor.
    pub along_y: Pose,
}

/// Origin and axes of a robot, computed from three jogged places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taught {
    /// `origin_mm` of the rig file.
    pub origin_mm: [f64; 3],
    /// `axes` of the robot in the rig file.
    pub axes: SignedAxes,
    /// Distance between the end of a jog and the base axis that it follows, in mm: the greater of both jogs.
    pub residual_mm: f64,
}

/// Reasons why three jogged places define no origin and axes.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum TeachError {
    /// The jog is too short.
    #[error(
        "the jog along {axis} is {way_mm:.2} mm long, expected at least {SHORTEST_MM} mm: jog farther"
    )]
    Short {
        /// Axis of the sensor along which the jog was made.
        axis: char,
        /// Length of the jog, in mm.
        way_mm: f64,
    },
    /// The jog follows no axis of the base.
    #[error(
        "the jog along {axis} ends {residual_mm:.2} mm off the nearest axis of the base, expected at most {RESIDUAL_MM} mm: turn the sensor parallel to the base, or jog along one axis of the base only"
    )]
    Askew {
        /// Axis of the sensor along which the jog was made.
        axis: char,
        /// Distance of the end of the jog from the nearest axis of the base, in mm.
        residual_mm: f64,
    },
    /// Both jogs follow the same axis.
    #[error(
        "both jogs follow one axis of the base, which defines no frame: jog along x of the sensor first, then from the middle along y"
    )]
    OneLine,
    /// The tool was rotated during a jog.
    #[error(
        "the tool rotated by {turn_deg:.1} degrees during the jog along {axis}: jog without rotating it"
    )]
    Turned {
        /// Axis of the sensor along which the jog was made.
        axis: char,
        /// Rotation of the tool, in degrees.
        turn_deg: f64,
    },
}

impl Jogged {
    /// Checks the jog along x before the robot is jogged along y.
    ///
    /// # Errors
    /// [`TeachError`] if the jog is too short, not along an axis, or rotated.
    pub fn check_x(middle: &Pose, along_x: &Pose) -> Result<(), TeachError> {
        way(middle, along_x, 'x').map(drop)
    }

    /// Computes origin and axes of the rig file for a robot that moves `carries`.
    ///
    /// # Errors
    /// [`TeachError`] if a jog is shorter than 5 mm, or ends more than 0.5 mm off the axes of the base. Also if the tool was rotated, or both jogs
    /// follow the same axis.
    pub fn taught(&self, carries: Carried) -> Result<Taught, TeachError> {
        let (x, beside_x) = way(&self.middle, &self.along_x, 'x')?;
        let (y, beside_y) = way(&self.middle, &self.along_y, 'y')?;
        let side = match carries {
            Carried::Indenter => 1.0,
            // The tip moves along the sensor in the opposite direction.
            Carried::Sensor => -1.0,
        };
        let (x, y) = ((x.0, side * x.1), (y.0, side * y.1));
        let z = match (3 + y.0 - x.0) % 3 {
            1 => ((x.0 + 2) % 3, x.1 * y.1),
            2 => ((x.0 + 1) % 3, -x.1 * y.1),
            _ => return Err(TeachError::OneLine),
        };
        let word = |(axis, sign): (usize, f64)| {
            let sign = if sign < 0.0 { "-" } else { "" };
            format!("{sign}{}", ["x", "y", "z"][axis])
        };
        let axes = SignedAxes::read([x, y, z].map(word));
        let Point { x, y, z } = self.middle.position;
        Ok(Taught {
            // Whole micrometres, which is finer than the accuracy of any arm.
            origin_mm: [x.0, y.0, z.0].map(|side| (side * 1e3).round() / 1e3),
            axes: axes.expect("the third axis is at right angles to the first two"),
            residual_mm: beside_x.max(beside_y),
        })
    }
}

/// Axis of the base that the jog from `from` to `to` follows, with the sign. Also the distance in mm between the end of the jog and that axis.
fn way(from: &Pose, to: &Pose, axis: char) -> Result<((usize, f64), f64), TeachError> {
    let (one, other) = (&from.position, &to.position);
    let way = [
        other.x.0 - one.x.0,
        other.y.0 - one.y.0,
        other.z.0 - one.z.0,
    ];
    let (one, other) = (&from.rotation, &to.rotation);
    let turns = [
        other.x.0 - one.x.0,
        other.y.0 - one.y.0,
        other.z.0 - one.z.0,
    ];
    let whole = |turn: f64| (turn - 360.0 * (turn / 360.0).round()).abs();
    let turn_deg = turns.map(whole).into_iter().fold(0.0, f64::max);
    if turn_deg > TURN_DEG {
        return Err(TeachError::Turned { axis, turn_deg });
    }
    let way_mm = way.iter().map(|side| side * side).sum::<f64>().sqrt();
    // NaN is rejected too.
    if way_mm.is_nan() || way_mm < SHORTEST_MM {
        return Err(TeachError::Short { axis, way_mm });
    }
    let longest = (0..3).max_by(|one, other| way[*one].abs().total_cmp(&way[*other].abs()));
    let longest = longest.expect("there are three");
    let others = (0..3).filter(|side| *side != longest);
    let residual_mm = others.map(|side| way[side].powi(2)).sum::<f64>().sqrt();
    if residual_mm > RESIDUAL_MM {
        return Err(TeachError::Askew { axis, residual_mm });
    }
    Ok(((longest, way[longest].signum()), residual_mm))
}

impl RigFile {
    /// Returns the text of the file with the origin and axes of `taught` written into it. `None` if the file has no robot.
    pub fn with_taught(&self, taught: &Taught) -> Option<String> {
        let robot = self.robot.as_ref()?;
        let text = self.text.whole();
        let [x, y, z] = taught.origin_mm;
        let mut written = [
            (robot.origin_mm.at()?, format!("[{x:?}, {y:?}, {z:?}]")),
            (robot.axes.at()?, taught.axes.to_string()),
        ];
        // Edits the last position first, so that earlier byte offsets stay valid.
        written.sort_by_key(|(at, _)| std::cmp::Reverse(*at));
        let mut text = text.to_owned();
        for (at, value) in written {
            // An array of numbers or axis names contains no other bracket, except in comments.
            let end = at + end_of_array(text.get(at..)?)?;
            text.replace_range(at..end, &value);
        }
        Some(text)
    }
}

/// Byte offset after the array at the start of `text`; `None` if the array has no end.
fn end_of_array(text: &str) -> Option<usize> {
    let mut is_comment = false;
    for (at, letter) in text.char_indices() {
        match letter {
            '#' => is_comment = true,
            '\n' => is_comment = false,
            ']' if !is_comment => return Some(at + 1),
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use taceva_core::Millimetre;

    use super::*;
    use crate::rig_file::Registration;

    fn at([x, y, z]: [f64; 3]) -> Pose {
        let [x, y, z] = [x, y, z].map(Millimetre);
        Pose {
            position: Point { x, y, z },
            ..Pose::default()
        }
    }

    const TEXT: &str = "rig_version = 1\n[robot]\ndriver = \"lab/arm\"\ncarries = \"indenter\"\norigin_mm = [ # x ]\n  0.0, 0.0, 0.0] # old\naxes = [\"x\", \"y\", \"z\"]\n[limits]\nspeed_max_mm_s = 20.0\n";

    #[test]
    fn of_every_way_to_stand_three_places_find_the_axes_and_the_file_that_is_written_maps_them_back()
     {
        let words = ["x", "y", "z", "-x", "-y", "-z"];
        for carries in ["indenter", "sensor"] {
            let text = TEXT.replacen("\"indenter\"", &format!("\"{carries}\""), 1);
            let mut found = 0;
            for x in words {
                for y in words {
                    for z in words {
                        let Ok(axes) = SignedAxes::read([x, y, z]) else {
                            continue;
                        };
                        let stands = text
                            .replacen("[ # x ]\n  0.0, 0.0, 0.0]", "[300.0, -20.0, 251.25]", 1)
                            .replacen("[\"x\", \"y\", \"z\"]", &axes.to_string(), 1);
                        let stands = RigFile::parse("true.toml", &stands).expect("a rig");
                        let robot = stands.robot.as_ref().expect("a robot");
                        let truth = Registration::new(robot, Default::default());
                        let base = |tip: [f64; 3]| truth.to_base(&at(tip));
                        let jogged = Jogged {
                            middle: base([0.0; 3]),
                            along_x: base([8.0, 0.1, -0.2]),
                            along_y: base([0.3, 9.0, 0.1]),
                        };
                        let taught = jogged.taught(robot.carries).expect("a frame");
                        assert_eq!(taught.axes, axes, "{carries}");
                        assert!((taught.residual_mm - 0.1_f64.hypot(0.3)).abs() < 1e-6);
                        let old = RigFile::parse("lab.toml", &text).expect("a rig");
                        let new = old.with_taught(&taught).expect("a robot");
                        assert!(new.contains("[300.0, -20.0, 251.25] # old\n"), "{new}");
                        let new = RigFile::parse("lab.toml", &new).expect("a rig");
                        assert_eq!(new.robot, stands.robot);
                        assert_eq!(new.limits, stands.limits);
                        found += 1;
                    }
                }
            }
            assert_eq!(found, 24);
        }
    }

    #[test]
    fn ways_that_are_short_askew_turned_or_one_line_are_refused_with_what_is_to_be_done() {
        let jogged = |along_x: [f64; 3], along_y: [f64; 3]| Jogged {
            middle: at([0.0; 3]),
            along_x: at(along_x),
            along_y: at(along_y),
        };
        let refused = |jogged: Jogged| jogged.taught(Carried::Indenter).expect_err("no frame");
        let short = refused(jogged([4.9, 0.0, 0.0], [0.0, 9.0, 0.0]));
        assert!(short.to_string().contains("jog farther"), "{short}");
        let askew = refused(jogged([9.0, 0.0, 0.0], [0.4, 9.0, 0.4]));
        assert_eq!(
            askew.to_string().split(" mm").next(),
            Some("the jog along y ends 0.57")
        );
        assert_eq!(
            refused(jogged([9.0, 0.0, 0.0], [-9.0, 0.0, 0.0])),
            TeachError::OneLine
        );
        let nowhere = refused(jogged([f64::NAN, 0.0, 0.0], [0.0, 9.0, 0.0]));
        assert!(matches!(nowhere, TeachError::Short { axis: 'x', .. }));
        let mut turned = jogged([9.0, 0.0, 0.0], [0.0, 9.0, 0.0]);
        turned.along_y.rotation.z.0 = 359.0;
        assert!(matches!(
            refused(turned),
            TeachError::Turned { axis: 'y', .. }
        ));
    }
}
