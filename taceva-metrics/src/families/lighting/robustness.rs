//! Robustness of errors to lighting.

use taceva_core::{Field, FieldSet, Needs, Unit};

use super::change::Change;
use super::sums::LightingSums;
use crate::evaluate::family::{Details, Numbers};
use crate::evaluate::metric::{Metric, ScoreUnit};
use crate::exact::{Dyadic, ExactSum};
use crate::families::lighting::KIND;
use crate::score::direction::Better;
use crate::score::flag::Flag;
use crate::score::matrix::Matrix;
use crate::score::range::Range;
use crate::score::sensor_facts::Fact;
use crate::score::theme::Theme;
use crate::score::value::{Finished, UndefinedReason, Value};
use crate::score::{Count, Variant};

pub(crate) static R_LIGHT: Metric = Metric {
    id: "r_light",
    title: "robustness to lighting",
    symbol: Some("$R_{\\mathrm{light}}$"),
    theme: Theme::Robustness,
    better: Better::Higher,
    unit: ScoreUnit::One,
    range: Range::Ratio,
    definition: "r_light/1",
    reference: "TacEva, equation (8)",
    documentation: "Robustness of the error to light: the change of brightness over the sum of the changes of brightness and error, each \
                    relative to the reference scene; the mean over scenes with a defined ratio. A decrease of the error counts like an \
                    increase; `plus` counts increases only. `scenes` has the ratios of each scene; a scene whose light hardly changed \
                    says little.",
    needs: Needs::new(
        FieldSet::EMPTY
            .with(Field::Truth)
            .with(Field::Prediction)
            .with(Field::Scene)
            .with(Field::Intensity),
    )
    .with_least_samples(1),
    facts: &[Fact::NotOpaque],
    reads_unbounded: true,
    ..Metric::of(&KIND)
};

/// Brightness and error of each lighting scene, compared with the scene `reference`.
pub(super) fn changes<'a>(
    sums: &'a LightingSums,
    reference: &str,
) -> Result<Vec<(&'a str, Change)>, UndefinedReason> {
    if sums.scenes.is_empty() {
        return Err(UndefinedReason::Empty);
    }
    let baseline = sums.scenes.get(reference);
    let baseline = baseline.ok_or(UndefinedReason::NoReferenceScene)?;
    let others = sums.scenes.iter().filter(|(scene, _)| *scene != reference);
    let changes = others.map(|(scene, sums)| (scene.as_str(), Change::between(sums, baseline)));
    let changes: Vec<_> = changes.collect();
    if changes.is_empty() {
        return Err(UndefinedReason::OneScene);
    }
    Ok(changes)
}

/// Name of the variant that holds the robustness to `scene`.
pub(super) fn variant_of(scene: &str) -> String {
    format!("scene:{scene}")
}

/// Robustness to lighting: the mean over the scenes with a defined robustness, rounded once. The robustness to each scene is a variant.
pub(super) fn robustness(sums: &LightingSums, reference: &str) -> Numbers {
    let changes = match changes(sums, reference) {
        Ok(changes) => changes,
        Err(reason) => return Numbers::of(Err(reason)),
    };
    let mean =
        |of: fn(Change) -> Finished| mean_of_defined(changes.iter().map(|(_, change)| of(*change)));
    let all = Numbers::of(mean(Change::robustness)).with(
        "plus",
        Unit::One,
        Range::RatioWithEnds,
        mean(Change::robustness_plus),
    );
    changes.iter().fold(all, |numbers, (scene, change)| {
        numbers.with(
            variant_of(scene),
            Unit::One,
            Range::Ratio,
            change.robustness(),
        )
    })
}

/// Mean of the defined values, rounded once. Returns the first reason if no value is defined.
pub(super) fn mean_of_defined(values: impl Iterator<Item = Finished>) -> Finished {
    let mut reason = None;
    let (mut sum, mut defined) = (ExactSum::default(), 0_u64);
    for value in values {
        match value {
            Ok(value) => {
                sum.add(value);
                defined += 1;
            }
            Err(undefined) => reason = reason.or(Some(undefined)),
        }
    }
    if defined == 0 {
        return Err(reason.unwrap_or(UndefinedReason::Empty));
    }
    Ok(sum.to_dyadic().over(&Dyadic::from(defined)))
}

/// Ratios of brightness and error of each lighting scene, counts of scenes, and flags.
pub(super) fn details(sums: &LightingSums, reference: &str) -> Details {
    let Ok(changes) = changes(sums, reference) else {
        return Details::default();
    };
    let row = |change: &Change| {
        let [intensity, error] = change.ratios();
        let [own, plus] = [change.robustness(), change.robustness_plus()].map(Finished::ok);
        vec![intensity, error, own, plus]
    };
    let columns = ["intensity_ratio", "error_ratio", "r_light", "plus"];
    let scenes = Value::Matrix(Matrix {
        rows: changes
            .iter()
            .map(|(scene, _)| (*scene).to_owned())
            .collect(),
        columns: columns.map(str::to_owned).to_vec(),
        values: changes.iter().map(|(_, change)| row(change)).collect(),
    });
    let defined = changes
        .iter()
        .filter(|(_, change)| change.robustness().is_ok());
    let count = |name, value| Count { name, value };
    Details {
        variants: vec![Variant::plain("scenes", Unit::One, scenes)],
        counts: vec![
            count("scenes", changes.iter().fold(0, |scenes, _| scenes + 1)),
            count("scenes_defined", defined.fold(0, |defined, _| defined + 1)),
        ],
        flags: flags(&[sums], reference),
        ..Details::default()
    }
}

/// Flags raised by any lighting scene in any channel of `parts`.
pub(super) fn flags(parts: &[&LightingSums], reference: &str) -> Vec<Flag> {
    let found = parts
        .iter()
        .filter_map(|sums| changes(sums, reference).ok());
    let all: Vec<Change> = found.flatten().map(|(_, change)| change).collect();
    let flag = |flag: Flag, raised: fn(Change) -> bool| {
        let raised = all.iter().any(|change| raised(*change));
        raised.then_some(flag)
    };
    let flags = [
        flag(Flag::LowStimulus, Change::is_low_stimulus),
        flag(Flag::ImprovedError, Change::is_improved),
    ];
    flags.into_iter().flatten().collect()
}

/// Robustness of a plane. Its error in each scene is the mean of the mean absolute errors of both axes.
pub(super) fn of_plane(parts: [&LightingSums; 2], reference: &str) -> Finished {
    let [x, y] = [changes(parts[0], reference)?, changes(parts[1], reference)?];
    let along_y = |scene: &str| {
        let found = y.iter().find(|(other, _)| *other == scene);
        found.map(|(_, change)| change.error)
    };
    mean_of_defined(x.iter().filter_map(|(scene, change)| {
        let [along_x, along_y] = [change.error, along_y(scene)?];
        let error = [0, 1].map(|at| crate::evaluate::family::midpoint(along_x[at], along_y[at]));
        Some(Change { error, ..*change }.robustness())
    }))
}
