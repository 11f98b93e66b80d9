//! Scores of predictions with and without faults.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;

use taceva_core::{Channel, Channels, Column, Field};
use taceva_dataset::Dataset;
use taceva_evaluate::{Columns, EvaluateError, Target, accumulate};
use taceva_metrics::{MetricPlan, PLANES, Score, catalogue, plane_axes};
use taceva_models::Model;

use crate::estimate::{Estimate, Undefined};
use crate::ratio::{Errors, Share, mean_ratio};
use crate::report::{ByChannel, CellScore, CleanScore};

pub(crate) const MAE: &str = "mae";
pub(crate) const SKILL: &str = "skill";

/// Scorer that compares predictions of the same rows with their labels.
pub(crate) struct Scorer<'a> {
    dataset: &'a Dataset,
    rows: &'a [usize],
    plan: MetricPlan,
    /// Indices of the scored channels among the predictions of a sample. `width` is the number of these predictions.
    positions: Vec<usize>,
    width: usize,
    truth: Vec<Column>,
    groups: Option<&'a [String]>,
    /// Cluster of each row, if every row has a cluster.
    clusters: Option<Vec<String>>,
    jobs: NonZeroUsize,
}

/// Scores of one set of predictions.
pub(crate) struct Scored {
    /// Mean absolute error of each channel, in the type from which differences are computed.
    pub(crate) scores: ByChannel<Score>,
    pub(crate) mae: ByChannel<Estimate>,
    skill: ByChannel<Estimate>,
    /// Further metrics that the request names, by metric and channel.
    pub(crate) others: BTreeMap<&'static str, ByChannel<Estimate>>,
    pub(crate) errors: ByChannel<Errors>,
    /// Least and greatest mean absolute error among the random draws of the fault; empty for one draw.
    spread: ByChannel<[f64; 2]>,
}

impl<'a> Scorer<'a> {
    /// Creates a scorer of `rows` for the channels of `model`, except angles. `metrics` names metrics in addition to error and skill.
    pub(crate) fn new(
        dataset: &'a Dataset,
        model: &Model,
        target: &'a Target,
        rows: &'a [usize],
        metrics: &[String],
        jobs: NonZeroUsize,
    ) -> Result<Scorer<'a>, EvaluateError> {
        let asked = model.channels().iter().enumerate();
        let scored = asked.filter(|(_, channel)| channel.period().is_none());
        let (positions, channels): (Vec<usize>, Vec<Channel>) =
            scored.map(|(at, channel)| (at, *channel)).unzip();
        let truth = channels.iter();
        let truth = truth.map(|channel| taceva_evaluate::truth(dataset, channel, rows));
        let truth = truth.collect::<Result<Vec<Column>, _>>()?;
        let channels = Channels::new(channels).expect("a subset of distinct channels is distinct");
        if channels.is_empty() {
            return Err(EvaluateError::Request(
                "the model predicts only angles, but faults are scored by other channels"
                    .to_owned(),
            ));
        }
        let constants: BTreeMap<String, f64> = model
            .constants()
            .map(|(name, constant)| (name.to_owned(), constant))
            .collect();
        let named = metrics.iter().map(String::as_str);
        let metrics = catalogue::select(named.chain([MAE, SKILL]))?;
        let available = dataset.fields().with(Field::Prediction);
        let plan = MetricPlan::new(&metrics, channels, available).with_constants(constants)?;
        let divided = target.divided.as_ref();
        let is_independent = divided.is_some_and(|divided| divided.are_independent);
        let groups = divided.and_then(|divided| divided.groups.as_deref());
        let table = dataset.table();
        let (plan, clusters): (MetricPlan, Option<Vec<String>>) = match (is_independent, groups) {
            (true, _) => {
                let samples = rows.iter().map(|row| Some(table.samples()[*row].clone()));
                (plan.independent_samples(), samples.collect())
            }
            (false, Some(groups)) => {
                let names = rows.iter().map(|row| Some(groups[*row].clone()));
                (plan.by_group(), names.collect())
            }
            (false, None) => {
                let points = rows.iter().map(|row| table.point_id()[*row].clone());
                (plan, points.collect())
            }
        };
        Ok(Scorer {
            dataset,
            rows,
            plan,
            width: model.channels().len(),
            positions,
            truth,
            groups,
            clusters,
            jobs,
        })
    }

    /// Creates a scorer of the same presses on a worn gel. `rows` are their rows in the recording `worn`.
    pub(crate) fn of_worn<'w>(
        &'w self,
        worn: &'w Dataset,
        rows: &'w [usize],
    ) -> Result<Scorer<'w>, EvaluateError> {
        if self.groups.is_some() {
            return Err(EvaluateError::Request(
                "faults of the gel: the samples are divided by groups, expected contact points"
                    .to_owned(),
            ));
        }
        let truth = self.plan.channels().iter();
        let truth = truth.map(|channel| taceva_evaluate::truth(worn, channel, rows));
        Ok(Scorer {
            dataset: worn,
            rows,
            plan: self.plan.clone(),
            positions: self.positions.clone(),
            width: self.width,
            truth: truth.collect::<Result<Vec<Column>, _>>()?,
            groups: None,
            clusters: self.clusters.clone(),
            jobs: self.jobs,
        })
    }

    /// Creates a scorer of the same samples with other labels: `truth` has one column for each of [`labels`](Scorer::labels).
    pub(crate) fn with_labels(&self, truth: Vec<Column>) -> Scorer<'a> {
        Scorer {
            plan: self.plan.clone(),
            positions: self.positions.clone(),
            truth,
            clusters: self.clusters.clone(),
            ..*self
        }
    }

    /// Scored channels, each with its labels.
    pub(crate) fn labels(&self) -> impl Iterator<Item = (&Channel, &Column)> {
        self.plan.channels().iter().zip(&self.truth)
    }

    /// Compares `predictions` with the labels.
    ///
    /// # Shapes
    /// `[rows, draws, channels of the model]`.
    pub(crate) fn score(&self, predictions: &[f64]) -> Result<Scored, EvaluateError> {
        let columns = self.positions.iter().map(|position| {
            let own = predictions.iter().skip(*position).step_by(self.width);
            Column::full(own.copied().collect())
        });
        let columns: Vec<Column> = columns.collect();
        let draws = self.draws(&columns);
        let places: Vec<usize> = (0..draws * self.rows.len())
            .map(|place| place / draws)
            .collect();
        let of_places =
            |column: &Column| -> Column { places.iter().map(|place| column.get(*place)).collect() };
        let truth = self.truth.iter().map(of_places);
        let truth: Vec<Column> = truth.collect();
        let rows: Vec<usize> = places.iter().map(|place| self.rows[*place]).collect();
        let source = Columns {
            truth: &truth,
            prediction: &columns,
            dataset: self.dataset,
            rows: &rows,
            groups: self.groups,
        };
        let evaluation = accumulate(&source, &self.plan, self.jobs)?.finish()?;
        let of_metric = |id: &str| -> ByChannel<Estimate> {
            let scores = evaluation.scores().filter(|(metric, ..)| metric.id == id);
            let scores = scores.map(|(_, name, score)| (name.to_owned(), Estimate::of(score)));
            scores.collect()
        };
        let scores = evaluation
            .scores()
            .filter(|(metric, ..)| metric.id == MAE)
            .map(|(_, name, score)| (name.to_owned(), score.clone()))
            .collect();
        let others = self.plan.kept().iter().map(|metric| metric.id);
        let others = others.filter(|id| ![MAE, SKILL].contains(id));
        let mae = of_metric(MAE);
        let errors = mae.keys();
        let errors = errors.map(|name| (name.clone(), self.errors(name, &columns)));
        let spread = mae.keys().filter(|_| draws > 1);
        let spread = spread.map(|name| (name.clone(), self.spread(name, &columns)));
        Ok(Scored {
            scores,
            spread: spread.collect(),
            errors: errors.collect(),
            skill: of_metric(SKILL),
            others: others.map(|id| (id, of_metric(id))).collect(),
            mae,
        })
    }

    /// Unit of each scored channel and plane.
    pub(crate) fn units(&self, of: &Scored) -> ByChannel<&'static str> {
        let unit = |name: &String| {
            let axis = plane_axes(name).map_or(name.as_str(), |[axis, _]| axis);
            let channel = self.plan.channels().by_name(axis);
            let unit = channel.map_or("", |channel| channel.unit().symbol());
            (name.clone(), unit)
        };
        of.mae.keys().map(unit).collect()
    }

    /// Mean absolute error, by channel, of a constant prediction: the mean of the training labels, or of the scored labels if unknown.
    fn constants(&self) -> ByChannel<f64> {
        let channels = self.plan.channels().iter().zip(&self.truth);
        let columns = channels.map(|(channel, truth)| {
            let known: Vec<f64> = (0..truth.len()).filter_map(|row| truth.get(row)).collect();
            let mean = known.iter().sum::<f64>() / known.len().max(1) as f64;
            let constant = self.plan.constants().get(channel.name());
            Column::full(vec![constant.copied().unwrap_or(mean); truth.len()])
        });
        let columns: Vec<Column> = columns.collect();
        let names = self.plan.channels().iter().map(|channel| channel.name());
        let planes = PLANES.into_iter().map(|(plane, ..)| plane);
        let errors = names
            .chain(planes)
            .filter_map(|name| Some((name.to_owned(), self.errors(name, &columns).mean()?)));
        errors.collect()
    }

    /// Number of predictions of each row: one for each random draw of the fault.
    fn draws(&self, predicted: &[Column]) -> usize {
        let length = predicted.first().map_or(0, Column::len);
        (length / self.rows.len().max(1)).max(1)
    }

    /// Absolute errors of the channel `name`. The error of a row is a mean over all random draws.
    fn errors(&self, name: &str, predicted: &[Column]) -> Errors {
        let draws = self.draws(predicted);
        let all = self.absolute(name, predicted);
        let means = all.chunks(draws).map(|of_row| {
            let sum: Option<f64> = of_row.iter().copied().sum();
            sum.map(|sum| sum / draws as f64)
        });
        let means: Vec<Option<f64>> = means.collect();
        Errors::of(&means, self.clusters.as_deref())
    }

    /// Least and greatest mean absolute error among the random draws, each a mean over all rows.
    fn spread(&self, name: &str, predicted: &[Column]) -> [f64; 2] {
        let draws = self.draws(predicted);
        let all = self.absolute(name, predicted);
        let means = (0..draws).filter_map(|draw| {
            let own: Vec<Option<f64>> = all.iter().skip(draw).step_by(draws).copied().collect();
            Errors::of(&own, None).mean()
        });
        means.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], mean| {
            [least.min(mean), most.max(mean)]
        })
    }

    /// Absolute errors of the channel `name`. For a plane, means of the absolute errors of both axes.
    ///
    /// # Shapes
    /// `[rows, draws]`.
    fn absolute(&self, name: &str, predicted: &[Column]) -> Vec<Option<f64>> {
        let channels = self.plan.channels();
        let positions: Option<Vec<usize>> = match plane_axes(name) {
            Some(axes) => axes.iter().map(|axis| channels.position(axis)).collect(),
            None => channels.position(name).map(|position| vec![position]),
        };
        let positions = positions.unwrap_or_default();
        let draws = self.draws(predicted);
        let error = |row: usize| -> Option<f64> {
            let mut sum = 0.0;
            for &position in &positions {
                let label = self.truth[position].get(row / draws)?;
                sum += (predicted[position].get(row)? - label).abs();
            }
            (!positions.is_empty()).then_some(sum / positions.len() as f64)
        };
        (0..draws * self.rows.len()).map(error).collect()
    }

    /// Scores without a fault, in the form of the report.
    pub(crate) fn clean(&self, of: &Scored) -> ByChannel<CleanScore> {
        let constants = self.constants();
        let scores = of.mae.iter().map(|(name, mae)| {
            let score = CleanScore {
                mae: *mae,
                skill: of.skill_of(name),
                metrics: of.metrics_of(name),
                constant: constants.get(name).copied(),
            };
            (name.clone(), score)
        });
        scores.collect()
    }
}

impl Scored {
    /// Scores with a fault, in the form of the report, relative to the scores without the fault.
    pub(crate) fn beside(
        &self,
        baseline: &Scored,
        clean: &ByChannel<CleanScore>,
    ) -> ByChannel<CellScore> {
        let scores = self.mae.iter().map(|(name, mae)| {
            let constant = clean.get(name).and_then(|clean| clean.constant);
            let capped = mae.value.zip(constant);
            let score = CellScore {
                mae: *mae,
                skill: self.skill_of(name),
                metrics: self.metrics_of(name),
                degradation: degradation(name, [self], baseline),
                capped: capped.map(|(error, constant)| error.min(constant)),
                spread: self.spread_beside(name, baseline),
            };
            (name.clone(), score)
        });
        scores.collect()
    }

    /// Names of the scored channels and planes.
    pub(crate) fn names(&self) -> impl Iterator<Item = &String> {
        self.mae.keys()
    }

    /// Greatest number of clusters (by default contact points) among the channels; `None` if a row has no cluster.
    pub(crate) fn clusters(&self) -> Option<usize> {
        self.errors.values().filter_map(Errors::clusters).max()
    }

    /// Number of samples with an error of the channel or plane `name`.
    pub(crate) fn count(&self, name: &str) -> u64 {
        self.errors.get(name).map_or(0, Errors::count)
    }

    /// Least and greatest degradation among the random draws of a fault.
    fn spread_beside(&self, name: &str, baseline: &Scored) -> Option<[f64; 2]> {
        let clean = baseline.errors.get(name)?.mean().filter(|of| *of > 0.0)?;
        let ends = self.spread.get(name)?.map(|error| error / clean);
        ends[0].is_finite().then_some(ends)
    }

    /// True unless the skill of every channel is known not to be above 0. True if no channel has a skill.
    pub(crate) fn has_skill(&self) -> bool {
        let known = || self.skill.values().filter(|skill| skill.value.is_some());
        known().next().is_none() || known().any(|skill| skill.is_above_zero() != Some(false))
    }

    fn skill_of(&self, name: &str) -> Estimate {
        let known = self.skill.get(name).copied();
        known.unwrap_or(Estimate::undefined(Undefined::Empty))
    }

    /// Further metrics of the channel `name`, by the name of the metric.
    fn metrics_of(&self, name: &str) -> ByChannel<Estimate> {
        let all = self.others.iter();
        let known = all.filter_map(|(id, of)| Some(((*id).to_owned(), *of.get(name)?)));
        known.collect()
    }
}

/// Degradation of a channel as a mean over `cells`, relative to the scores `baseline` without a fault.
pub(crate) fn degradation<'s>(
    name: &str,
    cells: impl IntoIterator<Item = &'s Scored>,
    baseline: &'s Scored,
) -> Estimate {
    mean_degradation(name, [cells.into_iter().collect()], baseline)
}

/// Degradation of the channel `name`: a mean over the cells of each fault, then over the faults. Faults without a cell do not count.
pub(crate) fn mean_degradation<'s>(
    name: &str,
    faults: impl IntoIterator<Item = Vec<&'s Scored>>,
    baseline: &'s Scored,
) -> Estimate {
    let faults: Vec<Vec<&Scored>> = faults.into_iter().filter(|of| !of.is_empty()).collect();
    let count = faults.len() as f64;
    let shares = faults.iter().flat_map(|cells| {
        let share = 1.0 / (count * cells.len() as f64);
        let errors = cells.iter().filter_map(|cell| cell.errors.get(name));
        errors.map(move |errors| Share { errors, share })
    });
    match baseline.errors.get(name) {
        Some(clean) => mean_ratio(shares, clean),
        None => Estimate::undefined(Undefined::Empty),
    }
}
