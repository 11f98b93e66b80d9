//! Scores predictions in ten lines, without any other crate.

#![expect(clippy::print_stdout, reason = "an example shows its result")]

use taceva_metrics::{Channel, Evaluator};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let truth = [0.25, 0.50, 1.00];
    let prediction = [0.50_f32, 0.50, 0.75];
    let mut evaluator = Evaluator::of_channels([Channel::FZ])?;
    evaluator.update_pairs(Channel::FZ, truth, prediction)?;
    let scores = evaluator.score()?;
    let mae = scores.mae(Channel::FZ).ok_or("no score")?;
    println!("MAE {} {}", mae.value, mae.unit);
    println!("{scores}");
    Ok(())
}
