//! Spacings of gratings, predicted by a model that returns one of its training labels.

use taceva_core::{
    Channel, Channels, FeatureShape, Features, Nanometre, Regressor, Targets, TrainingSet, Unit,
    single,
};

use crate::classifier::ModelClassifier;
use taceva_evaluate::EvaluateError;
use taceva_evaluate::Work;

/// Predicts the spacings of boards with the spectra `asked`, by a model fitted on the spectra `known` with `spacings`.
pub(super) fn predict(
    classifier: &ModelClassifier,
    known: &[Vec<f64>],
    spacings: &[Nanometre],
    asked: &[Vec<f64>],
    work: Work<'_>,
) -> Result<Vec<Nanometre>, EvaluateError> {
    let estimator = classifier.model.estimator(&classifier.settings)?;
    let labels: Vec<f64> = spacings.iter().map(|one| one.to_millimetres()).collect();
    let channel = Channel::named("spacing", Unit::Millimetre).expect("a word");
    let channels = Channels::new([channel]).expect("one channel");
    let features = features(known)?;
    let training = TrainingSet::new(&features, Targets::new(&channels, &labels));
    let fit = estimator.fit_model(&training, None, work.progress)?;
    let mut found = vec![0.0; asked.len()];
    fit.regressor.predict(&self::features(asked)?, &mut found)?;
    let off = |label: f64, millimetres: f64| (label - millimetres).abs();
    let nearest = |millimetres: &f64| {
        let pairs = spacings.iter().zip(&labels);
        let nearest =
            pairs.min_by(|a, b| off(*a.1, *millimetres).total_cmp(&off(*b.1, *millimetres)));
        nearest.map(|(spacing, _)| *spacing)
    };
    Ok(found.iter().filter_map(nearest).collect())
}

fn features(spectra: &[Vec<f64>]) -> Result<Features, EvaluateError> {
    let width = spectra.first().map_or(0, Vec::len);
    let values = spectra.iter().flatten().copied().map(single);
    Ok(Features::new(FeatureShape::flat(width), values.collect())?)
}
