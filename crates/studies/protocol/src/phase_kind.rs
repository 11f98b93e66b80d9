//! The kinds of phases of a protocol.

use std::fmt;

/// A part of a protocol.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PhaseKind {
    /// Pictures without contact: how fast the sensor is.
    Idle,
    /// The height of the surface, felt on every unit at the same points.
    SurfaceMap,
    /// What a model is fitted and tested on, straight and sheared.
    Calibration,
    /// Held-out presses all over the surface.
    Spatial,
    /// Held-out presses again in every scene of light.
    LightSweep,
    /// Points approached, pressed and left again and again.
    Repeatability,
    /// Into the gel and out again.
    LoadUnload,
    /// Boards of every spacing.
    Gratings,
}

impl PhaseKind {
    /// Every kind, in the order in which they are visited.
    pub const ALL: [PhaseKind; 8] = [
        PhaseKind::Idle,
        PhaseKind::SurfaceMap,
        PhaseKind::Calibration,
        PhaseKind::Spatial,
        PhaseKind::LightSweep,
        PhaseKind::Repeatability,
        PhaseKind::LoadUnload,
        PhaseKind::Gratings,
    ];

    /// How the phase is written in plans.
    pub const fn name(self) -> &'static str {
        match self {
            PhaseKind::Idle => "idle",
            PhaseKind::SurfaceMap => "surface-map",
            PhaseKind::Calibration => "calibration",
            PhaseKind::Spatial => "spatial",
            PhaseKind::LightSweep => "light-sweep",
            PhaseKind::Repeatability => "repeatability",
            PhaseKind::LoadUnload => "load-unload",
            PhaseKind::Gratings => "gratings",
        }
    }
}

impl fmt::Display for PhaseKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl serde::Serialize for PhaseKind {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}
