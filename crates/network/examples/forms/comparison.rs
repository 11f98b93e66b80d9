//! Results of trainings in two forms, beside their spread over seeds.

use taceva_network::ConvolutionForm;

use crate::blobs::LABELS;

/// Steps, counted from 0, whose losses are printed in addition to the loss of the last step.
const STEPS: [usize; 3] = [10, 50, 100];

/// Result of one training.
pub(crate) struct Course {
    pub(crate) form: ConvolutionForm,
    pub(crate) seed: u64,
    /// Loss of each step.
    pub(crate) losses: Vec<f64>,
    /// R² of each held-out label.
    pub(crate) scores: [f64; LABELS.len()],
    /// Wall-clock time of the training, s, which other programs can lengthen.
    pub(crate) seconds: f64,
}

/// Prints a row for each loss and score: mean and standard deviation over seeds in each form, and the difference of means. The last columns are the
/// spread over seeds (root of the mean variance of both forms), and `yes` if the difference does not exceed it.
pub(crate) fn print(forms: [ConvolutionForm; 2], courses: &[Course], steps: usize) {
    let [first, second] = forms.map(|form| form.to_string());
    println!("| | {first} | {second} | difference | spread | within |\n|---|---|---|---|---|---|");
    let mut apart = 0;
    let mut row = |what: String, of: &dyn Fn(&Course) -> f64| {
        let [first, second] = forms.map(|form| {
            let values = courses.iter().filter(|course| course.form == form);
            Spread::of(&values.map(of).collect::<Vec<_>>())
        });
        let difference = second.mean - first.mean;
        let spread = ((first.variance + second.variance) / 2.0).sqrt();
        let is_within = difference.abs() <= spread;
        apart += usize::from(!is_within);
        println!(
            "| {what} | {first} | {second} | {difference:.2e} | {spread:.2e} | {} |",
            if is_within { "yes" } else { "no" }
        );
    };
    for step in STEPS.into_iter().filter(|step| *step + 1 < steps) {
        row(format!("loss, step {step}"), &|course| course.losses[step]);
    }
    let last = steps - 1;
    row(format!("loss, step {last}"), &|course| course.losses[last]);
    for (at, label) in LABELS.iter().enumerate() {
        row(format!("R² of {label}"), &|course| course.scores[at]);
    }
    for form in forms {
        let of_form = courses.iter().filter(|course| course.form == form);
        let seconds: Vec<f64> = of_form.map(|course| course.seconds).collect();
        println!("{form}: {:.1} s a training", Spread::of(&seconds).mean);
    }
    println!("{apart} differences are larger than the spread over seeds");
}

/// Mean and variance of a loss or score over seeds.
struct Spread {
    mean: f64,
    variance: f64,
}

impl Spread {
    fn of(values: &[f64]) -> Spread {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let squares = values.iter().map(|value| (value - mean).powi(2));
        let variance = squares.sum::<f64>() / (count - 1.0);
        Spread { mean, variance }
    }
}

impl std::fmt::Display for Spread {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:.5} ± {:.5}", self.mean, self.variance.sqrt())
    }
}
