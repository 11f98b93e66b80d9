//! Encoding of straight motions in commands.

use crate::placement::Placement;

/// Requested motion of the tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Line {
    /// x, y, z in mm, and roll, pitch, yaw or a rotation vector in rad; infinite for an unchanged coordinate.
    pub(super) pose: [f32; 6],
    pub(super) speed_mm_s: f32,
    pub(super) reference: Reference,
    /// True if the rotation is a rotation vector.
    pub(super) has_rotation_vector: bool,
    /// True if the motion is only checked.
    pub(super) is_only_checked: bool,
}

/// Meaning of the pose of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reference {
    /// A pose in the base frame.
    Base,
    /// A change of the pose along and about the axes of the base frame.
    Difference,
    /// A change of the pose in the frame of the tool.
    Tool,
}

/// Length of nine values, as in motions before firmware 1.11.100, bytes.
const OLD_BYTES: usize = 36;
/// Length of the ten numbers of a motion, bytes. Three bytes with switches follow.
const LONG_BYTES: usize = 40;
/// Length of the eleven numbers of a relative motion, bytes. Two bytes follow: a switch for joints, and a switch for rotation vectors.
pub(super) const DIFFERENCE_BYTES: usize = 44;

impl Line {
    /// Parses the motion in the parameters of register 21; `None` if their length matches no layout.
    pub(super) fn absolute(parameters: &[u8], takes_long_lines: bool) -> Option<Line> {
        if !takes_long_lines {
            return Line::old(parameters, Reference::Base);
        }
        let (values, &[frame, has_rotation_vector, is_only_checked]) =
            parameters.split_at_checked(LONG_BYTES)?
        else {
            return None;
        };
        Some(Line {
            pose: std::array::from_fn(|index| number(values, index)),
            speed_mm_s: number(values, 6),
            reference: match frame {
                0 => Reference::Base,
                _ => Reference::Tool,
            },
            has_rotation_vector: has_rotation_vector != 0,
            is_only_checked: is_only_checked != 0,
        })
    }

    /// Parses a motion in the tool frame from the parameters of register 28, which new clients do not use.
    pub(super) fn in_tool(parameters: &[u8]) -> Option<Line> {
        Line::old(parameters, Reference::Tool)
    }

    fn old(parameters: &[u8], reference: Reference) -> Option<Line> {
        let (values, switches) = parameters.split_at_checked(OLD_BYTES)?;
        if switches.len() > 1 {
            return None;
        }
        Some(Line {
            pose: std::array::from_fn(|index| number(values, index)),
            speed_mm_s: number(values, 6),
            reference,
            has_rotation_vector: false,
            is_only_checked: switches.first().is_some_and(|switch| *switch != 0),
        })
    }

    /// Parses a motion with a rotation vector from the parameters of register 92, which new clients do not use.
    pub(super) fn by_rotation_vector(parameters: &[u8]) -> Option<Line> {
        let (values, &[in_tool, is_difference, ref checked @ ..]) =
            parameters.split_at_checked(OLD_BYTES)?
        else {
            return None;
        };
        let line = Line::old(&[values, checked].concat(), Reference::Base)?;
        Some(Line {
            reference: match [in_tool, is_difference] {
                [0, 0] => Reference::Base,
                [0, _] => Reference::Difference,
                _ => Reference::Tool,
            },
            has_rotation_vector: true,
            ..line
        })
    }

    /// Parses the relative motion in the parameters of register 83; `None` if they describe a change of the joints.
    pub(super) fn relative(parameters: &[u8]) -> Option<Line> {
        let (values, &[0, has_rotation_vector, ref checked @ ..]) =
            parameters.split_at_checked(DIFFERENCE_BYTES)?
        else {
            return None;
        };
        Some(Line {
            pose: std::array::from_fn(|index| number(values, index)),
            speed_mm_s: number(values, 7),
            reference: Reference::Difference,
            has_rotation_vector: has_rotation_vector != 0,
            is_only_checked: checked.first().is_some_and(|switch| *switch != 0),
        })
    }

    /// Target pose of the motion if it begins at the pose `at`.
    pub(super) fn end(&self, at: [f32; 6]) -> [f32; 6] {
        let here = Placement::of_pose(at);
        let wanted = match self.has_rotation_vector {
            true => Placement::of_rotation_vector(self.pose),
            false => Placement::of_pose(self.pose),
        };
        match self.reference {
            Reference::Tool => here.then(&wanted).pose(),
            Reference::Difference if self.has_rotation_vector => here.moved_by(&wanted).pose(),
            Reference::Base if self.has_rotation_vector => wanted.pose(),
            Reference::Difference => std::array::from_fn(|index| at[index] + self.pose[index]),
            Reference::Base => std::array::from_fn(|index| match self.pose[index] {
                side if side.is_infinite() => at[index],
                side => side,
            }),
        }
    }
}

/// Number at `index` of the parameters.
pub(super) fn number(parameters: &[u8], index: usize) -> f32 {
    let at = 4 * index;
    let bytes = [0, 1, 2, 3].map(|byte| parameters[at + byte]);
    f32::from_le_bytes(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(hexadecimal: &str) -> Vec<u8> {
        let digits: Vec<u32> = hexadecimal
            .chars()
            .filter_map(|digit| digit.to_digit(16))
            .collect();
        let byte = |pair: &[u32]| u8::try_from(16 * pair[0] + pair[1]).expect("two digits");
        digits.chunks_exact(2).map(byte).collect()
    }

    /// Parameters of commands of xarm-python-sdk 1.18.4: `set_position(300, 0, 200, 180, 0, 0, speed=100)` and `set_position(z=-0.1, relative=True,
    /// speed=5)`.
    const LONG: &str = "00009643 00000000 00004843 db0f4940 00000000 00000000 0000c842 0000fa44 00000000 000080bf 000000";
    const SHORT: &str =
        "00009643 00000000 00004843 db0f4940 00000000 00000000 0000c842 0000fa44 00000000";
    const RELATIVE: &str = "00000000 00000000 cdccccbd 00000000 00000000 00000000 00000000 0000a040 0000c842 00000000 000080bf 0000";
    /// Parameters of `set_position(z=199.9, speed=5)`: omitted coordinates are infinite.
    const PARTIAL: &str = "0000807f 0000807f 66e64743 0000807f 0000807f 0000807f 0000a040 0000c842 00000000 000080bf 000000";

    /// Parameters of `set_tool_position(z=1, speed=5)`.
    const TOOL: &str = "00000000 00000000 0000803f 00000000 00000000 00000000 0000a040 0000c842 00000000 000080bf 010000";

    #[test]
    fn a_motion_in_the_frame_of_the_tool_goes_where_the_tool_points() {
        let step = Line::absolute(&bytes(TOOL), true).expect("a motion");
        assert_eq!(step.reference, Reference::Tool);
        let [x, y, z, ..] = step.end([300.0, 0.0, 200.0, std::f32::consts::PI, 0.0, 0.0]);
        for (found, expected) in [(x, 300.0), (y, 0.0), (z, 199.0)] {
            assert!((found - expected).abs() < 1e-3, "{found} {expected}");
        }
        let old = &bytes(TOOL)[..OLD_BYTES];
        assert_eq!(Line::in_tool(old), Some(step));
        let checked = Line::in_tool(&[old, &[1]].concat()).expect("a motion");
        assert!(checked.is_only_checked);
        assert_eq!(Line::in_tool(&[old, &[0, 1]].concat()), None);
    }

    #[test]
    fn rotation_vectors_are_those_of_the_base_of_the_tool_or_differences() {
        let old = &bytes(SHORT)[..];
        for (switches, reference) in [
            ([0, 0], Reference::Base),
            ([0, 1], Reference::Difference),
            ([1, 0], Reference::Tool),
        ] {
            let line = Line::by_rotation_vector(&[old, &switches].concat()).expect("a motion");
            assert!(line.has_rotation_vector && !line.is_only_checked);
            assert_eq!(line.reference, reference);
        }
        let turned = Line::relative(&[&bytes(RELATIVE)[..DIFFERENCE_BYTES], &[0, 1, 1]].concat());
        let turned = turned.expect("a motion");
        assert!(turned.has_rotation_vector && turned.is_only_checked);
        let joints = [&bytes(RELATIVE)[..DIFFERENCE_BYTES], &[1, 0]].concat();
        assert_eq!(Line::relative(&joints), None);
    }

    #[test]
    fn motions_are_read_as_the_public_client_writes_them() {
        let pose = [300.0, 0.0, 200.0, std::f32::consts::PI, 0.0, 0.0];
        for (text, takes_long_lines) in [(LONG, true), (SHORT, false)] {
            let line = Line::absolute(&bytes(text), takes_long_lines).expect("a motion");
            assert_eq!(line.end([0.0; 6]).map(f32::to_bits), pose.map(f32::to_bits));
            assert_eq!(line.speed_mm_s.to_bits(), 100.0_f32.to_bits());
            assert_eq!(Line::absolute(&bytes(text), !takes_long_lines), None);
        }
        let relative = Line::relative(&bytes(RELATIVE)).expect("a motion");
        assert_eq!(relative.end(pose)[2].to_bits(), 199.9_f32.to_bits());
        assert_eq!(relative.speed_mm_s.to_bits(), 5.0_f32.to_bits());
        let partial = Line::absolute(&bytes(PARTIAL), true).expect("a motion");
        assert_eq!(partial.end(pose)[..2], pose[..2]);
        assert_eq!(partial.end(pose)[2].to_bits(), 199.9_f32.to_bits());
    }
}
