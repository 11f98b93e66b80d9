//! Tests for differences of the scores of tasks between every pair of results.

mod pairs;
mod render;

use std::collections::BTreeSet;

use taceva_metrics::{
    ComparisonError, Difference, DifferenceTest, Question, Side, Sides, Unit, Verdict,
    by_intervals, decide,
};

use crate::compare::estimate_of;
use crate::number::numeral;
use crate::task_result::{ResultScore, ResultTask, TaskResult};

pub use render::TASK_COMPARISON_SCHEMA;

/// Task scores of several results side by side, with tests of every score between every pair of results.
///
/// If both results have the same labels and their states are known, a score is tested in pairs by the signs of the clusters. Otherwise it is tested
/// by the intervals of both scores. All scores and pairs of one task form one family of Holm's procedure. Scores of other definitions, and scores
/// that are not shown to be better than the best constant, are not ranked.
///
/// ```
/// use taceva_report::{TaskComparison, TaskResult};
/// use taceva_tasks::{Classes, TaskReport, TaskState};
/// let result = |name: &str, wrong: u32| {
///     let mut classes = Classes::new(["lost", "held"], Some("held"))?;
///     for object in 0..20 {
///         let first = if object % 4 == wrong { "held" } else { "lost" };
///         for (truth, predicted) in [("lost", first), ("held", "held"), ("lost", "lost"), ("held", "held")] {
///             classes.push(&format!("object {object:02}"), truth, predicted)?;
///         }
///     }
///     let mut state = TaskState::new("grasp", "outcome", "object");
///     state.classes = Some(classes);
///     let mut report = TaskReport::new("0.2.0", "by `id`");
///     report.tables = [("truth".to_owned(), "sha256:1".to_owned())].into();
///     report.tasks.push(state.scores());
///     Ok::<TaskResult, Box<dyn std::error::Error>>(TaskResult::of(name, &report)?)
/// };
/// let comparison = TaskComparison::of(&[result("A", 1)?, result("B", 2)?], &[], 0);
/// let accuracy = &comparison.answers[0];
/// assert!(accuracy.is_paired() && accuracy.winner.is_none());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct TaskComparison {
    /// Compared results, in the given order.
    results: Vec<TaskResult>,
    /// Metrics in the request; empty for all.
    metrics: Vec<String>,
    /// Answers for every pair of results with a common score, task by task.
    pub answers: Vec<TaskAnswer>,
    /// Notes on pairs of results that are not compared cluster by cluster.
    pub notes: Vec<String>,
}

/// Comparison of one score between two results.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct TaskAnswer {
    /// Name of the task.
    pub task: String,
    /// Name of the score: `f1`, `top_k k=2`.
    pub score: String,
    /// Unit of both scores; empty for a pure number.
    pub unit: String,
    /// Positions of both results in the list of results.
    pub sides: Sides<usize>,
    /// Both values; `None` for an undefined value.
    pub values: Sides<Option<f64>>,
    /// Difference with its test, or the reason why there is no difference.
    pub difference: Result<Difference, String>,
    /// Position of the result that is shown to be better; `None` if there is no such result.
    pub winner: Option<usize>,
}

impl TaskAnswer {
    /// True if the score was tested in pairs of clusters.
    pub fn is_paired(&self) -> bool {
        let test = self.difference.as_ref().map(|difference| difference.test);
        matches!(test, Ok(DifferenceTest::SignFlip { .. }))
    }
}

/// One score of a result.
#[derive(Clone, Copy)]
struct Subject<'a> {
    result: &'a TaskResult,
    task: &'a ResultTask,
    score: &'a ResultScore,
    at: usize,
}

impl TaskComparison {
    /// Compares every pair of `results`. `metrics` selects scores by their metric; empty selects all. `seed` is the seed of the random signs.
    pub fn of(results: &[TaskResult], metrics: &[String], seed: u64) -> TaskComparison {
        let mut notes: Vec<String> = Vec::new();
        let mut answers = Vec::new();
        for task in tasks(results) {
            let mut of_task = Vec::new();
            for subjects in pairs_of(results, task, metrics) {
                let (answer, note) = answer(subjects, seed);
                of_task.push(answer);
                if let Some(note) = note.filter(|note| !notes.contains(note)) {
                    notes.push(note);
                }
            }
            decide_together(&mut of_task, results);
            answers.extend(of_task);
        }
        TaskComparison {
            results: results.to_vec(),
            metrics: metrics.to_vec(),
            answers,
            notes,
        }
    }

    /// Metric in `metrics` that no result has; `None` if all are known.
    pub fn unknown_metric<'m>(results: &[TaskResult], metrics: &'m [String]) -> Option<&'m str> {
        let tasks = results.iter().flat_map(|result| &result.tasks);
        let scores = tasks.flat_map(|task| &task.scores);
        let known: BTreeSet<&str> = scores.map(|score| score.metric.as_str()).collect();
        let mut asked = metrics.iter().map(String::as_str);
        asked.find(|metric| !known.contains(metric))
    }
}

/// Names of the tasks, in the order of their first appearance.
fn tasks(results: &[TaskResult]) -> Vec<&str> {
    let tasks = results.iter().flat_map(|result| &result.tasks);
    taceva_core::distinct(tasks.map(|task| task.name.as_str()))
}

/// Pairs of common scores of the task called `task`.
fn pairs_of<'a>(
    results: &'a [TaskResult],
    task: &str,
    metrics: &[String],
) -> Vec<Sides<Subject<'a>>> {
    let mut pairs = Vec::new();
    for (at, result) in results.iter().enumerate() {
        let Some(of_result) = result.task(task) else {
            continue;
        };
        for (at_other, other) in results.iter().enumerate().skip(at + 1) {
            let Some(of_other) = other.task(task) else {
                continue;
            };
            let asked = of_result
                .compared()
                .filter(|score| metrics.is_empty() || metrics.contains(&score.metric));
            for score in asked {
                let Some(other_score) = of_other.find(score) else {
                    continue;
                };
                let a = Subject {
                    result,
                    task: of_result,
                    score,
                    at,
                };
                let b = Subject {
                    result: other,
                    task: of_other,
                    score: other_score,
                    at: at_other,
                };
                pairs.push(Sides { a, b });
            }
        }
    }
    pairs
}

/// Answer before Holm's procedure, with the reason why results of the same labels are not compared cluster by cluster.
fn answer(subjects: Sides<Subject<'_>>, seed: u64) -> (TaskAnswer, Option<String>) {
    let Sides { a, b } = subjects;
    let (difference, note) = match barred(subjects) {
        Some(reason) => (Err(reason), None),
        None => match pairs::difference(subjects, seed) {
            Ok(difference) => (Ok(difference), None),
            Err(reason) => (unpaired(subjects), Some(reason)),
        },
    };
    let answer = TaskAnswer {
        task: a.task.name.clone(),
        score: a.score.named(),
        unit: a.score.unit.clone().unwrap_or_default(),
        sides: Sides { a: a.at, b: b.at },
        values: Sides {
            a: a.score.estimate.value,
            b: b.score.estimate.value,
        },
        difference,
        winner: None,
    };
    (answer, note)
}

/// Reason why two scores are not ranked: different definitions, no value, or not better than a constant.
fn barred(subjects: Sides<Subject<'_>>) -> Option<String> {
    let Sides { a, b } = subjects;
    let [own, other] = [a, b].map(|side| side.task.meaning(side.score));
    if own != other {
        return Some(format!("the definitions `{own}` and `{other}` differ"));
    }
    let reasons = [a, b].into_iter().filter_map(|side| {
        let estimate = &side.score.estimate;
        let name = &side.result.name;
        if let Some(reason) = &estimate.undefined {
            return Some(format!("{name}: undefined: {reason}"));
        }
        let constant = estimate.of_constant?;
        (!side.score.standing().takes_part()).then(|| {
            format!(
                "{name}: not shown to be better than the best constant prediction, {}",
                numeral(constant)
            )
        })
    });
    let reasons: Vec<String> = reasons.collect();
    (!reasons.is_empty()).then(|| reasons.join("; "))
}

/// Difference by the intervals of both scores.
fn unpaired(subjects: Sides<Subject<'_>>) -> Result<Difference, String> {
    let estimate = |side: Subject<'_>| {
        let estimate = estimate_of(&side.task.score_of(side.score));
        estimate.map_err(|reason| format!("{}: {reason}", side.result.name))
    };
    let both = Sides {
        a: estimate(subjects.a)?,
        b: estimate(subjects.b)?,
    };
    by_intervals(both).map_err(|error: ComparisonError| error.to_string())
}

/// Applies Holm's procedure to all tests of a task, and finds the better side of each test.
fn decide_together(answers: &mut [TaskAnswer], results: &[TaskResult]) {
    let tested = answers.iter();
    let tested = tested.filter_map(|answer| answer.difference.as_ref().ok().cloned());
    let mut family: Vec<Difference> = tested.collect();
    decide(&mut family);
    let mut family = family.into_iter();
    for answer in answers
        .iter_mut()
        .filter(|answer| answer.difference.is_ok())
    {
        let Some(decided) = family.next() else {
            return;
        };
        let task = results[answer.sides.a].task(&answer.task);
        let mut scores = task.into_iter().flat_map(|task| task.compared());
        let score = scores.find(|score| score.named() == answer.score);
        // The verdict has no unit, because the answer states the unit.
        let better = score.and_then(|score| {
            let question = Question::new(Unit::One, score.better());
            Verdict::of(Ok(decided.clone()), question).better()
        });
        answer.winner = better.map(|side| match side {
            Side::A => answer.sides.a,
            Side::B => answer.sides.b,
        });
        answer.difference = Ok(decided);
    }
}
