//! Acquisition times of scenes, stored apart from the inputs of results.

use std::fs;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::folder::SweepFolder;

/// Measured duration of the presses of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct SceneTime {
    /// Number of presses.
    pub presses: u64,
    /// Duration of the presses, in s.
    pub seconds: f64,
}

impl SceneTime {
    /// Creates the record of `presses` presses that took `time`.
    pub fn new(presses: u64, time: Duration) -> SceneTime {
        SceneTime {
            presses,
            seconds: time.as_secs_f64(),
        }
    }

    /// Stores this time for the scene `name`. A failed write is ignored, because no result needs the time.
    pub fn keep(self, folder: &SweepFolder, name: &str) {
        let times = folder.scene_times();
        let made = fs::create_dir_all(&times).ok();
        if let Some(text) = made.and_then(|()| serde_json::to_string(&self).ok()) {
            drop(folder.write(&times.join(format!("{name}.json")), text.as_bytes()));
        }
    }

    /// Estimates the time of `presses` presses from all scenes acquired into `folder`; `None` if no scene was timed.
    pub fn estimate(folder: &SweepFolder, presses: u64) -> Option<Duration> {
        let mut all = SceneTime::new(0, Duration::ZERO);
        for entry in fs::read_dir(folder.scene_times()).ok()?.flatten() {
            let text = fs::read_to_string(entry.path()).unwrap_or_default();
            if let Ok(time) = serde_json::from_str::<SceneTime>(&text) {
                all.presses += time.presses;
                all.seconds += time.seconds;
            }
        }
        match all.presses {
            0 => None,
            made => Duration::try_from_secs_f64(all.seconds / made as f64 * presses as f64).ok(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presses_are_estimated_by_all_scenes_that_were_timed_and_not_before() {
        let own = tempfile::tempdir().expect("a folder");
        let folder = SweepFolder::new(own.path().to_owned());
        assert_eq!(SceneTime::estimate(&folder, 10), None);
        SceneTime::new(0, Duration::from_secs(1)).keep(&folder, "empty");
        assert_eq!(SceneTime::estimate(&folder, 10), None);
        SceneTime::new(30, Duration::from_secs(5)).keep(&folder, "one");
        SceneTime::new(10, Duration::from_secs(4)).keep(&folder, "other");
        let estimate = SceneTime::estimate(&folder, 8).expect("timed");
        assert_eq!(estimate, Duration::from_secs(2));
    }
}
