//! A sample: picture, pose and force of one moment.

use std::time::Duration;

use taceva_core::{
    Deadline, ErrorKind, Frame, FrameMut, Limit, Nanometre, Pose, Readings, Sample, Sensor,
    Specimen, Stamp, Wrench,
};

use super::align::{Look, between};
use super::error::StopCause;
use super::event::Event;
use super::tip::{Step, Tip};
use crate::plan::{PlannedPress, SURFACE};
use crate::press::Motion;

/// Frames that are lost, damaged or older than the rest of the tip before the run gives up.
const FRAME_TRIES: u32 = 10;
/// A camera that is slower than this is dead.
const FRAME_DEADLINE: Deadline = Deadline::after(Duration::from_secs(1));
/// A frame from further ahead than this has another clock, in s.
const AHEAD_S: f64 = 0.001;

/// A sensor and the buffer its frames are written into.
pub(super) struct Camera<'a> {
    pub(super) sensor: &'a mut dyn Sensor,
}

impl<'a> Camera<'a> {
    pub(super) fn new(sensor: &'a mut dyn Sensor) -> Camera<'a> {
        Camera { sensor }
    }

    /// The first frame that was true no earlier than `from_s`.
    pub(super) fn frame(
        &mut self,
        from_s: f64,
        tip: &Tip<'_>,
        events: &mut dyn FnMut(&Event),
    ) -> Step<(Frame, Stamp)> {
        let info = self.sensor.frame_info();
        let too_large = || StopCause::Missing(format!("memory for frames of {info}"));
        let mut last = None;
        for _ in 0..FRAME_TRIES {
            let mut bytes = vec![0; info.byte_len().ok_or_else(too_large)?];
            let into = FrameMut::new(info, &mut bytes)
                .expect("the buffer was made with the length of the frame");
            match self.sensor.capture(into, FRAME_DEADLINE) {
                Ok(stamp) if is_news(&stamp, from_s, tip.clock.now_s()) => {
                    let frame = Frame::new(info, bytes)
                        .expect("the buffer was made with the length of the frame");
                    return Ok((frame, stamp));
                }
                Ok(_) => events(&Event::FrameRetried),
                Err(error) if [ErrorKind::Timeout, ErrorKind::Protocol].contains(&error.kind()) => {
                    last = Some(error.to_string());
                    events(&Event::FrameRetried);
                }
                Err(error) => return Err(StopCause::Device(error)),
            }
        }
        Err(StopCause::Frames {
            attempts: FRAME_TRIES,
            last,
        })
    }
}

/// Whether a frame was taken between then and now.
fn is_news(stamp: &Stamp, from_s: f64, now_s: f64) -> bool {
    (from_s..=now_s + AHEAD_S).contains(&stamp.valid_s)
}

/// What was true at one moment.
pub(super) struct Observed {
    wrench: Wrench,
    pose: Pose,
    stamp: Stamp,
    frame: Option<Frame>,
}

/// Observes what is there after `before`; force and pose are read before and after the picture and told for its moment.
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

/// Which sample of a press is taken.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    /// Its number: that of its waypoint, or of its picture.
    pub(super) number: u32,
    /// The height from which depths count, in mm.
    pub(super) zero_mm: f64,
    /// The limit of the gel that kept the tip from the waypoint.
    pub(super) limited_by: Option<Limit>,
}

impl Spot {
    /// A sample of a place that was reached.
    pub(super) fn reached(number: u32, zero_mm: f64) -> Spot {
        Spot {
            number,
            zero_mm,
            limited_by: None,
        }
    }
}

/// What a press has given so far.
#[derive(Debug, Default)]
pub(super) struct Gathered {
    pub(super) samples: Vec<Sample>,
}

/// The sample of `spot`; channels that nobody measures are absent.
pub(super) fn sample(
    planned: &PlannedPress,
    spot: Spot,
    observed: Observed,
    channels: &[String],
) -> Sample {
    let press = &planned.press;
    let position = observed.pose.position;
    let [fx, fy, fz] = observed.wrench.force.map(|force| force.0);
    let is_press = matches!(press.motion, Motion::Indent(_));
    let is_touch = matches!(press.motion, Motion::Touch);
    let truth = channels.iter().map(|name| match name.as_str() {
        "Px" => Some(position.x.0),
        "Py" => Some(position.y.0),
        "Pz" => is_press.then_some(position.z.0 - spot.zero_mm),
        "Fx" => Some(fx),
        "Fy" => Some(fy),
        "Fz" => Some(fz),
        SURFACE => is_touch.then_some(position.z.0),
        _ => None,
    });
    let (kind, spacing): (_, Option<Nanometre>) = match press.specimen {
        Specimen::Sphere { .. } => (None, None),
        Specimen::Grating { kind, spacing } => (Some(kind), Some(spacing)),
    };
    let waypoint = usize::try_from(spot.number)
        .ok()
        .and_then(|number| press.waypoints().get(number));
    Sample {
        id: format!("{}/{}", planned.id, spot.number),
        unit_id: Some(press.unit.clone()),
        scene_id: press.light.clone(),
        point_id: Some(press.point_id()),
        // A depth at which a limit stopped the tip is no level that repeats share.
        depth_step: waypoint
            .filter(|_| spot.limited_by.is_none())
            .map(|_| spot.number),
        repeat: press.repeat,
        phase: waypoint.map(|waypoint| waypoint.phase),
        limited_by: spot.limited_by,
        stamp: Some(observed.stamp),
        kind,
        spacing,
        frame: observed.frame,
        truth: Readings::new(truth.collect()),
        ..Sample::default()
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::{
        DriverError, FrameInfo, GratingKind, Millimetre, Newton, Phase, PixelFormat, Point,
    };

    use super::*;
    use crate::press::Waypoint;
    use crate::run::rig::{Rig, nothing, plan, with_tip};

    /// Gives pictures that were taken at these times; the last one again and again.
    struct Album(Vec<f64>);

    impl Sensor for Album {
        fn frame_info(&self) -> FrameInfo {
            FrameInfo {
                width: 1,
                height: 1,
                format: PixelFormat::Gray8,
            }
        }
        fn capture(&mut self, _: FrameMut<'_>, _: Deadline) -> Result<Stamp, DriverError> {
            let valid_s = self.0[0];
            if self.0.len() > 1 {
                self.0.remove(0);
            }
            Ok(Stamp {
                valid_s,
                received_s: None,
            })
        }
    }

    /// The picture of a tip that has rested since 4.5 s, at 5 s; how often another one was asked for, and when it was taken.
    fn taken(times: &[f64]) -> (u32, Result<f64, StopCause>) {
        let mut album = Album(times.to_vec());
        let mut retried = 0;
        let frame = with_tip(&Rig::new(-3.0, nothing), |tip| {
            let mut note =
                |event: &Event| retried += u32::from(matches!(event, Event::FrameRetried));
            let mut camera = Camera::new(&mut album);
            camera.frame(4.5, tip, &mut note)
        });
        (retried, frame.map(|(_, stamp)| stamp.valid_s))
    }

    #[test]
    fn a_picture_of_before_the_rest_or_of_another_clock_is_asked_for_again() {
        let (retried, time_s) = taken(&[4.25, 5.25, 4.499, 4.75]);
        assert_eq!((retried, time_s.ok()), (3, Some(4.75)));
        let (retried, time_s) = taken(&[4.5]);
        assert_eq!((retried, time_s.ok()), (0, Some(4.5)));
    }

    #[test]
    fn a_sensor_that_gives_only_old_pictures_is_given_up() {
        let (retried, error) = taken(&[4.0]);
        assert_eq!(retried, FRAME_TRIES);
        let error = error.expect_err("no news").to_string();
        assert!(error.starts_with("10 frames in a row were lost"), "{error}");
    }

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

    /// The sample of the second of two waypoints, half a millimetre below a contact at 0.25 mm.
    fn second(motion: Motion, limited_by: Option<Limit>) -> Sample {
        let mut plan = plan();
        let planned = &mut plan.presses[0];
        planned.press.unit = "b".to_owned();
        planned.press.light = Some("S1".to_owned());
        planned.press.repeat = Some(3);
        planned.press.motion = motion;
        planned.press.specimen = Specimen::Grating {
            kind: GratingKind::Dot,
            spacing: Nanometre(500_000),
        };
        let position = Point {
            x: Millimetre(1.0),
            y: Millimetre(-2.0),
            z: Millimetre(0.75),
        };
        let pose = Pose {
            position,
            ..Pose::default()
        };
        let wrench = Wrench {
            force: [Newton(0.125), Newton(-0.25), Newton(1.5)],
            ..Wrench::default()
        };
        let stamp = Stamp {
            valid_s: 5.0,
            received_s: Some(5.5),
        };
        let observed = Observed {
            wrench,
            pose,
            stamp,
            frame: None,
        };
        let spot = Spot {
            limited_by,
            ..Spot::reached(1, 0.25)
        };
        let channels = ["Px", "Py", "Pz", "Fx", "Fy", "Fz", SURFACE, "Tz"].map(str::to_owned);
        let sample = sample(planned, spot, observed, &channels);
        assert_eq!(sample.id, format!("{}/1", planned.id));
        assert_eq!(sample.point_id, Some(planned.press.point_id()));
        assert_eq!(sample.stamp, Some(stamp));
        sample
    }

    fn truths(sample: &Sample) -> Vec<Option<f64>> {
        (0..8).map(|channel| sample.truth.get(channel)).collect()
    }

    #[test]
    fn a_sample_of_a_press_says_where_it_was_taken_of_what_and_what_was_measured() {
        let waypoint = |phase| Waypoint {
            depth: Nanometre(500_000),
            shear: [Nanometre(0); 2],
            phase,
        };
        let waypoints = vec![waypoint(Phase::Load), waypoint(Phase::Unload)];
        let sample = second(Motion::Indent(waypoints.clone()), None);
        assert_eq!(sample.unit_id.as_deref(), Some("b"));
        assert_eq!(sample.scene_id.as_deref(), Some("S1"));
        assert_eq!((sample.depth_step, sample.repeat), (Some(1), Some(3)));
        assert_eq!(
            (sample.phase, sample.limited_by),
            (Some(Phase::Unload), None)
        );
        let spacing = Some(Nanometre(500_000));
        assert_eq!(
            (sample.kind, sample.spacing),
            (Some(GratingKind::Dot), spacing)
        );
        let [x, y, z] = [Some(1.0), Some(-2.0), Some(0.5)];
        let force = [Some(0.125), Some(-0.25), Some(1.5)];
        assert_eq!(
            truths(&sample),
            [x, y, z, force[0], force[1], force[2], None, None]
        );
        // Where a limit stopped the tip the depth is no level, and all else is as it was.
        let limited = second(Motion::Indent(waypoints), Some(Limit::Depth));
        assert_eq!(
            (limited.depth_step, limited.phase),
            (None, Some(Phase::Unload))
        );
        assert_eq!(limited.limited_by, Some(Limit::Depth));
        assert_eq!(truths(&limited), truths(&sample));
    }

    #[test]
    fn a_touch_has_a_height_and_no_depth_and_a_rest_has_neither() {
        let touch = truths(&second(Motion::Touch, None));
        assert_eq!((touch[2], touch[6]), (None, Some(0.75)));
        let rest = truths(&second(Motion::Rest { frames: 2 }, None));
        assert_eq!((rest[2], rest[6]), (None, None));
    }
}
