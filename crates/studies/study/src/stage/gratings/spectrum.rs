//! Spacings of gratings, predicted from the radial spectra of frames, by linear discriminants or by a model.

use taceva_core::Nanometre;
use taceva_dataset::{Dataset, Pass};
use taceva_models::{Discriminant, FourierPlane, RadialSpectrum};

use super::{FOLDS, SpacingOfRow, folds, model};
use crate::classifier::ModelClassifier;
use taceva_evaluate::EvaluateError;
use taceva_evaluate::Work;

/// Greatest memory for the Fourier planes of all frames, in bytes. If they need more, each frame is decoded twice instead.
const HELD_BYTES: u64 = 512 << 20;

/// Number of times that each frame of `presses` presses is decoded: once if all Fourier planes fit in memory. Otherwise a first pass computes the
/// backgrounds, and a second pass the spectra.
pub(super) fn times_decoded(dataset: &Dataset, presses: usize) -> u64 {
    let info = dataset.header().frames.as_ref().map(|frames| frames.info);
    let plane = info.map_or(0, |info| RadialSpectrum::new(info).plane_bytes());
    match plane.saturating_mul(presses as u64) {
        ..=HELD_BYTES => 1,
        _ => 2,
    }
}

/// Kind of classifier that is fitted to the spectra outside each fold.
#[derive(Clone, Copy)]
pub(super) enum ByFold<'a> {
    Discriminants,
    Model(&'a ModelClassifier),
}

/// Predicts the spacing of each of `presses` from the frames of `dataset`, one fold after another, and adds it to `predicted`.
pub(super) fn classify(
    dataset: &Dataset,
    presses: &[(usize, Nanometre)],
    by: ByFold<'_>,
    predicted: &mut SpacingOfRow,
    work: Work<'_>,
) -> Result<(), EvaluateError> {
    let seen = Pictures::new(dataset, presses, work)?.seen()?;
    for fold in 0..FOLDS {
        classify_fold(&seen, fold, by, predicted, work)?;
    }
    Ok(())
}

/// A press on a board, with its spectra.
struct Seen {
    row: usize,
    spacing: Nanometre,
    fold: usize,
    /// Spectrum of the frame for each fold, after subtraction of the background of that fold.
    spectra: Vec<Vec<f64>>,
}

/// Frames of the presses on boards with one kind of grating.
struct Pictures<'a> {
    dataset: &'a Dataset,
    spectra: RadialSpectrum,
    presses: &'a [(usize, Nanometre)],
    rows: Vec<usize>,
    /// Index of the fold of each press. The presses of one board are assigned to the folds in turn.
    folds: Vec<usize>,
    work: Work<'a>,
}

impl<'a> Pictures<'a> {
    fn new(
        dataset: &'a Dataset,
        presses: &'a [(usize, Nanometre)],
        work: Work<'a>,
    ) -> Result<Pictures<'a>, EvaluateError> {
        let frames = dataset.header().frames.as_ref();
        let frames = frames.ok_or_else(|| {
            EvaluateError::Request(
                "the recording has no frames to classify spacings from".to_owned(),
            )
        })?;
        Ok(Pictures {
            folds: folds(presses),
            rows: presses.iter().map(|(row, _)| *row).collect(),
            spectra: RadialSpectrum::new(frames.info),
            dataset,
            presses,
            work,
        })
    }

    /// Computes the spectra of every press.
    fn seen(&self) -> Result<Vec<Seen>, EvaluateError> {
        let is_held = times_decoded(self.dataset, self.rows.len()) == 1;
        let mut held = Vec::new();
        let backgrounds = self.backgrounds(|plane| {
            if is_held {
                held.push(plane);
            }
        })?;
        let mut seen = Vec::with_capacity(self.rows.len());
        let mut push = |spectra| {
            let (row, spacing) = self.presses[seen.len()];
            seen.push(Seen {
                row,
                spacing,
                fold: self.folds[seen.len()],
                spectra,
            });
        };
        let spectra = |plane: &FourierPlane| {
            let backgrounds = backgrounds.iter();
            backgrounds
                .map(|(sum, count)| self.spectra.beyond(plane, sum, *count))
                .collect()
        };
        if is_held {
            held.iter().for_each(|plane| push(spectra(plane)));
        } else {
            self.dataset.map_frames(
                self.pass(),
                |_, frame| self.spectra.plane(&frame).map(|plane| spectra(&plane)),
                |_, spectra| {
                    push(spectra?);
                    Ok(())
                },
            )?;
        }
        Ok(seen)
    }

    /// Backgrounds: for each fold, the sum and the number of the Fourier planes of frames outside it. Calls `keep` once with each plane.
    fn backgrounds(
        &self,
        mut keep: impl FnMut(FourierPlane),
    ) -> Result<Vec<(FourierPlane, f64)>, EvaluateError> {
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
                keep(plane);
                Ok(())
            },
        )?;
        Ok(backgrounds)
    }

    fn pass(&self) -> Pass<'_> {
        Pass::new(&self.rows, self.work.jobs, self.work.progress)
    }
}

/// Predicts the spacings of the presses of `fold`, by a classifier fitted on the other folds.
fn classify_fold(
    seen: &[Seen],
    fold: usize,
    by: ByFold<'_>,
    predicted: &mut SpacingOfRow,
    work: Work<'_>,
) -> Result<(), EvaluateError> {
    let (asked, taught): (Vec<&Seen>, Vec<&Seen>) = seen.iter().partition(|seen| seen.fold == fold);
    if asked.is_empty() || taught.is_empty() {
        return Ok(());
    }
    if let ByFold::Model(classifier) = by {
        let of = |seen: &[&Seen]| -> Vec<Vec<f64>> {
            let spectra = seen.iter();
            spectra.map(|seen| seen.spectra[fold].clone()).collect()
        };
        let spacings: Vec<Nanometre> = taught.iter().map(|seen| seen.spacing).collect();
        let found = model::predict(classifier, &of(&taught), &spacings, &of(&asked), work)?;
        predicted.extend(asked.iter().map(|seen| seen.row).zip(found));
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
        predicted.insert(seen.row, boards[discriminant.class(&seen.spectra[fold])]);
    }
    Ok(())
}
