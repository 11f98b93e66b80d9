//! Recording that a scene of a sweep acquires.

use std::path::PathBuf;

use taceva_dataset::Digest;

/// Recording that a scene of a sweep will acquire.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct SceneRecording {
    /// Name of the recording in tasks, derived from the scene and its study.
    pub name: String,
    /// Path of the recording, defined before the recording exists.
    pub path: PathBuf,
    /// Placeholder for the digest until the recording exists.
    pub(crate) planned: Digest,
}

impl SceneRecording {
    /// Recording of the study `study` of the scene `scene`, to be acquired to `path`.
    ///
    /// ```
    /// use taceva_sweep::SceneRecording;
    /// let recording = SceneRecording::new("quick", "MagicTac", "recordings/2-magictac".into());
    /// assert_eq!(recording.name, "quick/MagicTac");
    /// ```
    pub fn new(scene: &str, study: &str, path: PathBuf) -> SceneRecording {
        let name = format!("{scene}/{study}");
        SceneRecording {
            // No recording has this digest, because a recording's digest is computed from two digests.
            planned: Digest::of(format!("to be acquired: {name}").as_bytes()),
            name,
            path,
        }
    }
}
