//! Scores of a confusion matrix with their names, definitions, intervals and constants.

use taceva_metrics::Range;

use super::margins::{Counted, Margins, PartMargins};
use crate::estimate::{Estimate, Part, estimate, share};
use crate::names::Names;
use crate::quotient::{Quotient, ratio, sum_over};
use crate::score::TaskScore;
use crate::undefined::Undefined;

type Score = Result<f64, Undefined>;

/// Counts of each class, in all clusters together and in each cluster.
struct Confusion<'a> {
    rule: &'a str,
    all: Margins,
    parts: &'a [PartMargins],
}

/// All scores, computed from the class counts `parts` of the clusters.
pub(super) fn scores(names: &Names, rule: &str, parts: &[PartMargins]) -> Vec<TaskScore> {
    let mut all = Margins::empty(names.len());
    for part in parts {
        all.add(part);
    }
    let confusion = Confusion { rule, all, parts };
    let mut scores = confusion.of_task();
    if let (Some(position), Some(name)) = (names.positive(), names.positive_name()) {
        scores.extend(confusion.of_positive(position, name));
    }
    for (position, name) in names.all().iter().enumerate() {
        scores.extend(confusion.of_class(position, name));
    }
    scores
}

impl Confusion<'_> {
    fn of_task(&self) -> Vec<TaskScore> {
        let all = &self.all;
        let accuracy = self.share(Margins::accuracy, all.accuracy_of_constant());
        let accuracy = self.score(
            "class_accuracy",
            "share of samples with the right class",
            accuracy,
        );
        let balanced = match all.in_truth() {
            0 => None,
            classes => Some(ratio(1, u128::from(classes))),
        };
        let balanced = self.share(Margins::balanced_accuracy, balanced);
        let macro_f1 = |variant: &str, counted, words: &str| {
            let value = move |of: &Margins| of.f1_macro(counted);
            let found = self.share(value, all.f1_macro_of_constant(counted));
            let score = self.score("f1_macro", &format!("mean F1 over {words}"), found);
            match variant {
                "" => score,
                _ => score.variant(variant),
            }
        };
        let weighted = self.share(Margins::f1_weighted, all.f1_weighted_of_constant());
        let kappa = self
            .estimate(Margins::kappa, |_| Range::BelowOne, Some(0.0))
            .at_least(-1.0);
        let mcc = self
            .estimate(Margins::mcc, |_| Range::BelowOne, Some(0.0))
            .at_least(-1.0);
        vec![
            accuracy.beside(all.right(), all.n),
            self.score(
                "balanced_accuracy",
                "mean recall over the classes in the truth",
                balanced,
            ),
            macro_f1(
                "",
                Counted::Seen,
                "the classes in the truth or among the predictions",
            ),
            macro_f1("in_truth", Counted::InTruth, "the classes in the truth"),
            macro_f1(
                "all_names",
                Counted::AllNames,
                "all names of the task, 0 for a class that is in neither",
            ),
            self.score(
                "f1_macro",
                "mean F1 over the classes in the truth, weighted by their samples",
                weighted,
            )
            .variant("weighted"),
            self.score(
                "kappa",
                "(p - e) / (1 - e), p the share of samples with the right class, e the same of independent labels with equal shares",
                kappa,
            ),
            self.score(
                "mcc",
                "correlation of the true with the predicted class (Matthews, for any number of classes)",
                mcc,
            ),
        ]
    }

    fn of_positive(&self, position: usize, name: &str) -> Vec<TaskScore> {
        let of = self.all.of[position];
        let [rejected, negatives] = self.all.rejected(position);
        let specificity = self.share(move |of: &Margins| of.specificity(position), None);
        let specificity = self.score(
            "specificity",
            &format!(
                "share of the samples of other classes than \"{name}\" that are predicted as others"
            ),
            specificity,
        );
        vec![
            self.f1("f1", position, name),
            self.precision(position, name).beside(of.hits, of.predicted),
            self.recall(position, name).beside(of.hits, of.truth),
            specificity.beside(rejected, negatives),
        ]
    }

    fn of_class(&self, position: usize, name: &str) -> Vec<TaskScore> {
        let of = self.all.of[position];
        let variant = format!("class {name}");
        let mut scores = vec![
            self.f1("f1_macro", position, name).variant(variant.clone()),
            self.precision(position, name)
                .variant(variant.clone())
                .beside(of.hits, of.predicted),
            self.recall(position, name)
                .variant(variant)
                .beside(of.hits, of.truth),
        ];
        for score in &mut scores {
            // Left-out scores of a thousand classes and clusters would take much memory.
            score.estimate.left_out = Vec::new();
        }
        scores
    }

    fn f1(&self, metric: &'static str, position: usize, name: &str) -> TaskScore {
        let of_constant = self.all.f1_of_constant(position);
        let found = self.share_of_class(position, Margins::f1, of_constant);
        let definition = format!("2 tp / (2 tp + fp + fn) of the class \"{name}\"");
        self.score(metric, &definition, found)
    }

    fn precision(&self, position: usize, name: &str) -> TaskScore {
        let found = self.share_of_class(position, Margins::precision, None);
        let definition = format!("tp / (tp + fp) of the class \"{name}\"");
        self.score("precision", &definition, found)
    }

    fn recall(&self, position: usize, name: &str) -> TaskScore {
        let found = self.share_of_class(position, Margins::recall, None);
        let definition = format!("tp / (tp + fn) of the class \"{name}\"");
        self.score("recall", &definition, found)
    }

    /// Score whose definition names the rule applied to the predictions.
    fn score(&self, metric: &'static str, definition: &str, found: Estimate) -> TaskScore {
        let definition = match self.rule {
            "" => definition.to_owned(),
            rule => format!("{definition}; predictions after {rule}"),
        };
        TaskScore::new(metric, definition, found)
    }

    /// Estimate of a number from 0 to 1.
    fn share(&self, value: impl Fn(&Margins) -> Score, of_constant: Option<f64>) -> Estimate {
        self.estimate(value, share, of_constant)
    }

    /// Estimate of a number from 0 to 1 that depends only on the counts of the class at `position`.
    fn share_of_class(
        &self,
        position: usize,
        value: fn(&Margins, usize) -> Score,
        of_constant: Option<f64>,
    ) -> Estimate {
        let found = value(&self.all, position);
        let parts = self.left_out(|part, left| match part.has(position) {
            true => value(left, position),
            // A cluster without the class changes nothing.
            false => found,
        });
        estimate(found, share(found), &parts, of_constant)
    }

    fn estimate(
        &self,
        value: impl Fn(&Margins) -> Score,
        range: impl Fn(Score) -> Range,
        of_constant: Option<f64>,
    ) -> Estimate {
        let found = value(&self.all);
        let parts = self.left_out(|_, left| value(left));
        estimate(found, range(found), &parts, of_constant)
    }

    /// Scores with one cluster left out, for each cluster. `value` receives the class counts of this cluster and of all other clusters.
    fn left_out(&self, value: impl Fn(&PartMargins, &Margins) -> Score) -> Vec<Part> {
        let mut left = self.all.clone();
        let parts = self.parts.iter().map(|part| {
            left.subtract(part);
            let value = value(part, &left);
            left.add(part);
            Part { n: part.n, value }
        });
        parts.collect()
    }
}

/// Scores of the best constant prediction.
impl Margins {
    fn accuracy_of_constant(&self) -> Option<f64> {
        (self.n > 0).then(|| ratio(u128::from(self.most()), u128::from(self.n)))
    }

    /// F1 of the class at `position` if all samples are predicted as this class: 2π / (1 + π) for the share π of the class; `None` for no sample.
    fn f1_of_constant(&self, position: usize) -> Option<f64> {
        let truth = self.of[position].truth;
        (self.n > 0).then(|| ratio(2 * u128::from(truth), u128::from(self.n + truth)))
    }

    fn f1_macro_of_constant(&self, counted: Counted) -> Option<f64> {
        let classes = match counted {
            Counted::AllNames => self.of.len() as u64,
            Counted::Seen | Counted::InTruth => self.in_truth(),
        };
        self.f1_of_most(1, classes)
    }

    fn f1_weighted_of_constant(&self) -> Option<f64> {
        self.f1_of_most(self.most(), self.n)
    }

    /// `weight` / `by` × F1 of the most frequent class, if all samples are predicted as this class; `None` for no sample.
    fn f1_of_most(&self, weight: u64, by: u64) -> Option<f64> {
        let f1 = Quotient {
            above: 2 * u128::from(self.most()) * u128::from(weight),
            below: self.n + self.most(),
        };
        (self.n > 0).then(|| sum_over(std::iter::once(f1), by))
    }
}
