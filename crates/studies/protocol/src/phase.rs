//! Phases of a protocol. Each phase computes its presses as values, and moves nothing.

mod calibration;
mod gratings;
mod idle;
mod light_sweep;
mod load_unload;
mod pose;
mod repeatability;
mod shape;
mod slip;
mod spatial;
mod surface_map;
mod wear;

use taceva_core::{Footprint, Nanometre, Phase, Specimen};

use crate::draw::Draws;
use crate::phase_kind::PhaseKind;
use crate::press::{Motion, Press, Waypoint};
use crate::scene::spacings;
use crate::scene::{Protocol, WearLoad, WearStage};

/// Inputs for drawing presses.
#[derive(Clone, Debug)]
pub(crate) struct PhaseInputs<'a> {
    pub(crate) protocol: &'a Protocol,
    pub(crate) footprint: Footprint,
    pub(crate) depth_max: Nanometre,
    /// Units of the sensor, never empty. All phases except the surface map use only the first unit, unless the scene repeats presses on every unit.
    pub(crate) units: &'a [String],
    /// Light scenes, the calibration scene first; empty if the light cannot be set.
    pub(crate) lights: &'a [String],
    /// True if the gel has markers. Without markers, shear leaves no visible trace.
    pub(crate) markers: bool,
    pub(crate) seed: u64,
    /// True if waypoints must be inside the footprint. False for simulated and emulated rigs, so that their presses are the same as in earlier versions.
    pub(crate) stays_inside: bool,
}

impl PhaseInputs<'_> {
    /// Presses of phase `kind`, in order.
    pub(crate) fn presses(&self, kind: PhaseKind) -> Vec<Press> {
        let mut presses = self.drawn(kind);
        if self.stays_inside {
            for press in &mut presses {
                press.turn_shear_inwards(&self.footprint);
            }
        }
        presses
    }

    fn drawn(&self, kind: PhaseKind) -> Vec<Press> {
        match kind {
            PhaseKind::Idle => idle::presses(self),
            PhaseKind::SurfaceMap => surface_map::presses(self),
            PhaseKind::Calibration => calibration::presses(self),
            PhaseKind::Spatial => spatial::presses(self),
            PhaseKind::LightSweep => light_sweep::presses(self),
            PhaseKind::Repeatability => repeatability::presses(self),
            PhaseKind::LoadUnload => load_unload::presses(self),
            PhaseKind::Gratings => gratings::presses(self),
            PhaseKind::Slip => slip::presses(self),
            PhaseKind::Shape => shape::presses(self),
            PhaseKind::Pose => pose::presses(self),
        }
    }

    /// Number of presses that [`presses`](PhaseInputs::presses) returns, computed without drawing them.
    pub(crate) fn count(&self, kind: PhaseKind) -> u64 {
        let protocol = self.protocol;
        match kind {
            PhaseKind::Idle => 1,
            PhaseKind::SurfaceMap => {
                self.units.len() as u64 * u64::from(protocol.surface.points.value)
            }
            PhaseKind::Calibration => u64::from(protocol.calibration.points.value),
            PhaseKind::Spatial => u64::from(protocol.spatial.points.value),
            PhaseKind::LightSweep => {
                self.lights.len() as u64 * u64::from(protocol.lighting.points.value)
            }
            PhaseKind::Repeatability => {
                let spec = &protocol.repeatability;
                let units = match spec.every_unit.value {
                    true => self.units.len() as u64,
                    false => 1,
                };
                units * u64::from(spec.points.value) * u64::from(spec.trials.value)
            }
            PhaseKind::LoadUnload => u64::from(protocol.hysteresis.points.value),
            PhaseKind::Gratings => {
                let spec = &protocol.gratings;
                let spacings = spacings(spec).map_or(0, |spacings| spacings.len());
                (spacings * spec.kinds.value.len()) as u64 * u64::from(spec.presses.value)
            }
            PhaseKind::Slip => u64::from(protocol.slip.strokes.value),
            PhaseKind::Shape => u64::from(protocol.shape.presses.value),
            PhaseKind::Pose => 2 * u64::from(protocol.pose.pairs.value),
        }
    }

    /// Load cycles that wear the gel before the measured presses of `stage`, in order.
    pub(crate) fn loads(&self, stage: &WearStage) -> Vec<Press> {
        let spec = self.protocol.wear.as_ref();
        let load = spec.and_then(|spec| Some((spec, WearLoad::from_name(&spec.load.value)?)));
        load.map_or_else(Vec::new, |(spec, load)| {
            wear::presses(self, load, spec, stage)
        })
    }

    fn draws(&self, kind: PhaseKind) -> Draws {
        Draws::new(self.seed, kind.name())
    }

    /// A press of the indenter on the first unit, in the light of calibration.
    fn press(&self, place: [Nanometre; 2], motion: Motion) -> Press {
        let radius = self.protocol.contact.indenter_radius_mm.value;
        Press {
            unit: self.units[0].clone(),
            light: self.lights.first().cloned(),
            specimen: Specimen::Sphere {
                radius: nanometres(radius),
            },
            place,
            turn_millidegrees: 0,
            repeat: None,
            motion,
        }
    }

    /// Depths from `step_mm` to the greatest depth, in steps of `step_mm`.
    fn staircase(&self, step_mm: f64) -> Vec<Nanometre> {
        let step = nanometres(step_mm).0.max(1);
        (1..=self.depth_max.0 / step)
            .map(|level| Nanometre(level * step))
            .collect()
    }

    /// Draws a depth between `least_mm` and the greatest depth, within one of `parts` equal parts of that range. This spreads the depths at a point.
    fn depth(&self, draws: Draws, least_mm: f64, part: DepthPart) -> Nanometre {
        let least = nanometres(least_mm).0.min(self.depth_max.0);
        let span = self.depth_max.0 - least;
        let (index, parts) = (i64::from(part.index), i64::from(part.parts));
        let edge = |index: i64| least + span / parts * index + span % parts * index / parts;
        Nanometre(draws.between(
            edge(index),
            edge(index + 1),
            [part.point, DEPTH_AXIS + u64::from(part.index)],
        ))
    }

    /// Draws a shear of at most `greatest_mm` along each axis.
    fn shear(&self, draws: Draws, greatest_mm: f64, part: DepthPart) -> [Nanometre; 2] {
        let greatest = nanometres(greatest_mm).0;
        [0, 1].map(|axis| {
            let place = [part.point, SHEAR_AXIS + 2 * u64::from(part.index) + axis];
            Nanometre(draws.between(-greatest, greatest, place))
        })
    }
}

/// Depth number `index` of the `parts` depths of a point.
#[derive(Clone, Copy, Debug)]
struct DepthPart {
    point: u64,
    index: u32,
    parts: u32,
}

/// First counter for the random draws of depths at a point. The draws of the point's place use lower counters.
const DEPTH_AXIS: u64 = 1 << 32;
const SHEAR_AXIS: u64 = 1 << 40;

/// Converts a length in mm that was checked during parsing.
fn nanometres(millimetres: f64) -> Nanometre {
    Nanometre::from_millimetres(millimetres).expect("lengths of a scene are at most 1000 mm")
}

/// A waypoint straight below the first contact, while loading.
fn straight(depth: Nanometre) -> Waypoint {
    Waypoint {
        depth,
        shear: [Nanometre(0); 2],
        phase: Phase::Load,
    }
}
