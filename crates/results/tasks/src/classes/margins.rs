//! Scores of a confusion matrix from its row and column sums.

use taceva_metrics::Dyadic;

use crate::quotient::{Quotient, exact, ratio, sum_over};
use crate::undefined::Undefined;

/// Counts of one class.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Margin {
    /// Number of samples of the class.
    pub(crate) truth: u64,
    /// Number of samples predicted as the class.
    pub(crate) predicted: u64,
    /// Number of samples of the class that are predicted as the class.
    pub(crate) hits: u64,
}

impl Margin {
    /// Recall: hits divided by the samples of the class.
    fn recall(self) -> Quotient {
        quotient(self.hits, self.truth)
    }

    /// F1: 2 hits / (samples of the class + samples predicted as the class), which is 2 tp / (2 tp + fp + fn).
    fn f1(self) -> Quotient {
        quotient(2 * self.hits, self.truth + self.predicted)
    }

    fn is_seen(self) -> bool {
        self.truth + self.predicted > 0
    }
}

fn quotient(above: u64, below: u64) -> Quotient {
    Quotient {
        above: u128::from(above),
        below,
    }
}

/// Counts of the class with this position among the names.
#[derive(Clone, Debug)]
struct ClassMargin {
    position: usize,
    margin: Margin,
}

/// Counts of each class that occurs in a cluster. Other classes are omitted to save memory.
#[derive(Clone, Debug, Default)]
pub(crate) struct PartMargins {
    /// Number of samples.
    pub(crate) n: u64,
    /// Counts in the order of positions.
    of: Vec<ClassMargin>,
}

impl PartMargins {
    /// Adds `count` samples of the class `truth` that are predicted as `predicted`.
    pub(crate) fn add(&mut self, truth: u32, predicted: u32, count: u64) {
        self.n += count;
        self.margin(truth).truth += count;
        self.margin(predicted).predicted += count;
        if truth == predicted {
            self.margin(truth).hits += count;
        }
    }

    /// True if the class at `position` occurs.
    pub(crate) fn has(&self, position: usize) -> bool {
        self.find(position).is_ok()
    }

    /// Index of the class at `position`; an `Err` contains the index at which to insert the class.
    fn find(&self, position: usize) -> Result<usize, usize> {
        self.of.binary_search_by_key(&position, |of| of.position)
    }

    fn margin(&mut self, position: u32) -> &mut Margin {
        let position = position as usize;
        let at = self.find(position).unwrap_or_else(|at| {
            let margin = Margin::default();
            self.of.insert(at, ClassMargin { position, margin });
            at
        });
        &mut self.of[at].margin
    }
}

/// Classes that a mean of F1 includes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Counted {
    /// Classes in the truth or among the predictions.
    Seen,
    /// Classes in the truth.
    InTruth,
    /// All names; a class without true or predicted samples has F1 = 0.
    AllNames,
}

/// Counts of each class, from a confusion matrix.
#[derive(Clone, Debug)]
pub(crate) struct Margins {
    /// Number of samples.
    pub(crate) n: u64,
    /// Counts by position of the class.
    pub(crate) of: Vec<Margin>,
}

type Score = Result<f64, Undefined>;

impl Margins {
    /// Counts of 0 for each of `classes` classes.
    pub(crate) fn empty(classes: usize) -> Margins {
        Margins {
            n: 0,
            of: vec![Margin::default(); classes],
        }
    }

    /// Adds the samples of `part`.
    pub(crate) fn add(&mut self, part: &PartMargins) {
        self.n += part.n;
        for ClassMargin { position, margin } in &part.of {
            let of = &mut self.of[*position];
            of.truth += margin.truth;
            of.predicted += margin.predicted;
            of.hits += margin.hits;
        }
    }

    /// Subtracts the samples of `part`. These margins must include `part`.
    pub(crate) fn subtract(&mut self, part: &PartMargins) {
        self.n -= part.n;
        for ClassMargin { position, margin } in &part.of {
            let of = &mut self.of[*position];
            of.truth -= margin.truth;
            of.predicted -= margin.predicted;
            of.hits -= margin.hits;
        }
    }

    /// Number of samples with the right class.
    pub(crate) fn right(&self) -> u64 {
        self.of.iter().map(|margin| margin.hits).sum()
    }

    /// Number of classes in the truth.
    pub(crate) fn in_truth(&self) -> u64 {
        self.of.iter().map(|of| u64::from(of.truth > 0)).sum()
    }

    /// Number of samples of the most frequent class.
    pub(crate) fn most(&self) -> u64 {
        self.of.iter().map(|of| of.truth).max().unwrap_or(0)
    }

    /// Share of samples with the right class.
    pub(crate) fn accuracy(&self) -> Score {
        self.over(self.right(), self.n, Undefined::Empty)
    }

    /// Mean recall of the classes in the truth.
    pub(crate) fn balanced_accuracy(&self) -> Score {
        let classes = self.in_truth();
        let in_truth = self.of.iter().filter(|of| of.truth > 0);
        match classes {
            0 => Err(Undefined::Empty),
            _ => Ok(sum_over(in_truth.map(|of| of.recall()), classes)),
        }
    }

    /// Mean F1 of the classes that `counted` names.
    pub(crate) fn f1_macro(&self, counted: Counted) -> Score {
        let counts = |of: &&Margin| match counted {
            Counted::Seen => of.is_seen(),
            Counted::InTruth => of.truth > 0,
            Counted::AllNames => true,
        };
        let classes = self.of.iter().filter(counts).count() as u64;
        // A class without true or predicted samples has no F1 and adds 0 to a mean of all names.
        let of = self.of.iter().filter(counts).filter(|of| of.is_seen());
        match self.n {
            0 => Err(Undefined::Empty),
            _ => Ok(sum_over(of.map(|of| of.f1()), classes)),
        }
    }

    /// Mean F1 of the classes in the truth, weighted by their samples.
    pub(crate) fn f1_weighted(&self) -> Score {
        let weighted = self.of.iter().filter(|of| of.truth > 0).map(|of| {
            let Quotient { above, below } = of.f1();
            Quotient {
                above: above * u128::from(of.truth),
                below,
            }
        });
        match self.n {
            0 => Err(Undefined::Empty),
            n => Ok(sum_over(weighted, n)),
        }
    }

    /// F1 of the class at `position`.
    pub(crate) fn f1(&self, position: usize) -> Score {
        let of = self.of[position];
        self.over(2 * of.hits, of.truth + of.predicted, Undefined::NoPositive)
    }

    /// Precision of the class at `position`.
    pub(crate) fn precision(&self, position: usize) -> Score {
        let of = self.of[position];
        self.over(of.hits, of.predicted, Undefined::NoPrediction)
    }

    /// Recall of the class at `position`.
    pub(crate) fn recall(&self, position: usize) -> Score {
        let of = self.of[position];
        self.over(of.hits, of.truth, Undefined::NoPositive)
    }

    /// Number of true negatives of the class at `position`, and number of all its negatives.
    pub(crate) fn rejected(&self, position: usize) -> [u64; 2] {
        let of = self.of[position];
        let negatives = self.n - of.truth;
        [negatives - (of.predicted - of.hits), negatives]
    }

    /// Specificity of the class at `position`: true negatives divided by all negatives.
    pub(crate) fn specificity(&self, position: usize) -> Score {
        let [rejected, negatives] = self.rejected(position);
        self.over(rejected, negatives, Undefined::NoNegative)
    }

    /// Cohen's kappa: agreement beyond chance, divided by the greatest possible agreement beyond chance.
    pub(crate) fn kappa(&self) -> Score {
        let n = &exact(u128::from(self.n));
        let by_chance = &self.products(|of| [of.truth, of.predicted]);
        let below = &(n * n) - by_chance;
        if below.is_zero() {
            return Err(self.one_class());
        }
        let right = &exact(u128::from(self.right()));
        Ok((&(n * right) - by_chance).over(&below))
    }

    /// Matthews' correlation of truth and prediction, for any number of classes.
    pub(crate) fn mcc(&self) -> Score {
        let n = &exact(u128::from(self.n));
        let spread =
            |margin: fn(&Margin) -> u64| &(n * n) - &self.products(|of| [margin(of), margin(of)]);
        let below = &spread(|of| of.truth) * &spread(|of| of.predicted);
        if below.is_zero() {
            return Err(self.one_class());
        }
        let right = &exact(u128::from(self.right()));
        let above = &(n * right) - &self.products(|of| [of.truth, of.predicted]);
        let root = (&above * &above).root_over(&below);
        Ok(if above.is_negative() { -root } else { root })
    }

    /// Sum over the classes of the product of the two counts that `of` returns.
    fn products(&self, of: impl Fn(&Margin) -> [u64; 2]) -> Dyadic {
        let products = self.of.iter().map(of);
        exact(
            products
                .map(|[left, right]| u128::from(left) * u128::from(right))
                .sum(),
        )
    }

    fn one_class(&self) -> Undefined {
        match self.n {
            0 => Undefined::Empty,
            _ => Undefined::OneClass,
        }
    }

    /// Quotient of `above` and `below`. Error: `Undefined::Empty` without samples, else `reason` if `below` is 0.
    fn over(&self, above: u64, below: u64, reason: Undefined) -> Score {
        match (self.n, below) {
            (0, _) => Err(Undefined::Empty),
            (_, 0) => Err(reason),
            _ => Ok(ratio(u128::from(above), u128::from(below))),
        }
    }
}
