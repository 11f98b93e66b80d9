//! Builds the sample of a waypoint or frame from the observation and the plan.

use taceva_core::{Limit, Nanometre, Readings, Sample, Specimen};

use super::depth_zero::DepthZero;
use super::observe::Observed;
use super::shear_way::Sheared;
use crate::plan::{PlannedPress, SURFACE};
use crate::press::Motion;

/// Place of a sample in a press: its waypoint or frame, the depth zero, and a limit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    /// Index of the waypoint or frame, from 0.
    pub(super) number: u32,
    /// Height of depth 0 along z of the sensor frame, in mm.
    pub(super) zero_mm: f64,
    /// Limit of the gel that stopped the tip before the waypoint; `None` if the tip reached the waypoint.
    pub(super) limited_by: Option<Limit>,
}

impl Spot {
    /// Spot of the waypoint `number`, which the tip reached.
    pub(super) fn reached(number: u32, zero_mm: f64) -> Spot {
        Spot {
            number,
            zero_mm,
            limited_by: None,
        }
    }
}

/// Recorded samples of a press, and the depth zero.
#[derive(Debug, Default)]
pub(super) struct Gathered {
    /// Height relative to which the depths of the press are measured; `None` before the first contact.
    pub(super) zero: Option<DepthZero>,
    /// Last waypoint that the tip reached, with the shear force there; `None` before the first waypoint.
    pub(super) sheared: Option<Sheared>,
    pub(super) samples: Vec<Sample>,
}

/// Sample at `spot` from `observed`. Channels that were not measured have no value.
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
    Sample::new(format!("{}/{}", planned.id, spot.number))
        .with_unit_id(press.unit.clone())
        .with_scene_id(press.light.clone())
        .with_point_id(press.point_id())
        // Repeats do not share the depth of a limited sample, so it has no depth step.
        .with_depth_step(
            waypoint
                .filter(|_| spot.limited_by.is_none())
                .map(|_| spot.number),
        )
        .with_repeat(press.repeat)
        .with_phase(waypoint.map(|waypoint| waypoint.phase))
        .with_limited_by(spot.limited_by)
        .with_stamp(observed.stamp)
        .with_kind(kind)
        .with_spacing(spacing)
        .with_frame(observed.frame)
        .with_truth(Readings::new(truth.collect()))
}

#[cfg(test)]
mod tests {
    use taceva_core::{GratingKind, Millimetre, Newton, Phase, Point, Pose, Stamp, Wrench};

    use super::*;
    use crate::press::Waypoint;
    use crate::run::rig::plan;

    /// Sample of the second of two waypoints, 0.5 mm below a first contact at 0.25 mm.
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
        // A limited sample has no depth step; everything else is unchanged.
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
