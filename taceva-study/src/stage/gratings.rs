//! Which spacing each press of a grating is taken for, by a classifier that has not seen that press.

use std::collections::BTreeMap;

use taceva_core::{Column, GratingKind, Nanometre};
use taceva_dataset::{Dataset, Pass};
use taceva_models::{Discriminant, FourierPlane, RadialSpectrum};

use super::Means;
use crate::cache::{Key, Stage};
use crate::error::StudyError;
use crate::features::Work;
use crate::rows::{Need, usable};

/// Parts into which the presses of a board are dealt; each is predicted by what the others have taught.
const FOLDS: usize = 3;

/// Spacings as they were told.
pub(super) struct ToldSpacings {
    /// The rows of the dataset that were asked for, ascending.
    pub(super) rows: Vec<usize>,
    /// What each is taken for, in whole nm; absent where there is no picture.
    pub(super) spacings: Column,
    pub(super) frames_decoded: u64,
}

/// A press of a board.
struct Seen {
    row: usize,
    spacing: Nanometre,
    fold: usize,
    /// Its spectrum beyond the background of each fold.
    spectra: Vec<Vec<f64>>,
}

impl ToldSpacings {
    /// What a reader must know of how they were told.
    pub(super) const NOTE: &'static str = "sr: spacings are told from the radial spectrum of what a picture shows beyond the mean \
         picture, by linear discriminants, lines and dots apart, fitted on the other two thirds of the presses of every board";

    /// Tells the spacings of `rows`, lines and dots apart.
    pub(super) fn of(
        dataset: &Dataset,
        rows: Vec<usize>,
        Means { work, cache, .. }: Means<'_>,
    ) -> Result<ToldSpacings, StudyError> {
        let boards = boards(dataset, &rows);
        let key = Key::of(Stage::Tell)
            .part("dataset", &dataset.digest().to_string())
            .whole("rows", &rows)
            .finish();
        let spacings = cache.value(&key, || {
            let mut told: BTreeMap<usize, Nanometre> = BTreeMap::new();
            for presses in boards.values() {
                let seen = Pictures::new(dataset, presses, work)?.seen()?;
                for fold in 0..FOLDS {
                    tell(&seen, fold, &mut told)?;
                }
            }
            let mut spacings = Column::default();
            for row in &rows {
                spacings.push(told.get(row).map(|spacing| spacing.to_f64()));
            }
            Ok(spacings)
        })?;
        let presses: usize = boards.values().map(Vec::len).sum();
        // Once for the mean picture, once for each picture itself.
        let frames_decoded = 2 * presses as u64;
        Ok(ToldSpacings {
            rows,
            spacings,
            frames_decoded,
        })
    }
}

/// The presses with a picture, each with its spacing, by the relief of their board.
fn boards(dataset: &Dataset, rows: &[usize]) -> BTreeMap<GratingKind, Vec<(usize, Nanometre)>> {
    let table = dataset.table();
    let need = Need {
        frame: true,
        labels: None,
    };
    let mut presses: BTreeMap<GratingKind, Vec<(usize, Nanometre)>> = BTreeMap::new();
    for row in usable(dataset, rows, need) {
        if let (Some(kind), Some(spacing)) = (table.kind()[row], table.spacing()[row]) {
            presses.entry(kind).or_default().push((row, spacing));
        }
    }
    presses
}

/// The pictures of the presses of one relief.
struct Pictures<'a> {
    dataset: &'a Dataset,
    spectra: RadialSpectrum,
    presses: &'a [(usize, Nanometre)],
    rows: Vec<usize>,
    /// The fold of each press: those of one board are dealt in turn.
    folds: Vec<usize>,
    work: Work<'a>,
}

impl<'a> Pictures<'a> {
    fn new(
        dataset: &'a Dataset,
        presses: &'a [(usize, Nanometre)],
        work: Work<'a>,
    ) -> Result<Pictures<'a>, StudyError> {
        let frames = dataset.header().frames.as_ref();
        let frames = frames.ok_or_else(|| {
            StudyError::Request("the recording has no frames to tell spacings from".to_owned())
        })?;
        let mut numbers: BTreeMap<Nanometre, usize> = BTreeMap::new();
        let folds = presses.iter().map(|(_, spacing)| {
            let number = numbers.entry(*spacing).or_default();
            *number += 1;
            (*number - 1) % FOLDS
        });
        Ok(Pictures {
            folds: folds.collect(),
            rows: presses.iter().map(|(row, _)| *row).collect(),
            spectra: RadialSpectrum::new(frames.info),
            dataset,
            presses,
            work,
        })
    }

    /// Every press with its spectra.
    fn seen(&self) -> Result<Vec<Seen>, StudyError> {
        let backgrounds = self.backgrounds()?;
        let mut seen = Vec::with_capacity(self.rows.len());
        let spectra = |plane: &FourierPlane| {
            let backgrounds = backgrounds.iter();
            backgrounds
                .map(|(sum, count)| self.spectra.beyond(plane, (sum, *count)))
                .collect()
        };
        self.dataset.map_frames(
            self.pass(),
            |_, frame| self.spectra.plane(&frame).map(|plane| spectra(&plane)),
            |_, spectra| {
                let (row, spacing) = self.presses[seen.len()];
                seen.push(Seen {
                    row,
                    spacing,
                    fold: self.folds[seen.len()],
                    spectra: spectra?,
                });
                Ok(())
            },
        )?;
        Ok(seen)
    }

    /// For each fold, the sum of the planes of all other folds and how many they are.
    fn backgrounds(&self) -> Result<Vec<(FourierPlane, f64)>, StudyError> {
        let mut backgrounds = vec![(FourierPlane::default(), 0.0); FOLDS];
        let mut folds = self.folds.iter();
        self.dataset.map_frames(
            self.pass(),
            |_, frame| self.spectra.plane(&frame),
            |_, plane| {
                let (plane, own) = (plane?, folds.next());
                let others = backgrounds.iter_mut().enumerate();
                for (_, (sum, count)) in others.filter(|(fold, _)| Some(fold) != own) {
                    sum.add(&plane);
                    *count += 1.0;
                }
                Ok(())
            },
        )?;
        Ok(backgrounds)
    }

    fn pass(&self) -> Pass<'_> {
        Pass {
            rows: &self.rows,
            jobs: self.work.jobs,
            progress: self.work.progress,
        }
    }
}

/// Tells the presses of `fold` from what the others teach.
fn tell(
    seen: &[Seen],
    fold: usize,
    told: &mut BTreeMap<usize, Nanometre>,
) -> Result<(), StudyError> {
    let (asked, taught): (Vec<&Seen>, Vec<&Seen>) = seen.iter().partition(|seen| seen.fold == fold);
    if asked.is_empty() || taught.is_empty() {
        return Ok(());
    }
    let mut boards: Vec<Nanometre> = taught.iter().map(|seen| seen.spacing).collect();
    boards.sort_unstable();
    boards.dedup();
    let class = |seen: &&Seen| boards.partition_point(|board| *board < seen.spacing);
    let classes: Vec<usize> = taught.iter().map(class).collect();
    let spectra = taught.iter().map(|seen| seen.spectra[fold].clone());
    let discriminant = Discriminant::fit(&spectra.collect::<Vec<_>>(), &classes)?;
    for seen in asked {
        told.insert(seen.row, boards[discriminant.class(&seen.spectra[fold])]);
    }
    Ok(())
}
