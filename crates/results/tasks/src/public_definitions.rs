//! Scores of a task by the definitions of public programs.

use crate::classes::Classes;
use crate::pose::{EulerErrors, PoseState};
use crate::public_number::{PublicNumber, PublicProgram};
use crate::score::TaskScore;
use crate::share_of_sets::PublishedShare;
use crate::state::TaskState;

/// Rule that Sparsh applies before it computes the F1 of slip.
const RULE_OF_SPARSH: &str = "threshold 0.4 strict, debounce 3";
/// Names of the axes of rotation.
const AXES: [&str; 3] = ["x", "y", "z"];

impl TaskState {
    /// Numbers of the task as `program` computes them, each with the correct number; empty if the program does not score such a task.
    ///
    /// | program | number | definition there |
    /// |---|---|---|
    /// | `sparsh` | `f1`, `balanced_accuracy` | without the first and the last trajectory, in the order of the names of clusters |
    /// | `sparsh` | half-width of `class_accuracy` | 1.96 SD over test sets / √samples; the clusters are the sets |
    /// | `touch-and-go` | `top-5` | share of samples with the right class |
    /// | `normalflow` | rotation about x, y, z | mean absolute difference of Euler angles, as numbers |
    /// | `objectfolder` | distance of contacts | mean over objects of their mean distances |
    #[must_use]
    pub fn as_published(&self, program: PublicProgram) -> Vec<PublicNumber> {
        let (classes, pose) = (self.classes.as_ref(), self.pose.as_ref());
        match program {
            PublicProgram::Sparsh => classes.map(of_sparsh).unwrap_or_default(),
            PublicProgram::TouchAndGo => {
                let top = classes.and_then(|classes| self.of_touch_and_go(classes));
                top.into_iter().collect()
            }
            PublicProgram::NormalFlow => {
                let euler = self.euler.as_ref();
                euler.map(of_normal_flow).unwrap_or_default()
            }
            PublicProgram::ObjectFolder => pose.and_then(of_object_folder).into_iter().collect(),
        }
    }

    fn of_touch_and_go(&self, classes: &Classes) -> Option<PublicNumber> {
        let places = self.places.as_ref().map(|places| places.scores(5));
        let first = places.and_then(|scores| scores.first()?.estimate.value.ok());
        Some(PublicNumber {
            program: PublicProgram::TouchAndGo,
            number: "top-5".to_owned(),
            value: value(&classes.scores(), "class_accuracy")?,
            unit: None,
            right: first,
            difference:
                "its code counts only the first place, so its top 5 is the share of samples with the right class"
                    .to_owned(),
        })
    }
}

/// Value of the metric without a variant; `None` if absent or undefined.
fn value(scores: &[TaskScore], metric: &str) -> Option<f64> {
    let mut scores = scores.iter();
    let found = scores.find(|score| score.metric == metric && score.variant.is_none());
    found?.estimate.value.ok()
}

fn of_sparsh(classes: &Classes) -> Vec<PublicNumber> {
    let mut numbers = of_inner_trajectories(classes);
    numbers.extend(half_width(classes));
    numbers
}

/// F1 and balanced accuracy without the first and the last trajectory.
fn of_inner_trajectories(classes: &Classes) -> Vec<PublicNumber> {
    let names: Vec<&str> = classes.clusters().collect();
    let [first, inner @ .., last] = names.as_slice() else {
        return Vec::new();
    };
    if inner.is_empty() || classes.positive().is_none() {
        return Vec::new();
    }
    let scored = classes.without_clusters(&[*first, *last]).scores();
    let all = classes.scores();
    let rule = match classes.rule() {
        RULE_OF_SPARSH => String::new(),
        "" => format!("; its rule is {RULE_OF_SPARSH}, and the right number has no rule"),
        rule => format!("; its rule is {RULE_OF_SPARSH}, and that of the right number is {rule}"),
    };
    let number = |metric: &str| {
        Some(PublicNumber {
            program: PublicProgram::Sparsh,
            number: metric.to_owned(),
            value: value(&scored, metric)?,
            unit: None,
            right: value(&all, metric),
            difference: format!(
                "its loop leaves out the first and the last trajectory, `{first}` and `{last}`{rule}"
            ),
        })
    };
    ["f1", "balanced_accuracy"]
        .into_iter()
        .filter_map(number)
        .collect()
}

/// Half-width of the interval of the share of right classes, with the clusters as test sets.
fn half_width(classes: &Classes) -> Option<PublicNumber> {
    let sets = classes.hits_by_cluster();
    let count = u32::try_from(sets.len()).ok().filter(|count| *count >= 2)?;
    let shares = sets.iter().map(|[hits, n]| *hits as f64 / *n as f64);
    let mean = shares.clone().sum::<f64>() / f64::from(count);
    let squares = shares.map(|share| (share - mean) * (share - mean));
    let sd = (squares.sum::<f64>() / f64::from(count)).sqrt();
    let [hits, n] = sets
        .iter()
        .fold([0, 0], |[hits, n], [own, of]| [hits + own, n + of]);
    let half_width = PublishedShare::half_width_of(sd, n);
    let published = PublishedShare::new(hits, n, count, half_width);
    let times = match half_width > 0.0 {
        true => format!(" and is {:.1} times as wide", published.ratio()),
        false => String::new(),
    };
    Some(PublicNumber {
        program: PublicProgram::Sparsh,
        number: "half-width of class_accuracy".to_owned(),
        value: half_width,
        unit: None,
        right: Some(published.half_width_by_sets()),
        difference: format!(
            "it divides the spread over {count} sets by the root of {n} samples; Student's t interval uses the number of sets{times}"
        ),
    })
}

fn of_normal_flow(euler: &EulerErrors) -> Vec<PublicNumber> {
    let number = |(axis, name): (usize, &str)| {
        let [as_numbers, shorter] = euler.mean_degrees(axis)?;
        Some(PublicNumber {
            program: PublicProgram::NormalFlow,
            number: format!("rotation about {name}"),
            value: as_numbers,
            unit: Some("deg"),
            right: Some(shorter),
            difference:
                "it subtracts Euler angles as numbers, so 179 and -179 degrees differ by 358 instead of 2"
                    .to_owned(),
        })
    };
    AXES.into_iter().enumerate().filter_map(number).collect()
}

fn of_object_folder(pose: &PoseState) -> Option<PublicNumber> {
    Some(PublicNumber {
        program: PublicProgram::ObjectFolder,
        number: "distance of contacts".to_owned(),
        value: pose.mean_of_cluster_means()?,
        unit: Some("mm"),
        right: value(&pose.scores(), "pose_translation"),
        difference:
            "each object counts equally, whatever its number of contacts; it divides by the size of each mesh too, which no column has"
                .to_owned(),
    })
}
