//! A recording that a scene of a sweep makes.

use std::path::PathBuf;

use taceva_dataset::Digest;

/// A recording that a scene of a sweep makes, known before it is there.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct SceneRecording {
    /// What tasks call it: the scene and its study.
    pub name: String,
    /// Where it is, or will be.
    pub path: PathBuf,
    /// Stands in the place of its digest until it is there.
    pub(crate) planned: Digest,
}

impl SceneRecording {
    /// That of `study` of `scene`, which is acquired to `path`.
    ///
    /// ```
    /// use taceva_sweep::SceneRecording;
    /// let recording = SceneRecording::new("quick", "MagicTac", "recordings/2-magictac".into());
    /// assert_eq!(recording.name, "quick/MagicTac");
    /// ```
    pub fn new(scene: &str, study: &str, path: PathBuf) -> SceneRecording {
        let name = format!("{scene}/{study}");
        SceneRecording {
            // No recording has it: that of one that is there is over two digests.
            planned: Digest::of(format!("to be acquired: {name}").as_bytes()),
            name,
            path,
        }
    }
}
