//! `linfa/elastic-net`: multi-task elastic net, whose penalty drops a feature for all channels together.

use linfa::Dataset;
use linfa::traits::Fit;
use linfa_elasticnet::MultiTaskElasticNet;
use ndarray::Array2;
use rayon::prelude::*;
use taceva_core::ModelError;

use super::{RELEASE, columns, matrix};
use crate::estimators::library::adapter::{Adapter, Number, Numbers, Unset, any};
use crate::estimators::library::guard::guarded;
use crate::estimators::library::predictor::{Linear, Weighted};
use crate::estimators::library::{LibraryModel, LibrarySettings, LibraryTask, LoadedPredictor};
use crate::linalg::progress::interrupted;
use crate::settings::SettingInfo;
use crate::training::info::ModelInfo;

const NAME: &str = "linfa/elastic-net";

const STRENGTH: Number = Number {
    info: SettingInfo {
        key: "strength",
        accepts: "a number from 1e-4 to 1",
        default: "chosen for each channel",
        about: "the penalty on weights, relative to the least penalty that sets every weight to 0",
    },
    range: [1e-4, 1.0],
    is_whole: false,
    unset: Unset::ChosenAmong(&STRENGTHS),
};
const MIX: Number = Number {
    info: SettingInfo {
        key: "mix",
        accepts: "a number from 0.01 to 1",
        default: "0.5",
        about: "the share of the penalty that leaves features out: 1 is the group lasso",
    },
    range: [0.01, 1.0],
    is_whole: false,
    unset: Unset::Is(0.5),
};

/// Candidate strengths of the penalty, ascending, four per decade.
const STRENGTHS: [f64; 11] = [
    3.162_277_660_168_379e-3,
    5.623_413_251_903_491e-3,
    1e-2,
    1.778_279_410_038_923e-2,
    3.162_277_660_168_379e-2,
    5.623_413_251_903_491e-2,
    1e-1,
    1.778_279_410_038_923e-1,
    3.162_277_660_168_379e-1,
    5.623_413_251_903_491e-1,
    1.0,
];

/// Maximum number of sweeps over all features. A fit ends earlier if weights change by at most `TOLERANCE`.
const SWEEPS: u32 = 1000;
const TOLERANCE: f64 = 1e-4;

/// Multi-task elastic net: minimises ½n⁻¹ ‖Y − XW‖² + λ (α Σ‖wⱼ‖₂ + ½(1 − α)‖W‖²). X contains the features of n samples, Y their labels and W the
/// weights. wⱼ are the weights of feature j for every target. α is the setting `mix`.
///
/// λ is the strength of the penalty times the least λ at which every weight is 0. All targets are fitted together, once per strength. For each
/// target, the weights of its chosen strength are used.
pub(super) static ADAPTER: Adapter = Adapter {
    model: LibraryModel {
        info: ModelInfo::of_library(
            NAME,
            "linfa: multi-task elastic net, which leaves out features for all channels at once",
            &[
                LibrarySettings::SCALE,
                STRENGTH.info,
                MIX.info,
                LibrarySettings::REFIT,
            ],
            |settings| ADAPTER.estimator(settings),
        ),
        release: RELEASE,
        work: |sizes| {
            let [samples, features, targets] = sizes.real();
            let sweep = samples * features * (1.0 + 2.0 * targets);
            Some(12.0 * 250.0 * sweep)
        },
        load: Linear::load,
    },
    numbers: &[STRENGTH, MIX],
    is_classifier: false,
    check: any,
    fit,
};

/// Least penalty factor λ at which every weight of the elastic net is 0.
fn least(records: &Array2<f64>, targets: &Array2<f64>, mix: f64) -> f64 {
    let products = records.t().dot(targets);
    let lengths = products.rows().into_iter().map(|row| row.dot(&row).sqrt());
    lengths.fold(0.0, f64::max) / (records.nrows() as f64 * mix)
}

fn fit(set: &Numbers<'_>, task: &LibraryTask<'_>) -> LoadedPredictor {
    let mix = set.real(&MIX);
    let (records, targets) = (columns(task)?, matrix(task.labels, task.sizes.samples)?);
    let least = least(&records, &targets, mix);
    let dataset = Dataset::new(records, targets);
    let mut strengths = task.values.to_vec();
    strengths.sort_by(f64::total_cmp);
    strengths.dedup_by(|a, b| a.total_cmp(b).is_eq());
    let one = |strength: &f64| {
        interrupted(task.progress)?;
        let estimator = MultiTaskElasticNet::params()
            .penalty(strength * least)
            .l1_ratio(mix)
            .with_intercept(true)
            .max_iterations(SWEEPS)
            .tolerance(TOLERANCE);
        let fitted = guarded(NAME, || estimator.fit(&dataset))?;
        Ok((*strength, fitted))
    };
    let fitted: Vec<(f64, MultiTaskElasticNet<f64>)> = strengths
        .par_iter()
        .map(one)
        .collect::<Result<_, ModelError>>()?;
    let of = |(target, value): (usize, &f64)| {
        let own = fitted
            .iter()
            .find(|(strength, _)| strength.total_cmp(value).is_eq());
        own.map(|(_, fitted)| {
            let weights = fitted.hyperplane().column(target).to_vec();
            (weights, fitted.intercept()[target])
        })
    };
    let linear: Vec<Weighted> = task.values.iter().enumerate().filter_map(of).collect();
    Ok(Box::new(Linear::new(NAME, linear)?))
}
