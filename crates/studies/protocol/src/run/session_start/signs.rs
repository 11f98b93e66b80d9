//! Directions of the forces in a gentle touch, compared with the axes of the rig file.

use crate::rig_file::{Along, SignedAxes};
use crate::text::SceneProblem;

const NAMES: [&str; 3] = ["x", "y", "z"];

/// Forces in the gentle touch, during the press and the sideways pushes, in N along the axes of the rig file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Felt {
    /// Force of the press along +z.
    pub(super) press: [f64; 3],
    /// Force of a sideways push to +x, and to +y: half the difference to the force of the opposite push. `None` if noise hides the force, or the
    /// transducer does not measure shear.
    pub(super) pushes: [Option<[f64; 3]>; 2],
}

impl Felt {
    /// Checks that each force was measured along the motion that caused it. `axes` are those of the rig file.
    ///
    /// # Errors
    /// The measured directions, and the axes that would agree with them.
    pub(super) fn check(&self, axes: SignedAxes) -> Result<(), SceneProblem> {
        let [to_x, to_y] = self.pushes;
        let forces = [to_x, to_y, Some(self.press)];
        let along = forces.map(|force| force.map(|force| greatest(&force)));
        let mut wrong = Vec::new();
        for (went, felt) in along.iter().enumerate() {
            if let Some(felt) = felt
                && *felt != Along::positive(went)
            {
                let did = if went == 2 { "pressed" } else { "pushed" };
                wrong.push(format!(
                    "{did} along +{}, the force was measured along {}",
                    NAMES[went],
                    name(*felt)
                ));
            }
        }
        if wrong.is_empty() {
            return Ok(());
        }
        let expected = whole(along).and_then(|along| axes.as_felt(along));
        Err(SceneProblem::AxesContradicted {
            felt: wrong.join("; "),
            expected: expected.map(|axes| axes.to_string()),
            // If the robot had not moved down, it would not have touched the gel.
            may_be_robot: along[2] == Some(Along::positive(2)),
        })
    }
}

fn name(along: Along) -> String {
    let sign = if along.sign < 0.0 { '-' } else { '+' };
    format!("{sign}{}", NAMES[along.axis])
}

/// Axis of the greatest component of `force`, with the sign of the component.
fn greatest(force: &[f64; 3]) -> Along {
    let mut found = (0, force[0]);
    for (axis, component) in force.iter().enumerate().skip(1) {
        if component.abs() > found.1.abs() {
            found = (axis, *component);
        }
    }
    Along {
        axis: found.0,
        sign: found.1.signum(),
    }
}

/// Completes three signed axes: the third axis is the cross product of the two known axes. `None` if more than one axis is unknown.
fn whole(along: [Option<Along>; 3]) -> Option<[Along; 3]> {
    let missing: Vec<usize> = (0..3).filter(|axis| along[*axis].is_none()).collect();
    match missing[..] {
        [] => Some(along.map(|along| along.unwrap_or_default())),
        [axis] => {
            let [next, last] = [along[(axis + 1) % 3]?, along[(axis + 2) % 3]?];
            let mut whole = along.map(|along| along.unwrap_or_default());
            whole[axis] = cross(next, last)?;
            Some(whole)
        }
        _ => None,
    }
}

/// Cross product of two signed axes; `None` for parallel axes.
fn cross(one: Along, other: Along) -> Option<Along> {
    let sign = one.sign * other.sign;
    let (step, sign) = match (3 + other.axis - one.axis) % 3 {
        1 => (2, sign),
        2 => (1, -sign),
        _ => return None,
    };
    let axis = (one.axis + step) % 3;
    Some(Along { axis, sign })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRUE: [&str; 3] = ["x", "-y", "-z"];

    /// Forces of a gentle touch, with the axes `written` in the rig file and those of [`TRUE`] in fact. Noise hides the push along axis `hidden`.
    fn felt(written: SignedAxes, hidden: Option<usize>) -> Felt {
        let mounted = SignedAxes::read(TRUE).expect("axes");
        let felt = |force: [f64; 3]| written.to_sensor(mounted.to_device(force));
        let push = |axis: usize| {
            let mut force = [0.001, -0.002, 0.003];
            force[axis] = 0.03;
            (hidden != Some(axis)).then(|| felt(force))
        };
        Felt {
            press: felt([0.002, -0.001, 0.06]),
            pushes: [push(0), push(1)],
        }
    }

    fn every_axes() -> Vec<SignedAxes> {
        const WORDS: [&str; 6] = ["x", "y", "z", "-x", "-y", "-z"];
        let mut every = Vec::new();
        for x in WORDS {
            for y in WORDS {
                every.extend(WORDS.map(|z| SignedAxes::read([x, y, z])));
            }
        }
        every.into_iter().flatten().collect()
    }

    #[test]
    fn of_the_24_ways_to_write_axes_23_are_refused_with_the_24th() {
        let mounted = SignedAxes::read(TRUE).expect("axes");
        let all = every_axes();
        assert_eq!(all.len(), 24);
        for hidden in [None, Some(0), Some(1)] {
            for written in &all {
                let found = felt(*written, hidden).check(*written);
                if *written == mounted {
                    found.expect("they are right");
                    continue;
                }
                let wrong = found.expect_err("they are wrong");
                let SceneProblem::AxesContradicted { expected, .. } = &wrong else {
                    panic!("{wrong}");
                };
                assert_eq!(
                    expected.as_deref(),
                    Some("[\"x\", \"-y\", \"-z\"]"),
                    "{written}"
                );
            }
        }
    }

    #[test]
    fn a_scale_that_is_upside_down_is_refused_without_a_word_of_the_axes_it_does_not_measure() {
        let axes = SignedAxes::read(["x", "y", "z"]).expect("axes");
        let upside_down = Felt {
            press: [0.0, 0.0, -0.06],
            pushes: [None, None],
        };
        let wrong = upside_down.check(axes).expect_err("pressed, it pulls");
        let said = wrong.to_string();
        assert!(
            said.contains("pressed along +z, the force was measured along -z"),
            "{said}"
        );
        assert!(!said.contains("write axes"), "{said}");
    }

    #[test]
    fn a_push_that_was_felt_the_other_way_may_be_the_robots_as_well() {
        let axes = SignedAxes::read(TRUE).expect("axes");
        let turned = Felt {
            press: [0.0, 0.0, 0.06],
            pushes: [Some([-0.03, 0.0, 0.0]), Some([0.0, -0.03, 0.0])],
        };
        let said = turned
            .check(axes)
            .expect_err("turned by 180 degrees")
            .to_string();
        assert!(
            said.contains("write axes = [\"-x\", \"y\", \"-z\"]"),
            "{said}"
        );
        assert!(said.contains("correct `axes` of [robot]"), "{said}");
    }
}
