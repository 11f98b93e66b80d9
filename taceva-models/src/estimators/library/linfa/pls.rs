//! `linfa/pls`: partial least squares.

use linfa::Dataset;
use linfa::traits::{Fit, Predict};
use linfa_pls::PlsRegression;
use ndarray::Array2;
use rayon::prelude::*;
use taceva_core::{ErrorKind, ModelError, whole_size};

use super::{RELEASE, matrix, records};
use crate::estimators::library::adapter::{Adapter, Number, Numbers, Unset, any};
use crate::estimators::library::guard::guarded;
use crate::estimators::library::predictor::{Linear, Weighted};
use crate::estimators::library::{
    LibraryModel, LibrarySettings, LibrarySizes, LibraryTask, LoadedPredictor,
};
use crate::linalg::progress::interrupted;
use crate::settings::SettingInfo;
use crate::training::info::ModelInfo;

const NAME: &str = "linfa/pls";

const COMPONENTS: Number = Number {
    info: SettingInfo {
        key: "components",
        accepts: "a whole number from 1 to 200",
        default: "chosen for each channel",
        about: "number of directions of features that are kept",
    },
    range: [1.0, 200.0],
    is_whole: true,
    unset: Unset::ChosenAmong(&COUNTS),
};

/// Candidate numbers of components, descending. Of numbers with equal errors, the smallest is chosen.
const COUNTS: [f64; 9] = [30.0, 25.0, 20.0, 15.0, 10.0, 6.0, 4.0, 2.0, 1.0];

/// Number of rows per call when weights are computed from predictions.
const ROWS: usize = 256;

/// Partial least squares by power iterations (NIPALS), for all targets at once. The number of components is at most the number of features, and less
/// than the number of samples.
pub(super) static ADAPTER: Adapter = Adapter {
    model: LibraryModel {
        info: ModelInfo::of_library(
            NAME,
            "linfa: partial least squares, directions of features that vary most with the labels",
            &[
                LibrarySettings::SCALE,
                COMPONENTS.info,
                LibrarySettings::REFIT,
            ],
            |settings| ADAPTER.estimator(settings),
        ),
        release: RELEASE,
        work: |sizes| {
            let [samples, features, _] = sizes.real();
            // About a hundred power iterations for each of 114 + 30 components.
            Some(144.0 * 100.0 * samples * features)
        },
        load: Linear::load,
    },
    numbers: &[COMPONENTS],
    is_classifier: false,
    check: any,
    fit,
};

/// Weights and bias of each target, computed from the model's predictions for unit vectors.
fn weights(
    fitted: &PlsRegression<f64>,
    features: usize,
    targets: usize,
) -> Result<Vec<Weighted>, ModelError> {
    let zero = guarded(NAME, || {
        Ok::<_, ModelError>(fitted.predict(Array2::zeros((1, features))).targets)
    })?;
    let mut linear: Vec<Weighted> = zero.row(0).iter().map(|bias| (Vec::new(), *bias)).collect();
    for start in (0..features).step_by(ROWS) {
        let rows = ROWS.min(features - start);
        let mut units = Array2::zeros((rows, features));
        (0..rows).for_each(|row| units[(row, start + row)] = 1.0);
        let found = guarded(NAME, || Ok::<_, ModelError>(fitted.predict(units).targets))?;
        for (target, (weights, bias)) in linear.iter_mut().enumerate().take(targets) {
            weights.extend(found.column(target).iter().map(|value| value - *bias));
        }
    }
    Ok(linear)
}

fn fit(_: &Numbers<'_>, task: &LibraryTask<'_>) -> LoadedPredictor {
    let LibrarySizes {
        samples,
        features,
        targets,
    } = task.sizes;
    let most = features.min(samples - 1);
    let dataset = Dataset::new(records(task)?, matrix(task.labels, samples)?);
    let asked: Vec<usize> = task
        .values
        .iter()
        .map(|value| whole_size(*value).min(most))
        .collect();
    let mut counts = asked.clone();
    counts.sort_unstable();
    counts.dedup();
    let one = |count: &usize| {
        // The library fails on components beyond the explained variance: retries with fewer components.
        let mut outcome = Err(ModelError::new(ErrorKind::InvalidArgument, NAME));
        for tried in (1..=*count).rev() {
            interrupted(task.progress)?;
            outcome = guarded(NAME, || {
                PlsRegression::params(tried).scale(false).fit(&dataset)
            })
            .and_then(|fitted| weights(&fitted, features, targets))
            .and_then(|linear| {
                Linear::new(NAME, linear.clone())?;
                Ok(linear)
            });
            if outcome.is_ok() {
                break;
            }
        }
        outcome.map(|linear| (*count, linear))
    };
    let fitted: Vec<(usize, Vec<Weighted>)> = counts
        .par_iter()
        .map(one)
        .collect::<Result<_, ModelError>>()?;
    let of = |(target, count): (usize, &usize)| {
        let own = fitted.iter().find(|(known, _)| known == count);
        own.map(|(_, linear)| linear[target].clone())
    };
    let linear = asked.iter().enumerate().filter_map(of).collect();
    Ok(Box::new(Linear::new(NAME, linear)?))
}
