//! Sums of squares and variance components, in exact arithmetic.

use taceva_metrics::distributions::f_ratio;
use taceva_metrics::{Dyadic, ExactSum, Fraction};

use super::cells::Balanced;
use super::table::{Source, TableRow};
use super::{Design, GaugeSettings};

/// A sum of squares with its degrees of freedom.
#[derive(Clone, Debug)]
pub(super) struct Square {
    pub(super) df: u64,
    pub(super) sum: Fraction,
}

impl Square {
    pub(super) fn mean(&self) -> Fraction {
        self.sum.divided(self.df)
    }

    fn with(&self, other: &Square) -> Square {
        Square {
            df: self.df + other.df,
            sum: self.sum.plus(&other.sum),
        }
    }
}

/// Sums of squares of a study.
#[derive(Clone, Debug)]
pub(super) struct Squares {
    pub(super) operator: Square,
    pub(super) part: Square,
    /// Interaction of parts and operators; `None` if parts are nested in operators.
    pub(super) interaction: Option<Square>,
    pub(super) repeatability: Square,
    total: Square,
}

/// Variance components before negative estimates are replaced by 0.
#[derive(Clone, Debug)]
pub(super) struct Raw {
    pub(super) repeatability: Fraction,
    pub(super) operator: Fraction,
    pub(super) interaction: Option<Fraction>,
    pub(super) part: Fraction,
}

/// Variance components, analysis-of-variance table and decision about the interaction.
pub(super) struct Anova {
    pub(super) raw: Raw,
    pub(super) table: Vec<TableRow>,
    pub(super) is_pooled: bool,
}

pub(super) fn count(of: usize) -> u64 {
    u64::try_from(of).unwrap_or(u64::MAX)
}

impl Squares {
    pub(super) fn of(study: &Balanced, design: Design) -> Squares {
        let (o, p) = (count(study.operators), count(study.parts));
        let r = count(study.trials);
        let all = o * p * r;
        let squared = |sum: &ExactSum| {
            let sum = sum.to_dyadic();
            &sum * &sum
        };
        let mut of_operators = vec![ExactSum::default(); study.operators];
        let mut of_parts = vec![ExactSum::default(); study.parts];
        let (mut total, mut values) = (ExactSum::default(), ExactSum::default());
        let mut cells = Dyadic::from(0);
        for (at, cell) in study.cells().enumerate() {
            let sum: ExactSum = cell.iter().copied().collect();
            cells = &cells + &squared(&sum);
            of_operators[at / study.parts].merge(&sum);
            of_parts[at % study.parts].merge(&sum);
            cell.iter()
                .for_each(|&value| values.add_product(value, value));
        }
        of_operators.iter().for_each(|sum| total.merge(sum));
        let together = |sums: &[ExactSum]| {
            let squares = sums.iter().map(squared);
            squares.fold(Dyadic::from(0), |sum, square| &sum + &square)
        };
        let mean = Fraction::of(squared(&total), all);
        let operators = Fraction::of(together(&of_operators), p * r);
        let cells = Fraction::of(cells, r);
        let values = Fraction::of(values.to_dyadic(), 1);
        let operator = Square {
            df: o - 1,
            sum: operators.minus(&mean),
        };
        let (part, interaction) = match design {
            Design::Crossed => {
                let parts = Fraction::of(together(&of_parts), o * r);
                let both = operators.plus(&parts);
                let interaction = Square {
                    df: (o - 1) * (p - 1),
                    sum: cells.plus(&mean).minus(&both),
                };
                let part = Square {
                    df: p - 1,
                    sum: parts.minus(&mean),
                };
                (part, Some(interaction))
            }
            Design::Nested => {
                let part = Square {
                    df: o * (p - 1),
                    sum: cells.minus(&operators),
                };
                (part, None)
            }
        };
        Squares {
            operator,
            part,
            interaction,
            repeatability: Square {
                df: o * p * (r - 1),
                sum: values.minus(&cells),
            },
            total: Square {
                df: all - 1,
                sum: values.minus(&mean),
            },
        }
    }

    /// Ratio of mean squares and its p value; `None` if the denominator is 0.
    fn ratio(above: &Square, below: &Square) -> Option<[f64; 2]> {
        let ratio = above.mean().over(&below.mean())?;
        Some([ratio, f_ratio::above(ratio, real(above.df), real(below.df))])
    }

    pub(super) fn components(&self, study: &Balanced, settings: &GaugeSettings) -> Anova {
        let (o, p) = (count(study.operators), count(study.parts));
        let r = count(study.trials);
        let row = |source, square: &Square, ratio: Option<[f64; 2]>| TableRow {
            source,
            df: square.df,
            ss: square.sum.to_f64(),
            ms: (source != Source::Total).then(|| square.mean().to_f64()),
            f: ratio.map(|[f, _]| f),
            p: ratio.map(|[_, p]| p),
        };
        let excess =
            |above: &Square, below: &Square, n| above.mean().minus(&below.mean()).divided(n);
        let error = &self.repeatability;
        let total = row(Source::Total, &self.total, None);
        let Some(interaction) = &self.interaction else {
            return Anova {
                raw: Raw {
                    repeatability: error.mean(),
                    operator: excess(&self.operator, &self.part, p * r),
                    interaction: None,
                    part: excess(&self.part, error, r),
                },
                table: vec![
                    row(
                        Source::Operator,
                        &self.operator,
                        Squares::ratio(&self.operator, &self.part),
                    ),
                    row(Source::Part, &self.part, Squares::ratio(&self.part, error)),
                    row(Source::Repeatability, error, None),
                    total,
                ],
                is_pooled: false,
            };
        };
        let of_interaction = Squares::ratio(interaction, error);
        let is_pooled = of_interaction.is_some_and(|[_, p]| p > settings.pool);
        let pooled = interaction.with(error);
        let below = if is_pooled { &pooled } else { interaction };
        let mut table = vec![
            row(
                Source::Operator,
                &self.operator,
                Squares::ratio(&self.operator, below),
            ),
            row(Source::Part, &self.part, Squares::ratio(&self.part, below)),
            row(Source::Interaction, interaction, of_interaction),
            row(Source::Repeatability, error, None),
        ];
        if is_pooled {
            table.push(row(Source::Pooled, &pooled, None));
        }
        table.push(total);
        Anova {
            raw: Raw {
                repeatability: if is_pooled {
                    pooled.mean()
                } else {
                    error.mean()
                },
                operator: excess(&self.operator, below, p * r),
                interaction: Some(match is_pooled {
                    true => Fraction::zero(),
                    false => excess(interaction, error, r),
                }),
                part: excess(&self.part, below, o * r),
            },
            table,
            is_pooled,
        }
    }
}

pub(super) fn real(count: u64) -> f64 {
    count as f64
}
