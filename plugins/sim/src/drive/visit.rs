//! The time over one place.

use super::place::VisitKey;
use super::specimen::Mounted;
use super::ticks::Ticks;
use super::touch::{Touch, surface_mm};
use crate::bench::Bench;
use crate::parameters::Robot;
use crate::random::{Purpose, Random};
use crate::rig::TransducerModel;

/// The time over one place.
#[derive(Debug, Default)]
pub(super) struct Visit {
    pub(super) key: VisitKey,
    pub(super) began: Ticks,
    pub(super) readings: u64,
    pub(super) pictures: u32,
    pub(super) has_touched: bool,
    pub(super) touch: Option<Touch>,
    pub(super) errors: VisitErrors,
    pub(super) surface: Option<SurfaceBelow>,
}

/// What robot and transducer err by throughout a visit: drawn once.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct VisitErrors {
    /// How far beside its targets the robot stands: it errs from visit to visit, and repeats itself within one.
    pub(super) position_mm: [f64; 3],
    /// Where the transducer's zero has drifted to.
    pub(super) zero_n: [f64; 3],
}

impl VisitErrors {
    /// Those of the visit called `key`.
    pub(super) fn of(
        key: VisitKey,
        robot: Robot,
        transducer: &TransducerModel,
        random: Random,
    ) -> VisitErrors {
        let stream = random.stream(Purpose::Positioning, key.visit);
        let drift = transducer.point_zero_n(key.point);
        let later = transducer.press_zero_n(key.visit);
        VisitErrors {
            position_mm: [0, 1, 2].map(|axis| robot.positioning_mm * stream.normal(axis)),
            zero_n: std::array::from_fn(|axis| drift[axis] + later[axis]),
        }
    }
}

/// Where the gel begins under a place: worked out once, however often the tip is still above it.
#[derive(Clone, Copy, Debug)]
pub(super) struct SurfaceBelow {
    mounted: Mounted,
    place_mm: [f64; 2],
    pub(super) surface_mm: f64,
}

impl SurfaceBelow {
    /// The surface below `place_mm`: `known`, if it was worked out for that place and specimen.
    pub(super) fn at(
        bench: &Bench,
        mounted: Mounted,
        place_mm: [f64; 2],
        known: Option<SurfaceBelow>,
    ) -> SurfaceBelow {
        let is_here = |known: &SurfaceBelow| {
            known.mounted == mounted
                && known.place_mm.map(f64::to_bits) == place_mm.map(f64::to_bits)
        };
        known.filter(is_here).unwrap_or_else(|| SurfaceBelow {
            mounted,
            place_mm,
            surface_mm: surface_mm(bench, mounted, place_mm),
        })
    }
}
