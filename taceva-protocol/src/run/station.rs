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
    /// Its number: that of its station, or of its picture.
    pub(super) number: u32,
    /// The height from which depths count, in mm.
    pub(super) zero_mm: f64,
    /// The limit of the gel that kept the tip from the station.
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
    let station = usize::try_from(spot.number)
        .ok()
        .and_then(|number| press.stations().get(number));
    Sample {
        id: format!("{}/{}", planned.id, spot.number),
        unit_id: Some(press.unit.clone()),
        scene_id: press.light.clone(),
        point_id: Some(press.point_id()),
        // A depth at which a limit stopped the tip is no level that repeats share.
        depth_step: station
            .filter(|_| spot.limited_by.is_none())
            .map(|_| spot.number),
        repeat: press.repeat,
        phase: station.map(|station| station.phase),
        limited_by: spot.limited_by,
        stamp: Some(observed.stamp),
        kind,
        spacing,
        frame: observed.frame,
        truth: Readings::new(truth.collect()),
        ..Sample::default()
    }
}
