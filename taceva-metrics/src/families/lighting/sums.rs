//! Sums of the errors in each lighting scene.

use crate::exact::merge::{Merge, keyed, merge_cells};
use crate::exact::record::Record;
use crate::exact::sorted_map::SortedMap;
use crate::exact::{Dyadic, ExactSum};
use crate::pair::{Paired, is_valid};

/// Sums of the errors of one channel and of the brightness of its pictures, by lighting scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct LightingSums {
    pub(super) n_invalid: u64,
    /// Sums of each lighting scene with samples, by name.
    pub(super) scenes: SortedMap<String, SceneSums>,
}

/// Number of samples and exact sums of one lighting scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct SceneSums {
    pub(super) n: u64,
    /// Sum of the absolute residuals over samples, in the unit of the channel.
    pub(super) error: ExactSum,
    /// Sum of the brightness over samples. The brightness of a picture is on the 8-bit scale.
    pub(super) intensity: ExactSum,
}

impl SceneSums {
    /// Mean absolute error over the samples of the scene, rounded once.
    pub(super) fn mean_error(&self) -> f64 {
        self.error.to_dyadic().over(&Dyadic::from(self.n))
    }

    /// Mean brightness over the samples of the scene, rounded once.
    pub(super) fn mean_intensity(&self) -> f64 {
        self.intensity.to_dyadic().over(&Dyadic::from(self.n))
    }
}

impl LightingSums {
    /// Adds a sample of `scene` with the brightness of its picture. An invalid sample only raises the count of skipped samples.
    pub(super) fn add(&mut self, scene: &str, pair: Paired<f64>, intensity: f64) {
        if !pair.is_valid() || !is_valid(intensity) || intensity < 0.0 {
            self.n_invalid += 1;
            return;
        }
        if self.scenes.get(scene).is_none() {
            self.scenes.insert(scene.to_owned(), SceneSums::default());
        }
        let Some(sums) = self.scenes.get_mut(scene) else {
            return;
        };
        sums.n += 1;
        sums.error.add(pair.residual().abs());
        sums.intensity.add(intensity);
    }

    /// Number of samples in all scenes.
    pub(super) fn n(&self) -> u64 {
        let scenes = self.scenes.values();
        scenes.fold(0, |n, scene| n.saturating_add(scene.n))
    }

    pub(super) fn to_record(&self) -> Record {
        let cell = |(scene, sums): (&String, &SceneSums)| {
            let record = Record {
                counts: vec![sums.n],
                sums: vec![sums.error.clone(), sums.intensity.clone()],
                ..Record::default()
            };
            (scene.clone(), record)
        };
        Record {
            counts: vec![self.n_invalid],
            cells: keyed(self.scenes.iter().map(cell)),
            ..Record::default()
        }
    }

    pub(super) fn read_record(record: &Record) -> Result<LightingSums, String> {
        let ([n_invalid], []) = record.with_cells()?;
        let scenes = record.read_cells(
            |scene| Some(scene.to_owned()),
            |cell| {
                let ([n], [error, intensity]) = cell.exactly()?;
                if *n == 0 {
                    return Err("a scene without samples, expected at least one".to_owned());
                }
                Ok(SceneSums {
                    n: *n,
                    error: error.clone(),
                    intensity: intensity.clone(),
                })
            },
        )?;
        Ok(LightingSums {
            n_invalid: *n_invalid,
            scenes,
        })
    }
}

impl Merge for SceneSums {
    fn merge(&mut self, other: &SceneSums) {
        self.n = self.n.saturating_add(other.n);
        self.error.merge(&other.error);
        self.intensity.merge(&other.intensity);
    }
}

impl Merge for LightingSums {
    fn merge(&mut self, other: &LightingSums) {
        self.n_invalid = self.n_invalid.saturating_add(other.n_invalid);
        merge_cells(&mut self.scenes, &other.scenes);
    }
}
