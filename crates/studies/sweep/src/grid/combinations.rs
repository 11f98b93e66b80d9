//! Every combination of recordings, splits, seeds, settings and models.

use std::collections::{BTreeMap, BTreeSet};

use taceva_dataset::Digest;

use super::Grid;
use super::recordings::Recording;
use crate::file::{ModelEntry, SweepFile};
use crate::key::{KeyParts, TaskKey};
use crate::task::Task;

/// State that tasks of all recordings share.
pub(super) struct Common<'a> {
    pub(super) file: &'a SweepFile,
    pub(super) sensor: Option<Digest>,
    /// Build of the plugin that provides each plugin model.
    pub(super) builds: BTreeMap<String, String>,
}

/// Division of the samples of a task.
#[derive(Clone, Copy)]
struct Division<'a> {
    split: Option<&'a str>,
    seed: u64,
}

impl Common<'_> {
    pub(super) fn combined(&self, recordings: &[Recording]) -> Grid {
        let file = self.file;
        let varied = varied(file);
        let mut grid = Grid {
            tasks: Vec::new(),
            skipped: 0,
            tables: None,
            label_tables: None,
        };
        for recording in recordings {
            for labels in labels(file) {
                for split in &file.splits {
                    for &seed in &file.seeds {
                        for settings in &varied {
                            for model in &file.models {
                                let division = Division {
                                    split: split.as_deref(),
                                    seed,
                                };
                                let task = self.task(recording, labels, model, settings, division);
                                match file.skip.iter().any(|condition| condition.holds(&task)) {
                                    true => grid.skipped += 1,
                                    false => grid.tasks.push(task),
                                }
                            }
                        }
                    }
                }
            }
        }
        // A model's own setting overrides a varied one, which gives equal tasks; duplicates are dropped.
        let mut known = BTreeSet::new();
        grid.tasks.retain(|task| known.insert(task.key.clone()));
        grid
    }

    fn task(
        &self,
        recording: &Recording,
        labels: Option<&str>,
        model: &ModelEntry,
        varied: &BTreeMap<String, String>,
        Division { split, seed }: Division<'_>,
    ) -> Task {
        let mut settings = varied.clone();
        settings.extend(model.set.clone());
        let plugin = self.builds.get(&model.name);
        let key = TaskKey::of(KeyParts {
            dataset: recording.digest,
            model: &model.name,
            settings: &settings,
            split,
            seed,
            metrics: &self.file.metrics,
            sensor: self.sensor,
            plugin: plugin.map(String::as_str),
            labels,
        });
        Task {
            key,
            dataset: recording.name.clone(),
            path: recording.path.clone(),
            digest: recording.digest.to_string(),
            labels: labels.map(str::to_owned),
            model: model.name.clone(),
            settings,
            split: split.map(str::to_owned),
            seed,
            plugin: plugin.cloned(),
        }
    }
}

/// Tasks whose labels are predicted; `None` for channels.
fn labels(file: &SweepFile) -> Vec<Option<&str>> {
    match file.labels.as_slice() {
        [] => vec![None],
        labels => labels.iter().map(|name| Some(name.as_str())).collect(),
    }
}

/// Every combination of the varied settings.
fn varied(file: &SweepFile) -> Vec<BTreeMap<String, String>> {
    let mut all = vec![BTreeMap::new()];
    for (key, values) in &file.vary {
        let with = |settings: &BTreeMap<String, String>| {
            let settings = settings.clone();
            values.iter().map(move |value| {
                let mut settings = settings.clone();
                settings.insert(key.clone(), value.clone());
                settings
            })
        };
        all = all.iter().flat_map(with).collect();
    }
    all
}
