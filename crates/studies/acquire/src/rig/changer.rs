//! Changers and lighting of a rig, opened to be checked.

use taceva_protocol::RigFile;

use crate::error::AcquireError;
use crate::presses::FileOpener;

/// An open changer or lighting of a rig. It is made by [`check_rig`](super::check_rig).
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
#[non_exhaustive]
pub struct ChangerCheck {
    /// Key under `[changers]`: `specimen`, `unit` or `light`.
    pub key: &'static str,
    /// Names of the things that it holds, or of its scenes.
    pub holds: Vec<String>,
}

/// A changer or lighting that was opened or not.
pub(super) struct TriedChanger {
    pub(super) key: &'static str,
    /// Names of what it holds; `None` if the rig file names none.
    pub(super) holds: Result<Option<Vec<String>>, AcquireError>,
}

/// Opens the changers of `rig` and its lighting, one after the other. Nothing moves.
pub(super) fn open_changers(rig: &RigFile, opener: &FileOpener<'_>) -> [TriedChanger; 3] {
    let changers = &rig.changers;
    let tried = |key, holds| TriedChanger { key, holds };
    [
        tried("specimen", opener.held(changers.specimen.as_ref())),
        tried("unit", opener.held(changers.unit.as_ref())),
        tried("light", opener.scenes(changers.light.as_ref())),
    ]
}
