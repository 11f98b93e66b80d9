//! Scores a model batch by batch, and compares a second model with it on the same samples.

#![expect(clippy::print_stdout, reason = "an example shows its result")]

use taceva_metrics::{
    Better, Channel, Channels, ClusterSums, Evaluator, Interval, Question, Rows, Sides, SignFlip,
    Unit, Value, Verdict,
};

const CHANNELS: [Channel; 2] = [Channel::FX, Channel::FZ];

/// One batch at one contact point. Both slices are samples × channels, as in a tensor.
fn rows(point: &str, truth: &[f32], prediction: &[f32]) -> Rows {
    let mut rows = Rows::new().points([point; 2]);
    for (at, channel) in CHANNELS.into_iter().enumerate() {
        let (truth, prediction) = (truth.iter().skip(at), prediction.iter().skip(at));
        rows = rows.pairs(channel, truth.step_by(2), prediction.step_by(2));
    }
    rows
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let channels = Channels::new(CHANNELS)?;
    let mut evaluator = Evaluator::of_channels(CHANNELS)?;
    let mut errors = Sides {
        a: ClusterSums::default(),
        b: ClusterSums::default(),
    };
    let points = ["a", "b", "c", "d", "e", "f"].into_iter();
    for (point, error) in points.zip([0.05, 0.07, 0.04, 0.09, 0.06, 0.08]) {
        let truth = [0.1, 1.0, 0.2, 2.0];
        let a = rows(point, &truth, &[0.1, 1.0 + error, 0.2, 2.0 - error]);
        let b = rows(point, &truth, &[0.1, 1.2 + error, 0.2, 2.1]);
        let a = a.into_batch(&channels)?;
        evaluator.update(&a)?;
        errors.a.update(&a, 1)?; // 1: the position of Fz
        errors.b.update(&b.into_batch(&channels)?, 1)?;
    }
    let scores = evaluator.finish()?;
    for id in ["mae", "detection_limit"] {
        let score = scores.score(id, "Fz").ok_or("a skipped metric")?;
        let (value, unit, n) = (&score.value, score.unit, score.n);
        match (value, &score.interval) {
            (Value::Undefined(reason), _) => println!("{id}: no value, {reason}"),
            (_, Interval::Undefined(reason)) => println!("{id} {value} {unit}, n {n}, {reason}"),
            (_, interval) => {
                let [low, high] = interval.ends().ok_or("no interval")?;
                println!("{id} {value} {unit}, 95 % {low:.3} to {high:.3}, n {n}");
            }
        }
    }
    let difference = SignFlip::default().test(Sides {
        a: &errors.a,
        b: &errors.b,
    });
    let question = Question::new(Unit::Newton, Better::Lower);
    println!("mae Fz: {}", Verdict::of(difference, question));
    Ok(())
}
