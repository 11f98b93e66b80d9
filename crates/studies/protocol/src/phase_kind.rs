//! Kinds of phases of a protocol.

use std::fmt;

/// A phase of a protocol.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PhaseKind {
    /// Frames without contact, for the frame rate and the latency of the sensor.
    Idle,
    /// Surface height, measured at the same points on every unit.
    SurfaceMap,
    /// Normal and sheared presses for fitting and testing a model.
    Calibration,
    /// Held-out presses all over the surface.
    Spatial,
    /// Held-out presses, repeated in every light scene.
    LightSweep,
    /// Points pressed repeatedly, for the spread of equal presses.
    Repeatability,
    /// Presses recorded while loading and unloading.
    LoadUnload,
    /// Presses on boards of every spacing.
    Gratings,
    /// Strokes along the gel until the indenter slides.
    Slip,
    /// Presses of the ball whose contact shape is predicted.
    Shape,
    /// Pairs of presses of a board, between which it is shifted and turned.
    Pose,
}

impl PhaseKind {
    /// All kinds, in the order of their execution.
    pub const ALL: [PhaseKind; 11] = [
        PhaseKind::Idle,
        PhaseKind::SurfaceMap,
        PhaseKind::Calibration,
        PhaseKind::Spatial,
        PhaseKind::LightSweep,
        PhaseKind::Repeatability,
        PhaseKind::LoadUnload,
        PhaseKind::Gratings,
        PhaseKind::Slip,
        PhaseKind::Shape,
        PhaseKind::Pose,
    ];

    /// Name of the phase in plans.
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
            PhaseKind::Slip => "slip",
            PhaseKind::Shape => "shape",
            PhaseKind::Pose => "pose",
        }
    }

    /// True for the phase of a task, whose presses are planned if the scene states their number.
    pub const fn is_of_task(self) -> bool {
        matches!(self, PhaseKind::Slip | PhaseKind::Shape | PhaseKind::Pose)
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
