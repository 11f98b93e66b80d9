//! Creates the cards of newly fitted models.

use super::input::FitInput;
use crate::training::card::{AutoCard, ChannelCard, ModelCard, SampleCounts};
use crate::training::fit::ModelFit;
use crate::training::label_scaling::label_means;

/// Maximum distance of predictions beyond the training labels, as a share of the label range.
pub(super) const MARGIN: f64 = 0.25;

impl ModelCard {
    pub(super) fn new(
        input: &FitInput<'_>,
        fit: &ModelFit,
        model: &str,
        auto: Option<AutoCard>,
        pca_variance: Option<f64>,
        spread: Option<Vec<f64>>,
    ) -> ModelCard {
        let kind = fit.regressor.kind();
        let channels = input.training.targets.channels.iter().enumerate();
        let means = label_means(input.training.targets);
        ModelCard {
            format: ModelCard::FORMAT.into(),
            taceva: env!("CARGO_PKG_VERSION").into(),
            model: model.into(),
            settings: input.settings.words().collect(),
            choice: fit.choice.clone(),
            refitted: fit.refitted,
            features: input.features,
            pca_variance,
            input: input.input,
            spread,
            margin: MARGIN,
            channels: channels
                .map(|(position, channel)| ChannelCard {
                    name: channel.name().into(),
                    unit: channel.unit(),
                    minimum: fit.scaling.minimum()[position],
                    span: fit.scaling.span()[position],
                    mean: means[position],
                    constant_label: fit.scaling.is_constant(position),
                })
                .collect(),
            angles: Vec::new(),
            distance: None,
            samples: SampleCounts {
                train: input.training.features.samples(),
                validation: input.validation.map_or(0, |set| set.features.samples()),
            },
            provenance: input.provenance.clone(),
            auto,
            feature_choice: None,
            form: kind.form,
            network: kind.network,
            ensemble: kind.ensemble,
            library: kind.library,
            plugin: kind.plugin,
        }
    }
}
