//! Visits: the time that the tip spends above one place.

use super::place::VisitKey;
use super::specimen::Mounted;
use super::ticks::Ticks;
use super::touch::{Touch, surface_mm};
use crate::bench::Bench;
use crate::parameters::Robot;
use crate::random::{Purpose, Random};
use crate::rig::TransducerModel;

/// State of one visit.
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

/// Errors of robot and transducer in one visit, drawn at its start.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct VisitErrors {
    /// Position error of the robot, mm. The error is constant within a visit.
    pub(super) position_mm: [f64; 3],
    /// Drift of the transducer's zero.
    pub(super) zero_n: [f64; 3],
}

impl VisitErrors {
    /// Draws the errors of the visit `key`.
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

/// Height of the gel below a place, computed once per visit.
#[derive(Clone, Copy, Debug)]
pub(super) struct SurfaceBelow {
    mounted: Mounted,
    place_mm: [f64; 2],
    pub(super) surface_mm: f64,
}

impl SurfaceBelow {
    /// Surface below `place_mm`. Reuses `known` if place and specimen are the same.
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
