//! Pass 7: estimates the cost of a plan. The estimate does not change the plan.

use taceva_core::{FrameInfo, Nanometre};

use super::collect::PlannedPress;
use super::study_facts::StudyFacts;
use crate::press::Motion;
use crate::scene::Contact;

/// Estimated cost of a plan.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Cost {
    /// Number of presses.
    pub presses: u64,
    /// Number of samples, if no press ends early.
    pub samples: u64,
    /// Number of frames.
    pub frames: u64,
    /// Size of the stored frames before compression, in bytes; `None` if the frame size is unknown.
    pub bytes: Option<u64>,
    /// Time of motion, rest and exposure, in minutes; excludes manual changes of units and boards.
    pub minutes: f64,
}

/// Frame rate assumed if no rate is stated, in frames per second. It is just below the frame rate of the slowest sensor in the TacEva study.
const UNKNOWN_RATE: f64 = 24.0;
/// Time to read force and pose after a segment of motion, in s.
const LOOK_S: f64 = 0.005;

/// Estimates the cost of `presses`.
pub(super) fn cost(presses: &[PlannedPress], facts: &StudyFacts<'_>) -> Cost {
    let Some(phase_inputs) = &facts.phase_inputs else {
        return Cost::default();
    };
    let samples = |press: &PlannedPress| press.press.samples() as u64;
    let seen = presses.iter().filter(|press| press.frames);
    let frames: u64 = seen.map(samples).sum();
    let kept = facts.frame.map(|frame| match facts.kept_frames {
        Some(kept) => kept.kept(frame),
        None => frame,
    });
    let bytes = kept.as_ref().and_then(FrameInfo::byte_len);
    let price = Price {
        contact: &phase_inputs.protocol.contact,
        frame_s: 1.0 / facts.frame_rate.unwrap_or(UNKNOWN_RATE),
        travel_mm_s: facts
            .limits
            .as_ref()
            .map_or(1.0, |limits| limits.speed_max_mm_s),
        segment_mm: facts
            .limits
            .as_ref()
            .map_or(1.0, |limits| limits.overshoot.segment_mm),
        depth_mm_per_n: facts
            .limits
            .as_ref()
            .map_or(1.0, |limits| limits.depth_max.0 / limits.normal_max.0),
    };
    let mut from = [Nanometre(0); 2];
    let mut seconds = 0.0;
    for press in presses {
        seconds += price.seconds(press, from);
        from = press.press.place;
    }
    Cost {
        presses: presses.len() as u64,
        samples: presses.iter().map(samples).sum(),
        frames,
        bytes: bytes.map(|bytes| frames.saturating_mul(bytes as u64)),
        minutes: seconds / 60.0,
    }
}

struct Price<'a> {
    contact: &'a Contact,
    frame_s: f64,
    travel_mm_s: f64,
    segment_mm: f64,
    /// Assumed indentation per newton of load, in mm/N.
    depth_mm_per_n: f64,
}

impl Price<'_> {
    fn seconds(&self, press: &PlannedPress, from: [Nanometre; 2]) -> f64 {
        let travel = distance(from, press.press.place) / self.travel_mm_s;
        let rest = self.contact.settle_s.value;
        let frame = if press.frames { self.frame_s } else { 0.0 };
        match &press.press.motion {
            Motion::Rest { frames } => travel + f64::from(*frames) * self.frame_s,
            Motion::Touch => travel + self.search() + rest + frame,
            Motion::Indent(waypoints) => {
                let mut at = (Nanometre(0), [Nanometre(0); 2]);
                let mut seconds = travel + self.search();
                for waypoint in waypoints {
                    let sideways = distance(at.1, waypoint.shear);
                    let way = (waypoint.depth.0 - at.0.0).unsigned_abs();
                    let way = Nanometre(i64::try_from(way).unwrap_or(i64::MAX)).to_millimetres();
                    seconds += self.guarded(way + sideways) + rest + frame;
                    at = (waypoint.depth, waypoint.shear);
                }
                let back = at.0.to_millimetres() + self.contact.clearance_mm.value;
                seconds + back / self.travel_mm_s
            }
            Motion::Load(cycle) => {
                let depth_mm = cycle.force_n() * self.depth_mm_per_n;
                let (mut at, mut sideways_mm) = ([Nanometre(0); 2], 0.0);
                for offset in cycle.offsets() {
                    sideways_mm += distance(at, offset);
                    at = offset;
                }
                let back = depth_mm + self.contact.clearance_mm.value;
                let back = back + distance(at, [Nanometre(0); 2]);
                let under_load = rest + self.guarded(depth_mm + sideways_mm);
                travel + self.search() + under_load + back / self.travel_mm_s
            }
        }
    }

    /// Duration of the search for a surface at its expected height, in s.
    fn search(&self) -> f64 {
        self.guarded(self.contact.clearance_mm.value)
    }

    /// Duration of a motion in segments, each followed by a reading, in s.
    fn guarded(&self, way_mm: f64) -> f64 {
        way_mm / self.contact.speed_mm_s.value + way_mm / self.segment_mm * LOOK_S
    }
}

fn distance(from: [Nanometre; 2], to: [Nanometre; 2]) -> f64 {
    let side = |axis: usize| to[axis].to_millimetres() - from[axis].to_millimetres();
    side(0).hypot(side(1))
}

#[cfg(test)]
mod tests {
    use taceva_core::{Axes, Phase};

    use super::*;
    use crate::plan::plan_study;
    use crate::plan::tests::bench::{SMALL, paper_metrics, rig_of, sensor};
    use crate::press::{LoadCycle, Waypoint};
    use crate::scene::{Scene, WearLoad};
    use crate::source::SourceInfo;

    /// Duration of a press, in s. The test press starts 5 mm away, and moves at 2 mm/s in contact and 8 mm/s in the air. The clearance is 1 mm and segments are
    /// 1/8 mm. A rest takes 0.5 s, a frame 0.25 s.
    fn seconds(motion: Motion, frames: bool) -> f64 {
        let mut scene = Scene::parse("small", SMALL).expect("a scene");
        let source = SourceInfo::Rig(Box::new(rig_of(sensor(), Axes::FORCE)));
        let plan = plan_study(&scene, &scene.studies[0], &source, &paper_metrics());
        let mut press = plan.expect("a plan").presses.remove(0);
        let contact = &mut scene.protocol.contact;
        contact.speed_mm_s.value = 2.0;
        contact.clearance_mm.value = 1.0;
        contact.settle_s.value = 0.5;
        let price = Price {
            contact,
            frame_s: 0.25,
            travel_mm_s: 8.0,
            segment_mm: 0.125,
            depth_mm_per_n: 0.5,
        };
        press.press.place = [Nanometre(4_000_000), Nanometre(-2_000_000)];
        press.press.motion = motion;
        press.frames = frames;
        price.seconds(&press, [Nanometre(1_000_000), Nanometre(2_000_000)])
    }

    fn assert_takes(motion: Motion, frames: bool, expected: f64) {
        let found = seconds(motion, frames);
        assert!(
            (found - expected).abs() < 1e-12,
            "{found}, by hand {expected}"
        );
    }

    #[test]
    fn a_rest_costs_the_way_there_and_its_frames() {
        // 5 mm / 8 mm/s, and four frames.
        assert_takes(Motion::Rest { frames: 4 }, true, 0.625 + 1.0);
    }

    #[test]
    fn a_touch_costs_the_way_the_search_the_rest_and_a_frame_if_one_is_taken() {
        // Approach: 1 mm at 2 mm/s, and eight readings of 5 ms.
        let search = 0.5 + 8.0 * 0.005;
        assert_takes(Motion::Touch, false, 0.625 + search + 0.5);
        assert_takes(Motion::Touch, true, 0.625 + search + 0.5 + 0.25);
    }

    #[test]
    fn waypoints_cost_their_ways_down_sideways_and_up_and_the_way_back() {
        let waypoint = |depth, sideways, phase| Waypoint {
            depth: Nanometre(depth),
            shear: [Nanometre(sideways), Nanometre(0)],
            phase,
        };
        let waypoints = vec![
            waypoint(500_000, 0, Phase::Load),
            waypoint(250_000, 250_000, Phase::Unload),
        ];
        let search = 0.5 + 8.0 * 0.005;
        // 0.5 mm each; the second has a vertical and a sideways part of 0.25 mm: four readings.
        let waypoint = 0.25 + 4.0 * 0.005 + 0.5 + 0.25;
        let back = (0.25 + 1.0) / 8.0;
        let expected = 0.625 + search + 2.0 * waypoint + back;
        assert_takes(Motion::Indent(waypoints), true, expected);
    }

    #[test]
    fn a_load_costs_its_way_down_its_way_sideways_and_the_way_back() {
        let search = 0.5 + 8.0 * 0.005;
        let load = |load| {
            Motion::Load(LoadCycle {
                load,
                force: 500_000,
                travel: Nanometre(500_000),
            })
        };
        // 0.25 mm down at 2 mm/s with two readings, and 1.25 mm up.
        let pressed = 0.625 + search + 0.5 + 0.125 + 2.0 * 0.005 + 1.25 / 8.0;
        assert_takes(load(WearLoad::Compression), false, pressed);
        // 0.5 mm sideways with four readings, and back in the air.
        let stroke = 0.25 + 4.0 * 0.005 + 0.5 / 8.0;
        assert_takes(load(WearLoad::Abrasion), false, pressed + stroke);
        // 0.5 mm to one side, 1 mm to the other, 0.5 mm back.
        let sheared = 1.0 + 16.0 * 0.005;
        assert_takes(load(WearLoad::Shear), false, pressed + sheared);
    }
}
