//! Mapping between device axes and sensor axes.

use std::fmt;

use taceva_core::{Axes, Axis};

/// Rotation by right angles from a device frame to the sensor frame. Each sensor axis has a signed device axis.
///
/// ```
/// use taceva_protocol::SignedAxes;
/// let axes = SignedAxes::read(["x", "-y", "-z"])?;
/// assert_eq!(axes.to_sensor([1.0, 2.0, 3.0]), [1.0, -2.0, -3.0]);
/// assert!(SignedAxes::read(["x", "y", "-z"]).unwrap_err().contains("left-handed"));
/// # Ok::<(), String>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SignedAxes([Along; 3]);

/// One axis of the device, with its sign.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Along {
    /// Index of the axis: 0 for x, 1 for y, 2 for z.
    pub(crate) axis: usize,
    /// Sign of the axis: 1 or −1.
    pub(crate) sign: f64,
}

impl Along {
    /// Positive direction of `axis`.
    pub(crate) fn positive(axis: usize) -> Along {
        Along { axis, sign: 1.0 }
    }

    fn read(word: &str) -> Option<Along> {
        let (sign, letter) = match word.strip_prefix('-') {
            Some(letter) => (-1.0, letter),
            None => (1.0, word),
        };
        let axis = ["x", "y", "z"].iter().position(|known| *known == letter)?;
        Some(Along { axis, sign })
    }
}

impl SignedAxes {
    /// Parses the device axis for x, y and z of the sensor; `-` means the opposite direction.
    ///
    /// # Errors
    /// A message with the fault and the expected values, for an invalid axis name, a repeated axis, or a left-handed frame.
    pub fn read<T: AsRef<str>>(words: [T; 3]) -> Result<SignedAxes, String> {
        let mut axes = [Along::positive(0); 3];
        for (along, word) in axes.iter_mut().zip(&words) {
            let word = word.as_ref();
            *along = Along::read(word).ok_or_else(|| {
                let shown = taceva_core::shown(word);
                format!("`axes`: `{shown}` names no axis, expected x, y, z, -x, -y or -z")
            })?;
        }
        let axes = SignedAxes(axes);
        match axes.determinant() {
            determinant if determinant > 0.5 => Ok(axes),
            determinant if determinant < -0.5 => {
                let one_sign = [0, 1, 2].map(|axis| axes.reversed(&[axis]).to_string());
                Err(format!(
                    "`axes` are left-handed ({}), which no rotation produces: expected another sign of the wrong axis: {}",
                    written(&words),
                    one_sign.join(" or ")
                ))
            }
            _ => Err(format!(
                "`axes` name one axis twice ({}): expected each of x, y and z once",
                written(&words)
            )),
        }
    }

    /// Converts a vector from the device frame to the sensor frame.
    pub fn to_sensor(self, device: [f64; 3]) -> [f64; 3] {
        self.0.map(|along| along.sign * device[along.axis])
    }

    /// Converts a vector from the sensor frame to the device frame.
    pub fn to_device(self, sensor: [f64; 3]) -> [f64; 3] {
        let mut device = [0.0; 3];
        for (along, value) in self.0.iter().zip(sensor) {
            device[along.axis] = along.sign * value;
        }
        device
    }

    /// Returns the axes after half a turn of the sensor frame about its x, and about its y. Both reverse z.
    ///
    /// ```
    /// use taceva_protocol::SignedAxes;
    /// let [about_x, about_y] = SignedAxes::read(["x", "y", "z"])?.turned_over();
    /// assert_eq!(about_x.to_string(), r#"["x", "-y", "-z"]"#);
    /// assert_eq!(about_y.to_string(), r#"["-x", "y", "-z"]"#);
    /// # Ok::<(), String>(())
    /// ```
    pub fn turned_over(self) -> [SignedAxes; 2] {
        [1, 0].map(|beside| self.reversed(&[beside, 2]))
    }

    /// Reverses the sensor axes with the indices `positions`: 0 for x, 1 for y, 2 for z.
    fn reversed(self, positions: &[usize]) -> SignedAxes {
        let mut axes = self.0;
        for at in positions {
            axes[*at].sign = -axes[*at].sign;
        }
        SignedAxes(axes)
    }

    /// Components in the sensor frame that a transducer measures, if it measures the components `device` in its own frame.
    pub fn measured(self, device: Axes) -> Axes {
        let [forces, torques] = [
            [Axis::Fx, Axis::Fy, Axis::Fz],
            [Axis::Tx, Axis::Ty, Axis::Tz],
        ];
        let mut measured = Axes::NONE;
        for triple in [forces, torques] {
            for (along, component) in self.0.iter().zip(triple) {
                if device.contains(triple[along.axis]) {
                    measured = measured.with(component);
                }
            }
        }
        measured
    }

    /// Corrects the axes by three test forces along x, y and z of the sensor. `felt` has the axis and sign that the present axes report for each
    /// force. `None` if the result is not right-handed.
    pub(crate) fn as_felt(self, felt: [Along; 3]) -> Option<SignedAxes> {
        let along = felt.map(|felt| Along {
            axis: self.0[felt.axis].axis,
            sign: felt.sign * self.0[felt.axis].sign,
        });
        let axes = SignedAxes(along);
        (axes.determinant() > 0.5).then_some(axes)
    }

    /// Determinant: 1 for right-handed axes, −1 for left-handed axes, 0 for a repeated axis.
    fn determinant(self) -> f64 {
        let [x, y, z] = [0, 1, 2].map(|axis| {
            let mut row = [0.0; 3];
            row[self.0[axis].axis] = self.0[axis].sign;
            row
        });
        x[0] * (y[1] * z[2] - y[2] * z[1]) - x[1] * (y[0] * z[2] - y[2] * z[0])
            + x[2] * (y[0] * z[1] - y[1] * z[0])
    }
}

/// Formats the axes as in a rig file.
impl fmt::Display for SignedAxes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words = self.0.map(|along| {
            let sign = if along.sign < 0.0 { "-" } else { "" };
            format!("\"{sign}{}\"", ["x", "y", "z"][along.axis])
        });
        write!(f, "[{}]", words.join(", "))
    }
}

fn written<T: AsRef<str>>(words: &[T; 3]) -> String {
    words.each_ref().map(AsRef::as_ref).join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_48_signed_permutations_24_are_right_handed_and_each_leads_there_and_back() {
        let words = ["x", "y", "z", "-x", "-y", "-z"];
        let mut accepted = 0;
        for x in words {
            for y in words {
                for z in words {
                    let Ok(axes) = SignedAxes::read([x, y, z]) else {
                        continue;
                    };
                    accepted += 1;
                    assert_eq!(axes.to_string(), format!("[{:?}, {:?}, {:?}]", x, y, z));
                    let there = axes.to_sensor([1.0, 2.0, 3.0]);
                    assert!(
                        axes.to_device(there).iter().eq(&[1.0, 2.0, 3.0]),
                        "{x} {y} {z}"
                    );
                }
            }
        }
        assert_eq!(accepted, 24);
    }

    #[test]
    fn what_is_no_frame_is_refused_by_what_is_wrong_with_it() {
        let refused = |words: [&str; 3]| SignedAxes::read(words).expect_err("no frame");
        let left = refused(["x", "y", "-z"]);
        assert!(left.contains("left-handed (x, y, -z)"));
        let right = r#": ["-x", "y", "-z"] or ["x", "-y", "-z"] or ["x", "y", "z"]"#;
        assert!(left.ends_with(right), "{left}");
        assert!(refused(["x", "x", "z"]).contains("one axis twice"));
        assert!(refused(["x", "north", "z"]).contains("`north` names no axis"));
        assert!(refused(["--x", "y", "z"]).contains("`--x` names no axis"));
    }

    #[test]
    fn a_scale_on_its_side_measures_another_component() {
        let upright = SignedAxes::read(["x", "-y", "-z"]).expect("axes");
        assert_eq!(upright.measured(Axes::NORMAL), Axes::NORMAL);
        let aside = SignedAxes::read(["z", "x", "y"]).expect("axes");
        assert_eq!(aside.measured(Axes::NORMAL), Axes::NONE.with(Axis::Fx));
        assert_eq!(aside.measured(Axes::SIX), Axes::SIX);
    }
}
