//! Encoding of straight motions in commands.

/// Requested motion in the base frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Line {
    /// x, y, z in mm, roll, pitch, yaw in rad; infinite for an unchanged coordinate.
    pub(super) pose: [f32; 6],
    pub(super) speed_mm_s: f32,
    /// True if the pose is a difference.
    pub(super) is_relative: bool,
    /// True if the motion is only checked.
    pub(super) is_only_checked: bool,
}

/// Number of values of a motion before firmware 1.11.100, four bytes each.
const OLD_NUMBERS: usize = 9;
/// Length since then, bytes: ten values and three switches.
const NEW_BYTES: usize = 43;
/// Length of a relative motion, bytes: eleven values and two switches.
const RELATIVE_BYTES: usize = 46;

impl Line {
    /// Parses the motion in the parameters of register 21; `None` if their length matches no layout.
    pub(super) fn absolute(parameters: &[u8], takes_long_lines: bool) -> Option<Line> {
        let expected = if takes_long_lines {
            NEW_BYTES
        } else {
            4 * OLD_NUMBERS
        };
        if parameters.len() != expected {
            return None;
        }
        Some(Line {
            pose: std::array::from_fn(|index| number(parameters, index)),
            speed_mm_s: number(parameters, 6),
            is_relative: false,
            is_only_checked: takes_long_lines && parameters[NEW_BYTES - 1] != 0,
        })
    }

    /// Parses the motion in the parameters of register 83.
    pub(super) fn relative(parameters: &[u8]) -> Option<Line> {
        (parameters.len() == RELATIVE_BYTES).then(|| Line {
            pose: std::array::from_fn(|index| number(parameters, index)),
            speed_mm_s: number(parameters, 7),
            is_relative: true,
            is_only_checked: false,
        })
    }

    /// Target pose from `at`.
    pub(super) fn end(&self, at: [f32; 6]) -> [f32; 6] {
        std::array::from_fn(|index| match self.pose[index] {
            side if self.is_relative => at[index] + side,
            side if side.is_infinite() => at[index],
            side => side,
        })
    }
}

fn number(parameters: &[u8], index: usize) -> f32 {
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

    /// Frames of xarm-python-sdk 1.18.4: `set_position(300, 0, 200, 180, 0, 0, speed=100)` and `set_position(z=-0.1, relative=True,
    /// speed=5)`.
    const LONG: &str = "00009643 00000000 00004843 db0f4940 00000000 00000000 0000c842 0000fa44 00000000 000080bf 000000";
    const SHORT: &str =
        "00009643 00000000 00004843 db0f4940 00000000 00000000 0000c842 0000fa44 00000000";
    const RELATIVE: &str = "00000000 00000000 cdccccbd 00000000 00000000 00000000 00000000 0000a040 0000c842 00000000 000080bf 0000";
    /// `set_position(z=199.9, speed=5)`: omitted coordinates are infinite.
    const PARTIAL: &str = "0000807f 0000807f 66e64743 0000807f 0000807f 0000807f 0000a040 0000c842 00000000 000080bf 000000";

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
