//! Fault of labels: noise of the force transducer that measures them.

use taceva_core::random::{fnv_1a, open_unit};
use taceva_core::{Column, Unit};
use taceva_dataset::Dataset;
use taceva_metrics::distributions::normal;
use taceva_models::Model;

use crate::fault::{Effect, Fault, NO_STIMULUS, Scope};
use crate::labels::{LabelChange, Labels};

pub(super) static FAULT: Fault = Fault {
    id: "force_noise",
    title: "labels of force have Gaussian noise: a bad transducer",
    parameter: "standard deviation, share of the greatest force of the channel",
    scope: Scope::Each,
    table: [0.001, 0.003, 0.01, 0.03, 0.1],
    most: 1.0,
    note: Some(NO_STIMULUS),
    effect: Effect::Labels(LabelChange { lacks, change }),
};

fn lacks(dataset: &Dataset, model: &Model, _: &[usize]) -> Option<&'static str> {
    let known = dataset.table().channels();
    let mut channels = model.channels().iter();
    let is_force = |channel: &taceva_core::Channel| {
        channel.unit() == Unit::Newton && known.position(channel.name()).is_some()
    };
    let has_force = channels.any(is_force);
    (!has_force).then_some("no force is both predicted and labelled")
}

fn change(labels: &Labels<'_>, share: f64) -> Column {
    if labels.channel.unit() != Unit::Newton {
        return labels.truth.clone();
    }
    let places = || 0..labels.truth.len();
    let known = places().filter_map(|place| labels.truth.get(place));
    let deviation = share * known.map(f64::abs).fold(0.0, f64::max);
    let samples = labels.table.samples();
    let noisy = places().map(|place| {
        let label = labels.truth.get(place)?;
        let sample = fnv_1a(samples[labels.rows[place]].as_bytes());
        let level = normal::quantile(open_unit(labels.draws.bits(sample)));
        Some(label + deviation * level)
    });
    noisy.collect()
}
