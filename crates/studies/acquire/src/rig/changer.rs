//! Opens the changers and the lighting of a rig for a check.

use taceva_protocol::RigFile;

use crate::error::AcquireError;
use crate::presses::FileOpener;

/// An open changer or lighting of a rig, from [`check_rig`](super::check_rig).
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
#[non_exhaustive]
pub struct ChangerCheck {
    /// Key under `[changers]`: `specimen`, `unit` or `light`.
    pub key: &'static str,
    /// Names of its items or light scenes.
    pub holds: Vec<String>,
}

/// Result of opening a changer or a lighting.
pub(super) struct TriedChanger {
    pub(super) key: &'static str,
    /// Names of its items; `None` if the rig file names no such device.
    pub(super) holds: Result<Option<Vec<String>>, AcquireError>,
}

/// Opens the changers and the lighting of `rig`, one after the other. Nothing moves.
pub(super) fn open_changers(rig: &RigFile, opener: &FileOpener<'_>) -> [TriedChanger; 3] {
    let changers = &rig.changers;
    let tried = |key, holds| TriedChanger { key, holds };
    [
        tried("specimen", opener.held(changers.specimen.as_ref())),
        tried("unit", opener.held(changers.unit.as_ref())),
        tried("light", opener.scenes(changers.light.as_ref())),
    ]
}
