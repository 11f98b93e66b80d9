//! Observation of frame, pose and force at one moment.

use taceva_core::{Frame, Pose, Stamp, Wrench};

use super::align::{Look, between};
use super::camera::Camera;
use super::event::Event;
use super::tip::{Step, Tip};

/// Force, pose and frame at the time of `stamp`.
pub(super) struct Observed {
    pub(super) wrench: Wrench,
    pub(super) pose: Pose,
    pub(super) stamp: Stamp,
    pub(super) frame: Option<Frame>,
}

/// Captures a frame after the reading `before`, reads force and pose again, and interpolates both to the time of the frame. Without a camera, returns
/// `before`.
pub(super) fn observe(
    before: Look,
    tip: &mut Tip<'_>,
    camera: Option<&mut Camera<'_>>,
    events: &mut dyn FnMut(&Event),
) -> Step<Observed> {
    let Some(camera) = camera else {
        return Ok(Observed {
            wrench: before.wrench,
            pose: before.pose,
            stamp: Stamp {
                valid_s: before.wrench_s,
                received_s: Some(tip.clock.now_s()),
            },
            frame: None,
        });
    };
    let (frame, stamp) = camera.frame(before.since_s(), tip, events)?;
    let received_s = stamp.received_s.or(Some(tip.clock.now_s()));
    let after = tip.look()?;
    let (wrench, pose) = between(&before, &after, stamp.valid_s);
    Ok(Observed {
        wrench,
        pose,
        stamp: Stamp {
            received_s,
            ..stamp
        },
        frame: Some(frame),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::camera::tests::Album;
    use crate::run::rig::{Rig, nothing, with_tip};

    #[test]
    fn a_sample_says_when_it_was_received_though_the_sensor_does_not() {
        let mut album = Album(vec![5.001]);
        let observed = with_tip(&Rig::new(-3.0, nothing), |tip| {
            tip.find_pose()?;
            let before = tip.look()?;
            let camera = &mut Camera::new(&mut album);
            observe(before, tip, Some(camera), &mut |_| {})
        });
        let stamp = observed.expect("news").stamp;
        assert!(
            stamp
                .received_s
                .is_some_and(|received_s| received_s >= stamp.valid_s)
        );
    }
}
